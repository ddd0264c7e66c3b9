"""Times programs in turn, so that a machine that grows faster or slower does so for all of them."""

import os
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Mapping


@dataclass
class Figure:
    """What one entry of the benchmark measured, one value a repetition."""

    values: list[Any]
    meaning: str
    target: str = ""
    details: dict[Any, Any] = field(default_factory=dict)

    @property
    def median(self) -> float:
        return statistics.median(self.values)


# Timed programs push all other work on this machine aside (root only).
real_time = False


def push_others_aside() -> None:
    os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))


def priority() -> Callable[[], None] | None:
    """For a subprocess, to be run in it before its program begins."""
    return push_others_aside if real_time else None


class Skipped(Exception):
    """Why an entry cannot be measured here."""


@dataclass
class Run:
    """A command, the folder it runs in, what it must find there and what it left: neither is timed."""

    command: list[Any]
    folder: Path
    prepare: Callable[[], Any] | None = None
    result: Callable[[], Any] | None = None


@dataclass
class Time:
    wall: float
    processor: float  # user and system, of the command and all its children
    peak_memory: int  # of the largest of its processes [bytes]
    result: Any = None


def timed(run: Run) -> Time:
    """Runs it once; ends the benchmark with its last lines where it fails."""
    if run.prepare:
        run.prepare()
    log = run.folder / "log.timed"
    with open(log, "w") as output:
        start = time.monotonic()
        process = subprocess.Popen(
            run.command,
            cwd=run.folder,
            stdout=output,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
            preexec_fn=priority(),
        )
        _, status, used = os.wait4(process.pid, 0)
        wall = time.monotonic() - start
        process.returncode = os.waitstatus_to_exitcode(status)
    if status != 0:
        lines = log.read_text(errors="replace").splitlines()[-20:]
        sys.exit("\n".join(lines + [f"benchmark: {' '.join(map(str, run.command))} failed in {run.folder}"]))
    return Time(wall, used.ru_utime + used.ru_stime, 1024 * used.ru_maxrss, run.result and run.result())


def interleaved(runs: Mapping[Any, Run], repetitions: int) -> dict[Any, list[Time]]:
    """Times of each run by its name: A B ... A B ..., `repetitions` of each."""
    times: Any = {name: [] for name in runs}
    for _ in range(repetitions):
        for name, run in runs.items():
            times[name].append(timed(run))
    return times


def processor_ratio(times: Mapping[Any, list[Time]], slow: str, fast: str, target: str, meaning: str) -> Figure:
    """A figure of slow/fast in processor time, one value a repetition."""
    processor = {name: [time.processor for time in of] for name, of in times.items()}
    return Figure([a / b for a, b in zip(processor[slow], processor[fast])], meaning, target, details=processor)
