"""What the pressure costs a cell as the mesh grows: the quick hopper's particles in three meshes."""

from . import timing
from .costModel import cellCount

# Width of the cells near the hopper [m] and how long the particles discharge [s]: 12,000, 53,000 and 1.5 million cells.
MESHES = ((2.5e-3, 0.1), (1.5e-3, 0.05), (5e-4, 0.01))


def microsecondsPerCell(hopper, repetitions):
    """Of one step of the fluid, processor time on one rank."""
    quick = hopper.quickOne()
    runs = {}
    for cellSize, duration in MESHES:
        mesh = quick if cellSize == quick.parameters["cellSize"] else quick.withCells(cellSize)
        runs[cellSize] = mesh.run("submerged", "pressure", duration)
    times = timing.interleaved(runs, repetitions)
    spent = {cellCount(runs[cellSize].folder):
             [1e6 * time.result["phaseProcessorSeconds"]["pressure"] / cellSteps(time.result, runs[cellSize].folder, quick)
              for time in times[cellSize]] for cellSize, _ in MESHES}
    return timing.Figure(spent[max(spent)], meaning=f"us of the pressure a cell and step, {max(spent)} cells, processor time on one rank",
                         details={"byCells": spent, "peakMemory": {cellSize: [time.peakMemory for time in of] for cellSize, of in times.items()}})


def cellSteps(conservation, folder, hopper):
    return cellCount(folder) * (conservation["timeEnd"] - conservation["timeStart"]) / hopper.parameters["couplingTimeStep"]
