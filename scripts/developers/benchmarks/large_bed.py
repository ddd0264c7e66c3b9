"""A million particles in a million cells on two ranks against a fiftieth of both: what grows faster than the bed
does."""

import functools
import math
import shutil
from typing import Any

from clepsydra.environment import REPOSITORY

from . import memory, timing
from .hopper import Hopper, conservation, forget_results, solver

BOXES = (2, 1, 1)  # of the ranks, along x, y and z
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
    beds = {
        name: bed(hopper, f"{name}Bed.{fluid}", *size, BOXES, fluid=fluid)
        for name, size in (("small", SMALL), ("large", LARGE))
    }
    return timing.interleaved(beds, repetitions)


def bed(hopper: Hopper, name: str, particles: Any, cells: Any, boxes: tuple[int, int, int], **entries: Any) -> Any:
    """The still bed whose memory is measured, with the hopper's solver of the pressure, decomposed into boxes."""
    steps = {"couplingTimeStep": DEM_STEPS * 1e-5, "endTime": INTERVALS * DEM_STEPS * 1e-5}
    folder = memory.column(hopper, particles, cells, **{**steps, **entries}).folder
    case = folder.with_name(name)
    shutil.rmtree(case, ignore_errors=True)
    folder.rename(case)
    for file in ("fvSolution", "decomposeParDict"):
        shutil.copy(REPOSITORY / "cases/tutorials/hopperQuick/system" / file, case / "system")
    script = case / "DEM/in.column"
    # the same boxes as the mesh's
    script.write_text(f"processors {' '.join(map(str, boxes))} map xyz\n" + script.read_text())
    ranks = math.prod(boxes)
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
                "ranks": ranks,
                **{f"ranksAlong{axis}": along for axis, along in zip("XYZ", boxes)},
            }.items()
        )
    )
    if ranks > 1:
        Hopper.in_folder(case, "decomposePar > log.decomposePar 2>&1")
    return timing.Run(solver(ranks), case, prepare=lambda: forget_results(case), result=lambda: conservation(case))
