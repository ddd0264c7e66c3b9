"""What the pressure costs a cell as the mesh grows: the quick hopper's particles in three meshes."""

from pathlib import Path
from typing import Any

from developers.benchmarks.hopper import Hopper

from . import timing
from .cost_model import cell_count

# Width of the cells near the hopper [m] and how long the particles discharge [s]: 12,000, 53,000 and 1.5 million cells.
MESHES = ((2.5e-3, 0.1), (1.5e-3, 0.05), (5e-4, 0.01))


def microseconds_per_cell(hopper: Hopper, repetitions: int) -> timing.Figure:
    """Of one step of the fluid, processor time on one rank."""
    quick = hopper.quick_one()
    runs = {}
    for cell_size, duration in MESHES:
        mesh = quick if cell_size == quick.parameters["cellSize"] else quick.with_cells(cell_size)
        runs[cell_size] = mesh.run("submerged", "pressure", duration)
    times = timing.interleaved(runs, repetitions)
    spent = {
        cell_count(runs[cell_size].folder): [
            1e6
            * time.result["phaseProcessorSeconds"]["pressure"]
            / cell_steps(time.result, runs[cell_size].folder, quick)
            for time in times[cell_size]
        ]
        for cell_size, _ in MESHES
    }
    return timing.Figure(
        spent[max(spent)],
        meaning=f"us of the pressure a cell and step, {max(spent)} cells, processor time on one rank",
        details={
            "byCells": spent,
            "peakMemory": {cell_size: [time.peak_memory for time in of] for cell_size, of in times.items()},
        },
    )


def cell_steps(conservation: dict[str, Any], folder: Path, hopper: Hopper) -> Any:
    return (
        cell_count(folder)
        * (conservation["timeEnd"] - conservation["timeStart"])
        / hopper.parameters["couplingTimeStep"]
    )
