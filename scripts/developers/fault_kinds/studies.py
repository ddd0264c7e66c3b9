"""Faults of traceResidual, with the surrogate for a simulator that tests/identification has."""

import functools
import json
import os
import re
import shutil
import time
from typing import Any

from clepsydra import parameter_file
from clepsydra.environment import REPOSITORY
from developers.fault_kinds.bench import Bench
from developers.fault_kinds.damage import cut, delete, empty, flip_bit
from developers.fault_kinds.disk import on_small_disk_at, room_again
from developers.fault_kinds.kinds import Wrong, fault

SURROGATE = REPOSITORY / "tests" / "identification" / "surrogate"
# What of the report depends on when it was made.
OF_THIS_CALL = ("runs", "cost", "costs", "date", "seconds", "made", "remarks", "version")


class Study:
    """A small study of invented measurements, with an effect in them."""

    def __init__(self, bench: Bench) -> None:
        self.bench = bench
        self.folder = bench.fresh_folder("study")
        shutil.copytree(measured(bench), self.folder, symlinks=True, dirs_exist_ok=True)
        self.log = self.folder.with_name(self.folder.name + ".log")

    def start(self) -> Any:
        return self.bench.start(["traceResidual", "run", "study.yaml"], self.folder, self.log)

    def run(self) -> Any:
        return self.bench.call(["traceResidual", "run", "study.yaml"], self.folder, self.log)

    def answer(self) -> dict[Any, Any]:
        report = json.loads((self.folder / "results/report.json").read_text())
        return {name: value for name, value in report.items() if name not in OF_THIS_CALL}

    def settle(self) -> Any:
        outcome = self.run()
        if outcome.status != 0:
            raise Wrong(f"status {outcome.status}: {outcome.last_words}")
        if self.answer() != undisturbed(self.bench):
            others = [name for name, value in undisturbed(self.bench).items() if self.answer().get(name) != value]
            raise Wrong("another answer than undisturbed: " + ", ".join(others))
        return outcome


def measured(bench: Bench) -> Any:
    """The study with its measurements, made once."""
    if bench.study is None:
        folder = bench.folder / "study"
        shutil.copytree(SURROGATE / "case", folder / "case")
        text = (SURROGATE / "study.yaml").read_text()
        seed = 20011
        for name, entries in re.findall(r"- name: (\w+)\n +role: \w+\n +set: \{ (.*) \}", text):
            files = []
            for repeat in range(3):
                run = bench.fresh_folder("measure")
                given = dict(entry.split(": ") for entry in entries.split(", "))
                given |= {"seed": str(seed), "addedMass": "0.7"}
                seed += 2
                original = (SURROGATE / "case/parameters").read_text()
                (run / "parameters").write_text(parameter_file.with_parameters(original, given))
                if bench.call(["surrogateHopper"], run).status != 0:
                    raise SystemExit("faults: the surrogate for a simulator fails")
                rows = (run / "postProcessing/massInHopper/0/massInHopper.dat").read_text().splitlines()[1::2]
                files.append(f"{name}{repeat}.csv")
                (folder / files[-1]).write_text("t,m\n" + "".join(row.replace("\t", ",") + "\n" for row in rows))
            measured = f"    measured: {{ files: [{', '.join(files)}] }}\n"
            text = text.replace(f"- name: {name}\n", f"- name: {name}\n{measured}")
        text += (
            "measured:\n  time: { column: t, unit: s }\n  value: { column: m, unit: kg }\n"
            "onlyEffects: [addedMass, particleDiameter, drag]\ninference: { draws: 200 }\n"
            "executor: { kind: pool, processes: 1 }\n"
        )
        (folder / "study.yaml").write_text(text)
        bench.keep(folder)
        bench.study = folder
    return bench.study


