"""The quick hopper under water on two cores from the first particle that leaves to the last, and both media against an
earlier version."""

import os
import shutil
from pathlib import Path

from clepsydra.environment import REPOSITORY

from . import timing
from .hopper import Hopper, conservation

DURATION = 0.5  # [s] of flow, of both versions


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


def over_last(hopper: Hopper, repetitions: int) -> timing.Figure:
    return over_earlier_version(hopper, repetitions, "submerged", ">= 2.0")


def over_last_dry(hopper: Hopper, repetitions: int) -> timing.Figure:
    return over_earlier_version(hopper, repetitions, "dry", ">= 1.6")


def over_earlier_version(hopper: Hopper, repetitions: int, step: str, target: str) -> timing.Figure:
    """Each version with its own case, meshes and scripts, filled by itself; one rank."""
    if "CLEPSYDRA_LAST" not in os.environ:
        raise timing.Skipped("CLEPSYDRA_LAST names no folder in which an earlier version has been built")
    last = Path(os.environ["CLEPSYDRA_LAST"]).resolve()
    versions = {"last": last, "this": REPOSITORY}
    times = timing.interleaved(
        {name: own_step(hopper.folder / f"{name}-{step}", of, step) for name, of in versions.items()}, repetitions
    )
    seconds = {
        name: [sum(time.result["phaseProcessorSeconds"].values()) / time.result["timeEnd"] for time in of]
        for name, of in times.items()
    }
    return timing.Figure(
        [a / b for a, b in zip(seconds["last"], seconds["this"])],
        target=target,
        meaning=(
            f"processor time of the first {DURATION} s of flow, {step}, that of the version in CLEPSYDRA_LAST over ours"
        ),
        details={"processorSecondsASecond": seconds},
    )


def own_step(folder: Path, checkout: Path, step: str) -> timing.Run:
    """The step by a version's own Allrun."""
    case = Hopper(folder, quick=True, repository=checkout, dryTime=DURATION, submergedTime=DURATION).case
    own = f"export CLEPSYDRA_BUILD={checkout}/build; . {checkout}/scripts/environment"
    Hopper.in_folder(case, f"{own}; ./Allrun mesh filling")
    steps = case / "steps" / step
    return timing.Run(
        ["bash", "-c", f"{own}; ./Allrun {step}"],
        case,
        prepare=lambda: shutil.rmtree(steps, ignore_errors=True),
        result=lambda: conservation(steps),
    )
