"""Files of a checkpoint that are not what the run wrote."""

import functools
import shutil
from pathlib import Path
from typing import Any, Callable

from developers.fault_kinds.bench import BEFORE_STOPPED, STOPPED, Bench, Case, differences, rows, sha256
from developers.fault_kinds.kinds import Wrong, fault

NAMED = "names the file, goes on from the checkpoint before to the same end"


def empty(file: Path) -> None:
    file.write_bytes(b"")


def delete(file: Path) -> None:
    file.unlink()


def cut(file: Path) -> None:
    file.write_bytes(file.read_bytes()[: file.stat().st_size * 2 // 3])


def flip_bit(file: Path) -> None:
    """One bit of a value: in the middle, where a field has its numbers."""
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)


def older_instead(file: Path) -> None:
    shutil.copyfile(str(file).replace(STOPPED, BEFORE_STOPPED), file)


def other_kind(damage: Callable[..., Any], done: Any, in_quick: bool) -> Any:
    def tries(bench: Bench) -> list[Any]:
        names = bench.stopped().manifest(STOPPED)
        if damage is older_instead:
            # what is the same at both times is no other file
            names = [name for name in names if name not in ("0.06/uniform/checkpoint",)]
        return [functools.partial(damage_checkpoint, bench, damage, [name]) for name in bench.some(names, quick=2)]

    tries.__name__ = damage.__name__ + "_of_checkpoint"
    return fault(done, NAMED, in_quick)(tries)


other_kind(empty, "a file of the last checkpoint has 0 bytes; each in turn", True)
other_kind(delete, "a file of the last checkpoint is gone; each in turn", False)
other_kind(cut, "a file of the last checkpoint is cut; each in turn", False)
other_kind(flip_bit, "one bit flipped in a file of the last checkpoint; each in turn", True)
other_kind(older_instead, "a file of the last checkpoint is that of the checkpoint before; each in turn", True)


def damage_checkpoint(bench: Bench, damage: Callable[..., Any], names: Any) -> str:
    case = bench.stopped()
    for name in names:
        damage(case.folder / name)
    outcome = case.settle()
    for name in names[:1]:
        if not outcome.says(name):
            raise Wrong(f"{name} is not named: {outcome.output[:600]}")
    if not outcome.says(f"Resuming from the checkpoint of time {BEFORE_STOPPED}"):
        raise Wrong("did not go on from the checkpoint before")
    return "named; from the checkpoint before to the same end"


@fault(
    "the manifest of the last checkpoint emptied, cut, gone, a bit flipped, that of another time",
    "says so, goes on from the checkpoint before to the same end",
    in_quick=False,
)
def manifest_damaged(bench: Bench) -> list[Any]:
    return [
        functools.partial(damage_manifest, bench, damage) for damage in (empty, delete, cut, flip_bit, older_instead)
    ]


def damage_manifest(bench: Bench, damage: Callable[..., Any]) -> str:
    case = bench.stopped()
    damage(case.folder / "checkpoints" / STOPPED / "complete")
    outcome = case.settle()
    said = (f"Resuming from the checkpoint of time {BEFORE_STOPPED}", f"time {STOPPED}")
    if not all(outcome.says(text) for text in said):
        raise Wrong("did not say so: " + outcome.output[:400])
    return "said so; from the checkpoint before to the same end"


@fault("two of three checkpoints damaged", "goes on from the one that is whole, to the same end", in_quick=False)
def two_damaged(bench: Bench) -> list[Any]:
    def both() -> str:
        case = bench.stopped()
        flip_bit(case.folder / STOPPED / "U")
        empty(case.folder / "checkpoints" / BEFORE_STOPPED / "particles.0.restart")
        outcome = case.settle()
        if not outcome.says("Resuming from the checkpoint of time 0.02"):
            raise Wrong("did not go on from .02 s")
        return "from the whole one to the same end"

    return [both]


@fault("all checkpoints damaged", "refuses and names a file of each; nothing is changed")
def all_damaged(bench: Bench) -> list[Any]:
    return [functools.partial(damage_all, bench, damage) for damage in bench.some([flip_bit, empty, cut], quick=1)]


def damage_all(bench: Bench, damage: Callable[..., Any]) -> Any:
    case = bench.stopped()
    times = ("0.02", BEFORE_STOPPED, STOPPED)
    for time in times:
        damage(case.folder / time / "p")
    return refusal(case, [f"{time}/p" for time in times])


@fault(
    "the folder checkpoints is gone, or all that is in it, or the name of the beginning",
    "refuses with a message; nothing is changed, and with the folder back the same end",
)
def checkpoints_gone(bench: Bench) -> list[Any]:
    return [
        functools.partial(lose_checkpoints, bench, *what)
        for what in bench.some(
            [("checkpoints", None), ("checkpoints/beginning", None), ("checkpoints/beginning", empty)], quick=1
        )
    ]


def lose_checkpoints(bench: Bench, what: str, damage: Callable[[Path], None] | None) -> str:
    case = bench.stopped()
    file, kept = case.folder / what, case.folder / "kept"
    if file.is_dir():
        shutil.copytree(file, kept)
    else:
        shutil.copyfile(file, kept)
    if damage:
        damage(file)
    else:
        shutil.rmtree(file) if file.is_dir() else file.unlink()
    said = refusal(case, [])
    shutil.rmtree(file) if file.is_dir() else file.unlink(missing_ok=True)
    kept.rename(file)
    case.settle()
    return said + "; put back, the same end"


def refusal(case: Case, names: Any) -> str:
    before = state(case)
    outcome = case.run()
    if outcome.status == 0 or not outcome.explains("checkpoint"):
        raise Wrong(f"not refused: status {outcome.status}, {outcome.last_words}")
    for name in names:
        if not outcome.says(name):
            raise Wrong(f"{name} is not named")
    if state(case) != before:
        changed = sorted(set(before.items()) ^ set(state(case).items()))
        raise Wrong("changed by a run that refused: " + ", ".join(changed[0]))
    return "refused, nothing changed"


def state(case: Case) -> dict[str, Any]:
    """Content of all that a run writes, but its logs and lock."""
    return {
        str(file.relative_to(case.folder)): sha256(file)
        for file in case.folder.rglob("*")
        if file.is_file() and not file.name.startswith(("log.", ".pimple"))
    }


@fault(
    "the table of m(t) cut in the middle of a line, emptied, gone, a line of it damaged",
    "says that rows are missing or not those that were written; the states are those undisturbed",
    in_quick=False,
)
def table_damaged(bench: Bench) -> list[Any]:
    return [functools.partial(damage_table, bench, damage) for damage in (cut, empty, delete, drop_line)]


def drop_line(file: Path) -> None:
    lines = file.read_text().splitlines(keepends=True)
    file.write_text("".join(lines[:20] + lines[21:]))


def damage_table(bench: Bench, damage: Callable[..., Any]) -> str:
    case = bench.stopped()
    damage(case.folder / "postProcessing/massInHopper/0/massInHopper.dat")
    outcome = case.run()
    if outcome.status != 0 or not outcome.says("WARNING: massInHopper.dat has"):
        raise Wrong(
            f"{damage.__name__}: m(t) has {len(rows(case.folder))} rows in place of "
            f"{len(rows(bench.reference()))}, and nothing is said; status {outcome.status}"
        )
    others = [name for name in differences(case.folder, bench.reference()) if not name.startswith("m(t)")]
    if others:
        raise Wrong(", ".join(others[:3]))
    return "said; the states are the same"


@fault(
    "the table of m(t) goes on behind the checkpoint, its last line half written, as a kill leaves it",
    "what is later is written again: the same end",
)
def table_ahead(bench: Bench) -> list[Any]:
    def ahead() -> str:
        case = bench.stopped()
        with open(case.folder / "postProcessing/massInHopper/0/massInHopper.dat", "a") as table:
            table.write("".join(f"{step * 1e-3:.10g}\t8e-4\t80\t0\n" for step in range(61, 70)) + "0.07\t8.37")
        case.settle()
        return "same end"

    return [ahead]


@fault(
    "a checkpoint is asked for by startTime that is damaged or was never written",
    "refuses and names the times that there are; nothing is changed",
    in_quick=False,
)
def wrong_start_time(bench: Bench) -> list[Any]:
    def ask(time: str, damage: bool) -> str:
        case = bench.stopped(startFrom="startTime", startTime=time)
        if damage:
            flip_bit(case.folder / time / "U")
        return refusal(case, [time])

    return [functools.partial(ask, STOPPED, True), functools.partial(ask, "0.05", False)]
