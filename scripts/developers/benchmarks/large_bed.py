"""A million particles in a million cells on two ranks against a fiftieth of both: what grows faster than the bed
does."""

import functools
import shutil
from typing import Any

from clepsydra.environment import REPOSITORY

from . import memory, timing
from .hopper import Hopper, conservation, forget_results, solver

RANKS = 2
INTERVALS = 40
DEM_STEPS = 20  # in a coupling step

# Particles along a side and up, cells along a side and up. As many coupling steps of both: the first finds all
# particles again.
SMALL = (20, 50), (20, 50)
LARGE = (100, 100), (100, 100)

OF_PARTICLES = ("DEM", "locate", "distribute", "exchange", "forces")
OF_CELLS = ("momentum", "pressure", "smooth")


def million_particles(hopper: Hopper, repetitions: int) -> timing.Figure:
    return growth(hopper, repetitions, "incompressible", OF_PARTICLES, "a particle and DEM step", "particle")


def million_particles_dry(hopper: Hopper, repetitions: int) -> timing.Figure:
    return growth(hopper, repetitions, "none", OF_PARTICLES, "a particle and DEM step, without fluid", "particle")


def million_cells(hopper: Hopper, repetitions: int) -> timing.Figure:
    return growth(hopper, repetitions, "incompressible", OF_CELLS, "a cell and step of the fluid", "cell")


def growth(hopper: Hopper, repetitions: int, fluid: Any, phases: Any, said: str, unit: str) -> timing.Figure:
    times = measured(hopper, repetitions, fluid)
    seconds = {
        name: [per_unit(time.result["phaseSeconds"], phases, size, unit) for time in times[name]]
        for name, size in (("large", LARGE), ("small", SMALL))
    }
    return timing.Figure(
        [sum(large.values()) / sum(small.values()) for large, small in zip(seconds["large"], seconds["small"])],
        target="<= 1.3",
        meaning=f"wall time of {said} on two ranks, a million of each over 20,000 ({', '.join(phases)})",
        details={
            "seconds": seconds,
            "peakMemoryOfARank": {name: [time.peak_memory for time in times[name]] for name in times},
        },
    )


def per_unit(seconds: Any, phases: Any, size: Any, unit: str) -> dict[Any, Any]:
    """Seconds of each phase, of which there are fewer without fluid, for one particle and DEM step or one cell and step
    of the fluid."""
    (across, up), (cells_across, cells_up) = size
    units = INTERVALS * (across**2 * up * DEM_STEPS if unit == "particle" else cells_across**2 * cells_up)
    return {phase: seconds[phase] / units for phase in phases if phase in seconds}


@functools.cache
def measured(hopper: Hopper, repetitions: int, fluid: Any) -> Any:
    beds = {name: bed(hopper, name, fluid, *size) for name, size in (("small", SMALL), ("large", LARGE))}
    return timing.interleaved(beds, repetitions)


def bed(hopper: Hopper, name: str, fluid: Any, particles: Any, cells: Any) -> Any:
    """The still bed whose memory is measured, with the hopper's solver of the pressure, decomposed."""
    folder = memory.column(
        hopper, particles, cells, fluid=fluid, couplingTimeStep=DEM_STEPS * 1e-5, endTime=INTERVALS * DEM_STEPS * 1e-5
    ).folder
    case = folder.with_name(f"{name}Bed.{fluid}")
    shutil.rmtree(case, ignore_errors=True)
    folder.rename(case)
    for file in ("fvSolution", "decomposeParDict"):
        shutil.copy(REPOSITORY / "cases/tutorials/hopperQuick/system" / file, case / "system")
    script = case / "DEM/in.column"
    script.write_text(f"processors {RANKS} 1 1\n" + script.read_text())  # the same boxes as the mesh's
    (case / "step").write_text(
        "".join(
            f"{entry} {value:g};\n"
            for entry, value in {
                **{
                    entry: hopper.parameters[entry]
                    for entry in (
                        "pressureTolerance",
                        "velocityTolerance",
                        "outerCorrectors",
                        "pressureCorrectors",
                        "nonOrthogonalCorrectors",
                    )
                },
                "ranks": RANKS,
                "ranksAlongX": RANKS,
                "ranksAlongY": 1,
                "ranksAlongZ": 1,
            }.items()
        )
    )
    Hopper.in_folder(case, "decomposePar > log.decomposePar 2>&1")
    return timing.Run(solver(RANKS), case, prepare=lambda: forget_results(case), result=lambda: conservation(case))
