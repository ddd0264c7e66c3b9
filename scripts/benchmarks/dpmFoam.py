"""OpenFOAM's own DPMFoam on the cases of cases/validation/besideDPMFoam: particles, mesh, inlet, drag and contact law alike."""

import shutil

from . import timing
from .hopper import Hopper, caseFiles, forgetResults


def overDPMFoam(hopper, repetitions):
    """Contacts are rare: DPMFoam takes few DEM steps."""
    return over(hopper, repetitions, "settling", "settlingCloud 0.06", "391 particles settling in water, .06 s")


def overDPMFoamBed(hopper, repetitions):
    """The case's fluid step is as short as DPMFoam needs it for a bed."""
    return over(hopper, repetitions, "fluidised", 'inBoth fluidised inletVelocity="constant (0 0 0.044)" endTime=0.04',
                "500 particles in a fluidised bed, .04 s")


def over(hopper, repetitions, run, make, said):
    if not shutil.which("DPMFoam"):
        raise timing.Skipped("there is no program DPMFoam in this OpenFOAM")
    folder = hopper.validationCase("besideDPMFoam")
    Hopper.inFolder(folder, "sed '$d' Allrun > functions; . ./functions; rm -rf runs; "
                            f"{make}; inEachRun solveInBoth")
    ours = folder / "runs" / run
    theirs = ours / "DPMFoam"
    times = timing.interleaved({
        "DPMFoam": timing.Run(["DPMFoam"], theirs, prepare=lambda: forgetResults(theirs)),
        "ours": timing.Run(["pimpleDemFoam"], ours, prepare=lambda: forgetResults(ours)),
    }, repetitions)
    step = caseFiles.parameters(ours / "parameters")["couplingTimeStep"]
    return timing.processorRatio(times, "DPMFoam", "ours", ">= 10",
                                 f"processor time of DPMFoam over pimpleDemFoam; {said}; fluid's step {1e6 * step:g} us in both")
