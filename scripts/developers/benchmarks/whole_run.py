"""The quick hopper under water on two cores: from the first particle that leaves to the last, and against an earlier
version."""

import os
import shutil
from pathlib import Path
from typing import Any

from clepsydra.environment import REPOSITORY

from . import timing
from .hopper import Hopper, conservation
from .two_ranks import loop_seconds

DURATION = 1  # [s] of flow, of both versions
ADAPTIVE = "adjustableCouplingTimeStep yes;\nmaxCo 0.5;\nminInterval 4e-4;\nmaxInterval 4e-3;\n"


def quick_hopper_submerged(hopper: Hopper, repetitions: int) -> timing.Figure:
    """Always the 3000 particles of the case; where the benchmark is quick, once."""
    run = hopper.quick_one().run("submerged", "whole", float(hopper.parameters["submergedTime"]), 2)
    times = timing.interleaved({"whole": run}, 1 if hopper.quick else repetitions)["whole"]
    return timing.Figure(
        [time.wall for time in times],
        target="<= 60",
        meaning="s wall time, submerged quick hopper until its flow ends, 2 ranks",
        details={"simulated": times[0].result["timeEnd"], "phases": [time.result["phaseSeconds"] for time in times]},
    )


def quick_hopper_over_last(hopper: Hopper, repetitions: int) -> timing.Figure:
    """Each version with its own case, meshes and scripts, filled by itself; the last one as its case is."""
    if "CLEPSYDRA_LAST" not in os.environ:
        raise timing.Skipped("CLEPSYDRA_LAST names no folder in which an earlier version has been built")
    last = Path(os.environ["CLEPSYDRA_LAST"]).resolve()
    runs = {
        name: submerged(hopper.folder / name, checkout, entries)
        for name, checkout, entries in (
            ("last", last, ""),
            ("this", REPOSITORY, ""),
            ("thisAdaptive", REPOSITORY, ADAPTIVE),
        )
    }
    times = timing.interleaved(runs, repetitions)
    wall = {name: [loop_seconds(time.result) / time.result["timeEnd"] for time in of] for name, of in times.items()}
    return timing.Figure(
        [a / b for a, b in zip(wall["last"], wall["thisAdaptive"])],
        target=">= 3",
        meaning=(
            f"wall time of the first {DURATION} s of flow without the start, that of the version in CLEPSYDRA_LAST over"
            " ours with an adaptive interval, 2 ranks"
        ),
        details={"wallSecondsASecond": wall},
    )


def submerged(folder: Path, checkout: Any, entries: Any) -> Any:
    """The submerged step by a version's own Allrun."""
    case = Hopper(folder, quick=True, repository=checkout, submergedTime=DURATION).case
    with open(case / "constant/couplingProperties", "a") as settings:
        settings.write(entries)
    own = f"export CLEPSYDRA_BUILD={checkout}/build; . {checkout}/scripts/environment"
    Hopper.in_folder(case, f"{own}; ./Allrun mesh filling")
    step = case / "steps/submerged"
    return timing.Run(
        ["bash", "-c", f"{own}; ./Allrun -np 2 submerged"],
        case,
        prepare=lambda: shutil.rmtree(step, ignore_errors=True),
        result=lambda: conservation(step),
    )
