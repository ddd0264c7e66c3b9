"""Faults of runs on two ranks."""

import functools
import os
import signal
import time
from typing import Any

from developers.fault_kinds.bench import BEFORE_STOPPED, STOPPED, Bench, Case
from developers.fault_kinds.damage import flip_bit
from developers.fault_kinds.kinds import Wrong, fault

TO_THE_SAME_END = "no rank lives on; the same command goes on to the same end, bit for bit"


@fault("SIGKILL to one of two ranks", TO_THE_SAME_END)
def rank_killed(bench: Bench) -> list[Any]:
    return [functools.partial(hit_rank, bench, signal.SIGKILL) for _ in bench.times(1, 8)]


@fault("SIGKILL to mpirun", TO_THE_SAME_END, in_quick=False)
def mpirun_killed(bench: Bench) -> list[Any]:
    return [functools.partial(hit_mpirun, bench, signal.SIGKILL) for _ in bench.times(1, 4)]


@fault("SIGTERM to mpirun", TO_THE_SAME_END, in_quick=False)
def mpirun_terminated(bench: Bench) -> list[Any]:
    return [functools.partial(hit_mpirun, bench, signal.SIGTERM) for _ in bench.times(1, 4)]


@fault(
    "SIGTERM to both ranks",
    "status 0 with a checkpoint; then every particle and every row of m(t) once",
    in_quick=False,
)
def ranks_terminated(bench: Bench) -> list[Any]:
    return [functools.partial(stop_ranks, bench) for _ in bench.times(1, 4)]


def ranks_of(bench: Bench) -> list[Any]:
    found = []
    for process in bench.alive():
        try:
            with open(f"/proc/{process}/comm") as name:
                if name.read().strip() == "pimpleDemFoam":
                    found.append(process)
        except OSError:
            pass
    return sorted(found)


def started(bench: Bench, up_to: Any = 0.9) -> tuple[Any, Any]:
    case = bench.pile(2)
    process = case.start()
    step = bench.random.randrange(1, int(100 * up_to))
    if not case.wait_for(f"\nTime = {step * 1e-3:.8g}\n", process):
        raise Wrong("ended before the fault: " + bench.finished(process, case.log).last_words)
    return case, process


def require_nobody(bench: Bench) -> None:
    deadline = time.monotonic() + 30
    while bench.alive():
        if time.monotonic() > deadline:
            raise Wrong(f"{len(bench.alive())} processes live on")
        time.sleep(0.05)


def hit_rank(bench: Bench, how: signal.Signals) -> str:
    case, process = started(bench)
    os.kill(bench.random.choice(ranks_of(bench)), how)
    outcome = bench.finished(process, case.log)
    if outcome.status == 0:
        raise Wrong("status 0 though a rank was killed")
    require_nobody(bench)
    case.settle()
    return "same end"


def hit_mpirun(bench: Bench, how: signal.Signals) -> Any:
    case, process = started(bench)
    process.send_signal(how)
    bench.finished(process, case.log)
    require_nobody(bench)
    if "writing a checkpoint" in case.log.read_text():
        return go_on_after_stop(case)
    case.settle()
    return "same end"


def stop_ranks(bench: Bench) -> Any:
    case, process = started(bench)
    for rank in ranks_of(bench):
        os.kill(rank, signal.SIGTERM)
    outcome = bench.finished(process, case.log)
    if outcome.status != 0 or not outcome.stopped:
        raise Wrong(f"status {outcome.status}: {outcome.last_words}")
    return go_on_after_stop(case)


def go_on_after_stop(case: Case) -> str:
    """Off the write times the neighbour lists are made again, and rounding differs: times and counts only."""
    from developers.fault_kinds.bench import rows

    case.must_run()
    reference = [row.split()[::2] for row in rows(case.bench.reference(case.ranks))]
    found = [row.split()[::2] for row in rows(case.folder)]
    if found != reference:
        raise Wrong(f"m(t) has {len(found)} rows in place of {len(reference)}, or others")
    return "goes on, every row and particle once"


@fault(
    "a bit flipped in a field of one rank",
    "names the file, goes on from the checkpoint before to the same end",
    in_quick=False,
)
def field_of_rank_damaged(bench: Bench) -> list[Any]:
    names = [name for name in bench.stopped(2).manifest(STOPPED) if name.startswith("processor")]
    return [functools.partial(damage_rank, bench, name) for name in bench.some(names, quick=1, full=6)]


def damage_rank(bench: Bench, name: str) -> str:
    case = bench.stopped(2)
    flip_bit(case.folder / name)
    outcome = case.settle()
    if not (outcome.says(name) and outcome.says(f"time {BEFORE_STOPPED}")):
        raise Wrong(f"{name} is not named")
    return "named; from the checkpoint before to the same end"


@fault(
    "going on with another number of ranks than before, without decomposing",
    "refuses with a message, nothing is lost",
    in_quick=False,
)
def other_ranks(bench: Bench) -> list[Any]:
    return [functools.partial(go_on_with, bench, before, after) for before, after in ((1, 2), (2, 1), (2, 3))]


def go_on_with(bench: Bench, before: Any, after: Any) -> str:
    case = bench.stopped(before)
    case.ranks = after
    outcome = case.run()
    # OpenFOAM's own messages where it misses folders, or ours on fields that no reconstructPar has made.
    if outcome.status == 0 or not outcome.explains(
        "cannot open case directory", "made from processor", "processor dir"
    ):
        raise Wrong(f"{before} ranks, then {after}: status {outcome.status}, {outcome.last_words}")
    require_nobody(bench)
    case.ranks = before
    case.settle()
    return "refused; with the right number the same end"
