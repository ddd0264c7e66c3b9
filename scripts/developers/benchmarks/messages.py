"""What the ranks of one run send each other in a coupling step, and their memory, against their number: counts, no
times."""

import functools
import json
import shutil
from pathlib import Path
from typing import Any, Callable

from clepsydra import environment
from developers.benchmarks.hopper import Hopper

from . import timing

RANKS = (2, 4, 8)
INTERVALS = 5


def messages_per_interval(hopper: Hopper, repetitions: int) -> timing.Figure:
    return figure(
        hopper,
        "messages that the busiest rank sends in a coupling step",
        lambda rank: sum(phase["messages"] for phase in rank["phases"].values()),
    )


def reductions_per_step(hopper: Hopper, repetitions: int) -> timing.Figure:
    """A count of the program itself: those of OpenFOAM's solvers and of LIGGGHTS are not in it."""
    run = hopper.run("submerged", "reductions", INTERVALS * hopper.parameters["couplingTimeStep"], 2)
    return timing.Figure(
        [timing.timed(run).result["reductionsPerStep"]],
        target="<= 5",
        meaning="times in a coupling step that all ranks wait for each other in a reduction of the coupling",
    )


def bytes_per_rank(hopper: Hopper, repetitions: int) -> timing.Figure:
    return figure(hopper, "bytes of memory of the largest rank", lambda rank: rank["peakMemory"])


def figure(hopper: Hopper, meaning: str, quantity: Callable[[dict[str, Any]], float]) -> timing.Figure:
    """Of the most ranks; of fewer in the details."""
    counts = measured(hopper)
    values = {ranks: max(quantity(rank) for rank in of) for ranks, of in counts.items()}
    return timing.Figure(
        [values[RANKS[-1]]],
        meaning=f"{meaning}, {RANKS[-1]} ranks, submerged hopper",
        details={"ranks": values, "largestOfPhase": {ranks: largest(of) for ranks, of in counts.items()}},
    )


def largest(of_ranks: Any) -> dict[Any, Any]:
    """Of each phase and quantity, the most that a rank has."""
    return {
        phase: {name: max(rank["phases"][phase][name] for rank in of_ranks) for name in of}
        for phase, of in of_ranks[0]["phases"].items()
    }


@functools.cache
def measured(hopper: Hopper) -> dict[Any, Any]:
    """What tests/benchmarks/countMessages.cpp has written, a list of ranks for each number of them. Once: they are
    counts."""
    return {ranks: counted(hopper, ranks) for ranks in RANKS}


def counter() -> Path:
    return environment.build() / "lib" / "libcountMessages.so"


def counted(hopper: Hopper, ranks: int) -> list[Any]:
    return counts_of(
        hopper.run("submerged", f"messagesOn{ranks}", INTERVALS * hopper.parameters["couplingTimeStep"], ranks)
    )


def counts_of(run: timing.Run) -> list[Any]:
    """What each rank of a run has sent in a coupling step, by phase."""
    if not counter().exists():
        raise timing.Skipped(
            f"there is no {counter()}: 'cmake --build {environment.build()} --target countMessages' makes it"
        )
    counts = run.folder / "counts"
    shutil.rmtree(counts, ignore_errors=True)
    counts.mkdir()
    run.command[1:1] = ["-x", f"MESSAGE_COUNTS={counts}", "-x", f"LD_PRELOAD={counter()}"]
    timing.timed(run)
    files = sorted(counts.glob("*.json"), key=lambda file: int(file.stem))
    return [json.loads(file.read_text()) for file in files]
