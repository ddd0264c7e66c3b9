#!/usr/bin/python3
"""Discharges hoppers that clog, again and again, and writes one row for each clog to results/runs/events.csv.

usage: discharge.py [CONDITION ...]      those of conditions.yaml; all unless named
       discharge.py --quick              the small hopper of conditions.yaml, one event; writes results/quick.csv

Each event is a run of its own, in work/<condition>/steps/event: the first of a filling begins when the plug is gone,
each other with what the event before has left, without the particles of the arch (in.clogging); water is at rest. It
ends when no particle has left for 0.3 s, which is a clog, or when fewer particles are left than the file says; then the
hopper is filled again. Ctrl-C and SIGTERM write a checkpoint, and the same command resumes. Where work/ is gone, the
rows that are there count, and another seed follows."""

from __future__ import annotations

import argparse
import csv
import itertools
import os
import re
import resource
import shutil
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from clepsydra import case_files, environment, hopper_run, parameter_file, seeds
from clepsydra.parameter_studies import task

HERE = Path(__file__).resolve().parent
TEMPLATE = environment.REPOSITORY / "cases/tutorials/hopperQuick"
FIRST_SEED = 100003
EVENT = "event"  # the step of an event
START, END = "start.restart", "end.restart"
MOST_ATTEMPTS = 5  # at an arch that does not break; then another filling
CLOGGED, LOW, BLOCKED = "clogged", "low", "blocked"


@dataclass(frozen=True)
class Event:
    """One row of the table."""

    condition: str
    seed: int
    number: int  # from 0 on, of the filling
    start: int  # particles in the hopper, without the arch
    left: int  # particles that left until it clogged, or until the hopper was low
    seconds: float  # until the last of them left
    end: str  # clogged; low: fewer are left than count; blocked: none has left, so that the arch was not broken
    cpuSeconds: float  # since the program was started last; number 0 includes mesh and filling
    code: str


