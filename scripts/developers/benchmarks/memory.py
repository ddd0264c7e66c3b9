"""Memory of pimpleDemFoam against particles and cells: a still bed on a lattice in a column, a few steps."""

import functools
import shutil
from typing import Any

import numpy as np

from clepsydra.environment import REPOSITORY

from . import timing
from .hopper import Hopper, forget_results

COLUMN = REPOSITORY / "cases" / "validation" / "common" / "column"
DIAMETER = 1e-3

# Particles along a side and up, cells along a side and up. The paper's hopper: .02 million particles, 1.5 million
# cells.
QUICK = [((20, 50), (10, 25)), ((40, 60), (10, 25)), ((20, 50), (40, 60)), ((40, 60), (40, 60))]
FULL = QUICK + [((100, 100), (50, 50)), ((20, 50), (100, 150)), ((70, 100), (35, 50)), ((20, 50), (60, 100))]

# Particles that touch, six contacts each.
SCRIPT = """include DEM/in.settings
region domain block 0 ${width} 0 ${width} 0 ${height} units box
create_box 2 domain
variable bounce equal ${restitution}
include DEM/in.box
fix gravity all gravity 9.81 vector 0 0 -1
lattice sc ${particleDiameter} origin 0.5 0.5 0.5
variable top equal ${particleDiameter}*${particlesUp}
region bed block 0 ${width} 0 ${width} 0 ${top} units box
create_atoms 1 region bed
set group all diameter $(1.0001*v_particleDiameter) density ${particleDensity}
fix motion all nve/sphere
"""


def bytes_per_particle(hopper: Hopper, repetitions: int) -> timing.Figure:
    return slope(hopper, repetitions, "particles")


def bytes_per_cell(hopper: Hopper, repetitions: int) -> timing.Figure:
    return slope(hopper, repetitions, "cells")


def slope(hopper: Hopper, repetitions: int, quantity: str) -> timing.Figure:
    fits = measured(hopper, repetitions)
    return timing.Figure(
        [fit[quantity] for fit in fits],
        meaning=f"bytes of one more of the {quantity}, from peaks of memory fitted as a + b particles + c cells",
        details={"fits": fits},
    )


@functools.cache
def measured(hopper: Hopper, repetitions: int) -> Any:
    """A fit a repetition; memory hardly scatters, so that where the benchmark is not quick there is only one."""
    sizes = QUICK if hopper.quick else FULL
    fits = []
    for _ in range(2 if hopper.quick else 1):
        counts = np.array(
            [[across**2 * up, cells_across**2 * cells_up] for (across, up), (cells_across, cells_up) in sizes]
        )
        peaks = np.array([timing.timed(column(hopper, *size)).peak_memory for size in sizes])
        terms = np.column_stack([np.ones(len(counts)), counts])
        # Relative errors count: a million particles must not hide twenty thousand.
        values = np.linalg.lstsq(terms / peaks[:, None], np.ones(len(peaks)), rcond=None)[0]
        worst = abs(terms @ values / peaks - 1).max()
        fits.append(
            {
                "constant": values[0],
                "particles": values[1],
                "cells": values[2],
                "worstErrorPercent": 100 * worst,
                "sizes": counts.tolist(),
                "peaks": peaks.tolist(),
            }
        )
    return fits


def column(hopper: Hopper, particles: Any, cells: Any, **entries: Any) -> Any:
    (across, up), (cells_across, cells_up) = particles, cells
    folder = hopper.folder / "memory"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(COLUMN, folder)
    (folder / "DEM" / "in.column").write_text(SCRIPT.replace("${particlesUp}", str(up)))
    (folder / "system" / "functions").write_text("")
    values = {
        "width": across * DIAMETER,
        "height": (up + 4) * DIAMETER,
        "cellsAcross": cells_across,
        "cellsUp": cells_up,
        "particleCount": across**2 * up,
        "smoothingBandwidth": 1.5e-3,
        "endTime": 1e-4,
        "couplingTimeStep": 5e-5,
        "writeInterval": 1,
        **entries,
    }
    Hopper.set_parameters(folder / "parameters", values)
    Hopper.in_folder(folder, "blockMesh > log.blockMesh 2>&1")
    return timing.Run(["pimpleDemFoam"], folder, prepare=lambda: forget_results(folder))
