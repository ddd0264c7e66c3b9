"""Faults of scripts/parameterStudy, with the surrogate for a case that tests/parameterStudy has."""

import functools
import shutil
import signal
import time
from typing import Any, Callable

import yaml

from clepsydra.environment import REPOSITORY
from developers.fault_kinds.bench import Bench
from developers.fault_kinds.disk import on_small_disk_at, room_again
from developers.fault_kinds.kinds import Wrong, fault

PARAMETER_STUDY = REPOSITORY / "scripts" / "parameterStudy"
SURROGATE = REPOSITORY / "tests" / "parameterStudy" / "surrogate"


class Runs:
    """A parameter study of a filling and two runs."""

    def __init__(self, bench: Bench) -> None:
        self.bench = bench
        self.folder = bench.fresh_folder("parameterStudy")
        shutil.copytree(SURROGATE, self.folder / "case")
        # what is frozen of a build need not be large here
        (self.folder / "build/bin").mkdir(parents=True)
        (self.folder / "build/lib").mkdir()
        shutil.copy("/bin/true", self.folder / "build/bin/pimpleDemFoam")
        self.file = self.folder / "test.yaml"
        self.file.write_text(
            yaml.safe_dump(
                {"case": "case", "steps": ["dry"], "packings": [1], "runs": {"mu": {"sweep": {"friction": [0.1, 0.2]}}}}
            )
        )
        self.log = self.folder.with_name(self.folder.name + ".log")

    def command(self, action: Any) -> list[Any]:
        return [
            "env",
            f"CLEPSYDRA_BUILD={self.folder / 'build'}",
            PARAMETER_STUDY,
            action,
            self.file,
            *["--cores", "1"] * (action == "run"),
        ]

    def start(self) -> Any:
        return self.bench.start(self.command("run"), self.folder, self.log)

    def run(self) -> Any:
        return self.bench.call(self.command("run"), self.folder, self.log)

    def results(self) -> dict[Any, Any]:
        return {file.name: file.read_text() for file in (self.folder / "results").glob("*.csv")}

    def settle(self) -> Any:
        outcome = self.run()
        if outcome.status != 0 or "Traceback" in outcome.output:
            raise Wrong(f"status {outcome.status}: {outcome.last_words}")
        if self.results() != undisturbed(self.bench):
            raise Wrong("other results than undisturbed")
        return outcome


def undisturbed(bench: Bench) -> Any:
    if bench.parameter_study_results is None:
        runs = Runs(bench)
        began = time.monotonic()
        outcome = runs.run()
        if outcome.status != 0 or len(runs.results()) != 2:
            raise SystemExit(f"faults: the surrogate's parameter study fails: {outcome.output}")
        bench.parameter_study_seconds = time.monotonic() - began
        bench.parameter_study_results = runs.results()
    return bench.parameter_study_results


@fault(
    "SIGKILL to a parameter study and all that it has started, at random moments",
    "the same command goes on to the same results",
)
def parameter_study_killed(bench: Bench) -> list[Any]:
    return [functools.partial(kill_parameter_study, bench) for _ in bench.times(1, 6)]


def kill_parameter_study(bench: Bench) -> str:
    undisturbed(bench)
    runs = Runs(bench)
    for _ in range(3):
        process = runs.start()
        time.sleep(bench.random.uniform(0.1, 0.9) * bench.parameter_study_seconds)
        bench.kill_all()
        process.wait()
    runs.settle()
    return "same results"


@fault(
    "SIGTERM or SIGINT to a parameter study",
    "status 143 or 130, nobody lives on; the same command goes on to the same results",
    in_quick=False,
)
def parameter_study_stopped(bench: Bench) -> list[Any]:
    return [
        functools.partial(stop_parameter_study, bench, how) for how in (signal.SIGTERM, signal.SIGINT) for _ in range(2)
    ]


def stop_parameter_study(bench: Bench, how: signal.Signals) -> str:
    undisturbed(bench)
    runs = Runs(bench)
    process = runs.start()
    time.sleep(bench.random.uniform(0.4, 0.7) * bench.parameter_study_seconds)
    running = process.poll() is None
    process.send_signal(how)
    outcome = bench.finished(process, runs.log)
    if running and outcome.status not in (128 + how, 0):
        raise Wrong(f"status {outcome.status}: {outcome.last_words}")
    if bench.alive():
        raise Wrong(f"{len(bench.alive())} processes live on")
    runs.settle()
    return "same results"


@fault(
    "a file of a parameter study's state has half a line, is empty or is no JSON",
    "says so, or makes it again: the same results",
)
def parameter_study_state_damaged(bench: Bench) -> list[Any]:
    return [
        functools.partial(damage_state, bench, *change)
        for change in bench.some(
            (
                ("attempts", lambda text: text + '{"start": 17'),
                ("attempts", lambda text: ""),
                ("attempts", lambda text: text[: len(text) // 2]),
                ("attempts", lambda text: "no JSON\n" + text),
            ),
            quick=1,
        )
    ]


def damage_state(bench: Bench, name: str, damage: Callable[..., Any]) -> str:
    undisturbed(bench)
    runs = Runs(bench)
    runs.run()
    for task in (runs.folder / "work").glob("*/*"):
        if (task / name).exists():
            (task / name).write_text(damage((task / name).read_text()))
            (task / "done").unlink(missing_ok=True)
    status = bench.call(runs.command("status"), runs.folder, runs.log)
    if "Traceback" in status.output:
        raise Wrong("status: " + status.last_words)
    outcome = runs.run()
    if outcome.status != 0:
        if not outcome.says(f"{name}:1: "):
            raise Wrong(outcome.last_words)
        for file in (runs.folder / "work").glob(f"*/*/{name}"):
            file.write_text(file.read_text().partition("\n")[2])
    runs.settle()
    return "same results" if outcome.status == 0 else "file and line are named; without it the same results"


@fault(
    "the disk of a parameter study is full after so many KiB",
    "fails with a message; with room again the same command goes on to the same results",
)
def parameter_study_disk_full(bench: Bench) -> list[Any]:
    return [functools.partial(fill_parameter_study, bench, room) for room in bench.some(range(0, 330, 15), quick=2)]


def fill_parameter_study(bench: Bench, room: int) -> Any:
    undisturbed(bench)
    runs = Runs(bench)
    disk = on_small_disk_at(bench, runs.folder, room)
    outcome = runs.run()
    said = "had room; same results"
    if outcome.status != 0:
        if "Traceback" in outcome.output or "No space" not in outcome.output:
            raise Wrong(f"{room} KiB: status {outcome.status}, {outcome.last_words}")
        said = "failed with a message, then the same results"
    room_again(bench, disk)
    runs.settle()
    return said