def undisturbed(bench: Bench) -> Any:
    if bench.study_answer is None:
        study = Study(bench)
        began = time.monotonic()
        outcome = study.run()
        if outcome.status != 0:
            raise SystemExit(f"faults: the study fails: {outcome.output}")
        bench.study_seconds = time.monotonic() - began
        bench.keep(study.folder)
        bench.study_answer, bench.study_done = study.answer(), study.folder
    return bench.study_answer


@fault(
    "SIGKILL to a study and all that it has started, at random moments",
    "the same command goes on to the same answer",
    in_quick=False,
)
def study_killed(bench: Bench) -> list[Any]:
    return [functools.partial(kill_study, bench) for _ in bench.times(1, 6)]


def kill_study(bench: Bench) -> str:
    undisturbed(bench)
    study = Study(bench)
    for _ in range(3):
        process = study.start()
        time.sleep(bench.random.uniform(0.1, 0.8) * bench.study_seconds)
        bench.kill_all()
        process.wait()
    study.settle()
    return "same answer"


@fault(
    "files of stored runs are cut, emptied, gone, have a bit flipped",
    "says so, makes those runs again, comes to the same answer",
    in_quick=False,
)
def study_store_damaged(bench: Bench) -> list[Any]:
    return [
        functools.partial(damage_store, bench, damage, pattern)
        for pattern in ("massInHopper.dat", "record.json")
        for damage in (cut, empty, delete, flip_bit)
    ]


def damage_store(bench: Bench, damage: Any, pattern: str) -> str:
    undisturbed(bench)
    study = Study(bench)
    shutil.copytree(bench.study_done, study.folder, symlinks=True, dirs_exist_ok=True)
    stored = sorted(study.folder.glob(f"*.work/cache/**/{pattern}"))
    if len(stored) < 10:
        raise SystemExit(f"faults: the store of a study has {len(stored)} {pattern}")
    for file in stored[::7]:
        damage(file)
    outcome = study.settle()
    if not outcome.says("damaged"):
        raise Wrong(f"{pattern}, {damage.__name__}: nothing is said")
    return "said; same answer"


@fault(
    "the disk of a study is full after so many KiB",
    "stops with a message; with room again the same command comes to the same answer",
    in_quick=False,
)
def study_disk_full(bench: Bench) -> list[Any]:
    rooms = bench.some((0, 50, 200, 500, 1000, 2000, 4000), quick=1)
    return [functools.partial(fill_study, bench, room) for room in rooms]


def fill_study(bench: Bench, room: int) -> Any:
    undisturbed(bench)
    study = Study(bench)
    disk = on_small_disk_at(bench, study.folder, room)
    outcome = study.run()
    said = "had room; same answer"
    if outcome.status != 0:
        if not outcome.says("traceResidual: "):
            raise Wrong(f"{room} KiB: status {outcome.status}, {outcome.last_words}")
        said = "stopped with a message, then the same answer"
    room_again(bench, disk)
    study.settle()
    return said


@fault(
    "a run of a study starts a child that ignores SIGTERM, and is too long for simulator.timeLimit",
    "nobody lives on when the study has ended",
)
def time_limit(bench: Bench) -> list[Any]:
    return [functools.partial(over_time, bench)]


def over_time(bench: Bench) -> str:
    study = Study(bench)
    allrun = study.folder / "case/Allrun"
    allrun.write_text("#!/bin/bash\ntrap '' TERM\n(trap '' TERM; sleep 1000) &\nsetsid sleep 1000 &\nsleep 1000\n")
    os.chmod(allrun, 0o755)
    text = (study.folder / "study.yaml").read_text()
    text = text.replace("  seed: seed\n", "  seed: seed\n  timeLimit: 0.5\n", 1)
    text = text.replace("processes: 1 }", "processes: 40 }")
    (study.folder / "study.yaml").write_text(text + "failures: { attempts: 1, then: stop }\n")
    outcome = study.run()
    if outcome.status == 0:
        raise Wrong("the study went well")
    if bench.alive():
        raise Wrong(f"{len(bench.alive())} processes live on")
    return "stopped, nobody lives on"