class Table:
    """The rows on disk, each written as it comes."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.rows = read(path)

    def append(self, event: Event) -> None:
        self.path.parent.mkdir(parents=True, exist_ok=True)
        is_new = not self.path.exists()
        with open(self.path, "a", newline="") as file:
            table = csv.DictWriter(file, [field.name for field in fields(Event)], lineterminator="\n")
            if is_new:
                table.writeheader()
            table.writerow(asdict(event))
            file.flush()
            os.fsync(file.fileno())
        self.rows.append(event)

    def of(self, condition: str) -> list[Event]:
        return [row for row in self.rows if row.condition == condition]


def read(path: Path) -> list[Event]:
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return [
            Event(**{field.name: CONVERT[str(field.type)](row[field.name]) for field in fields(Event)})
            for row in csv.DictReader(file)
        ]


CONVERT: dict[str, Any] = {"str": str, "int": int, "float": float}


class Hopper:
    """The hopper of one condition, in a copy of the template."""

    def __init__(self, name: str, settings: dict[str, Any], work: Path, table: Table, signals: Any) -> None:
        self.name = name
        self.settings = settings
        self.condition = settings["conditions"][name]
        self.folder = work / name
        self.table = table
        # one for all fillings: it holds the lock of the folder
        self.case = hopper_run.HopperCase(self.made_folder(), ["filling", EVENT], 1, signals)
        self.signals = signals

    def discharge(self, clogs: int) -> None:
        """Until so many clogs have been counted."""
        while sum(row.end == CLOGGED for row in self.table.of(self.name)) < clogs:
            self.discharge_once()

    def discharge_once(self) -> None:
        """One event, the rest of one that was stopped, or the first of a new filling."""
        seed, before = self.seed(), cpu_seconds()
        self.fill(seed)
        row = self.next_event(seed, before)
        self.table.append(row)
        print(f"{self.name}: {row.left} particles left in {row.seconds:.2f} s, {row.end}", flush=True)

    def seed(self) -> int:
        """Of the filling that is being discharged, or of the next."""
        rows = self.table.of(self.name)
        if not rows:
            return FIRST_SEED
        last = rows[-1].seed
        begun = sum(row.seed == last for row in rows) == self.number_on_disk()
        held = len(rows) >= MOST_ATTEMPTS and all(row.end == BLOCKED for row in rows[-MOST_ATTEMPTS:])
        goes_on = rows[-1].end != LOW and not held and (begun or (self.event_folder / END).exists())
        return last if goes_on else next(itertools.islice(seeds.seeds_from(last), 1, None))

    def number_on_disk(self) -> int | None:
        """Of the event whose folder is there, begun or ended."""
        note = self.event_folder / "number"
        return int(note.read_text()) if note.exists() else None

    @property
    def event_folder(self) -> Path:
        return self.folder / "steps" / EVENT

    def fill(self, seed: int) -> None:
        """Makes mesh and filling of that seed, where they are not there."""
        said = self.folder / "parameters"
        if int(parameter_file.parameters(said)["seed"]) != seed:
            shutil.rmtree(self.folder / "steps", ignore_errors=True)
        text = parameter_file.with_parameters(parameter_file.read(TEMPLATE / "parameters"), self.parameters(seed), said)
        said.write_text(text)
        if not (self.folder / "constant/polyMesh/madeFrom").is_file():
            self.case.run_parts(["mesh"])
        if not self.case.has_ended("filling"):
            self.case.run_parts(["filling"])

    def parameters(self, seed: int) -> dict[str, str]:
        given = self.settings["parameters"] | {
            "orificeDiameter": self.condition["hole"] * float(self.settings["parameters"]["particleDiameter"]),
            "friction": self.condition["friction"],
            "seed": seed,
        }
        return {name: f"{value}" for name, value in given.items()}

    def made_folder(self) -> Path:
        if self.folder.exists():
            return self.folder
        unfinished = self.folder.with_name(f"{self.name}.unfinished")
        task.copy_case(TEMPLATE, unfinished)
        shutil.copy(HERE / "in.clogging", unfinished / "DEM")
        shutil.copy(TEMPLATE / "DEM/in.discharge.groups", unfinished / "DEM/in.clogging.groups")
        orifice = self.parameters(FIRST_SEED)["orificeDiameter"]
        (unfinished / "DEM/in.orifice").write_text(f"variable        orificeDiameter equal {orifice}\n")
        unfinished.rename(self.folder)
        return self.folder

    def next_event(self, seed: int, cpu_before: float) -> Event:
        """Begun, or resumed from its checkpoint."""
        rows = [row for row in self.table.of(self.name) if row.seed == seed]
        number = len(rows)
        if self.number_on_disk() != number:
            self.begin(number)
        step = hopper_run.Step(self.event_folder)
        while True:
            hopper_run.run_here(self.event_folder, 1, self.signals)
            time, _, particles = case_files.columns(self.event_folder, "massInHopper")[:3]
            clogged = "no particle has left since" in step.log.read_text(errors="replace")
            is_low = particles[-1] < self.settings["countedAbove"]
            if clogged or is_low or particles[-1] == particles[0]:
                break
            self.lengthen(time[-1] + self.settings["slice"])
        low = self.settings["countedAbove"]
        end = LOW if is_low else CLOGGED if clogged else BLOCKED
        counted = np.maximum(particles, low)
        last = int(np.flatnonzero(counted == counted[-1])[0])
        code = task.code_versions(step.log)[-1]
        return Event(
            self.name,
            seed,
            number,
            int(particles[0]),
            int(particles[0] - counted[-1]),
            round(float(time[last]), 4),
            end,
            round(cpu_seconds() - cpu_before, 1),
            code,
        )

    def begin(self, number: int) -> None:
        """The event's folder, with what the event before has left."""
        (self.folder / f"step.{EVENT}").write_text(
            '#include "../../parameters"\n\n'
            f"stepFluid      {self.condition['fluid']};\n"
            f'stepScript     "DEM/in.{"clogging" if number else "discharge"}";\n'
            f"stepEndTime    {self.settings['firstLook']};\n"
            f'stepRestart    "{END}";\n'
        )
        kept = self.folder / START
        files = ("", ".sha256") if number else ()  # the solver holds the file against its checksum
        for ending in files:
            shutil.copy(f"{self.event_folder / END}{ending}", f"{kept}{ending}")
        shutil.rmtree(self.event_folder, ignore_errors=True)
        self.case.step_folder(EVENT)
        for ending in files:
            Path(f"{kept}{ending}").rename(self.event_folder / f"{START}{ending}")
        (self.event_folder / "number").write_text(f"{number}\n")

    def lengthen(self, end_time: float) -> None:
        """The same run goes on: it is resumed from its last checkpoint."""
        path = self.event_folder / "step"
        path.write_text(re.sub(r"stepEndTime\s+\S+;", f"stepEndTime    {end_time:g};", path.read_text()))
        (self.event_folder / END).unlink(missing_ok=True)


def cpu_seconds() -> float:
    """Of all programs that have been started from here, and ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    settings = yaml.safe_load((HERE / "conditions.yaml").read_text())
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("conditions", nargs="*", metavar="CONDITION")
    options = parser.parse_args()
    for name in options.conditions:
        if name not in settings["conditions"]:
            parser.error(f"no condition '{name}'; allowed: {', '.join(settings['conditions'])}")
    os.nice(10)
    signals = hopper_run.Signals()
    with hopper_run.reported("clogging"):
        signals.install()
        if options.quick:
            small = settings.pop("quick")
            settings["parameters"] |= small["parameters"]
            settings["countedAbove"] = small["countedAbove"]
            table = Table(HERE / "results/quick.csv")
            Hopper(small["condition"], settings, HERE / "work-quick", table, signals).discharge_once()
            return
        table = Table(HERE / "results/runs/events.csv")
        for name in options.conditions or settings["conditions"]:
            clogs = settings["conditions"][name]["clogs"]
            Hopper(name, settings, HERE / "work", table, signals).discharge(clogs)


if __name__ == "__main__":
    main()
