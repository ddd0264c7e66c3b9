"""OpenFOAM's own DPMFoam on the cases of cases/validation/besideDPMFoam: particles, mesh, inlet, drag and contact law
alike."""

import shutil
from typing import Any

from clepsydra import parameter_file

from . import timing
from .hopper import Hopper, forget_results


def over_dpm_foam(hopper: Hopper, repetitions: int) -> timing.Figure:
    """Contacts are rare: DPMFoam takes few DEM steps."""
    return over(hopper, repetitions, "settling", "settlingCloud 0.06", "391 particles settling in water, .06 s")


def over_dpm_foam_bed(hopper: Hopper, repetitions: int) -> timing.Figure:
    """The case's fluid step is as short as DPMFoam needs it for a bed."""
    return over(
        hopper,
        repetitions,
        "fluidised",
        'inBoth fluidised inletVelocity="constant (0 0 0.044)" endTime=0.04',
        "500 particles in a fluidised bed, .04 s",
    )


def over(hopper: Hopper, repetitions: int, run: Any, make: Any, said: str) -> timing.Figure:
    if not shutil.which("DPMFoam"):
        raise timing.Skipped("there is no program DPMFoam in this OpenFOAM")
    folder = hopper.validation_case("besideDPMFoam")
    Hopper.in_folder(folder, f". ./Allrun; rm -rf runs; {make}; inEachRun solveInBoth")
    ours = folder / "runs" / run
    theirs = ours / "DPMFoam"
    times = timing.interleaved(
        {
            "DPMFoam": timing.Run(["DPMFoam"], theirs, prepare=lambda: forget_results(theirs)),
            "ours": timing.Run(["pimpleDemFoam"], ours, prepare=lambda: forget_results(ours)),
        },
        repetitions,
    )
    step = parameter_file.parameters(ours / "parameters")["couplingTimeStep"]
    return timing.processor_ratio(
        times,
        "DPMFoam",
        "ours",
        ">= 10",
        f"processor time of DPMFoam over pimpleDemFoam; {said}; fluid's step {1e6 * step:g} us in both",
    )
