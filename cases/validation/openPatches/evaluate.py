#!/usr/bin/python3
"""Compares what the particles, their balances and the water say of each other, and the rate of a hopper with itself."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, validation
from clepsydra.column import Column
from clepsydra.picture_style import pyplot

# Part of the run by which the flow has become steady.
STEADY = 1 / 3


class InsertionAndRemoval:
    """The table of particleFlux."""

    def __init__(self, run: Any) -> None:
        self.column = Column(run)
        table = case_files.columns(run, "particleFlux")
        self.time = table[0]
        self.inserted_particles, self.inserted = table[1], table[2]
        # six columns for each outlet
        self.left_particles, self.left = table[7::6].sum(axis=0), table[8::6].sum(axis=0)

    @property
    def particle_mass(self) -> Any:
        return self.column.particle_volume * self.column["particleDensity"]

    def rate(self, start: Any, end: Any) -> Any:
        """Mean mass per time that leaves between two parts of the run."""
        first, last = (np.searchsorted(self.time, part * self.time[-1]) for part in (start, end))
        return (self.left[last - 1] - self.left[first]) / (self.time[last - 1] - self.time[first])


def balances_row(run: Any, balance: Any) -> Any:
    """The engine's particles as the conservation check counts them, against what the table and the start say."""
    summary = json.loads(next((run / "postProcessing/conservation").glob("*/summary.json")).read_text())
    inside = summary["particlesEnd"] * balance.particle_mass
    expected = balance.column["particleCount"] * balance.particle_mass + balance.inserted[-1] - balance.left[-1]
    print(
        f"{run.name}: {balance.inserted_particles[-1]:.0f} particles inserted,"
        f" {balance.left_particles[-1]:.0f} left, {summary['particlesEnd']} inside; error of the volume"
        f" that came and went {summary['insertionError']:.1e}, of momentum {summary['momentumError']:.1e}"
    )
    largest = balance.column["particleCount"] * balance.particle_mass + balance.inserted[-1]
    return validation.row(
        f"left and inside over start and inserted, {run.name}",
        "-",
        1,
        "no particle is lost",
        "computed",
        (inside - expected + largest) / largest,
        1e-9,
        1e-6,
    )


def water_row(run: Any, balance: Any) -> Any:
    """The floor holds the water: what the particles leave behind comes in at the top."""
    time, flux = case_files.surface_values(run, "topFlow")
    came_in = -flux[:, 0].sum() * balance.column["couplingTimeStep"]
    left = balance.left[-1] / balance.column["particleDensity"]
    return validation.row(
        "water in at the top over the particles' volume that left, sieve",
        "-",
        1,
        "continuity",
        "computed",
        came_in / left,
        1e-4,
        0.1,
    )


def rate_row(runs: Any) -> Any:
    """Over all hoppers: what leaves in the second part of the steady time over what leaves in the first."""
    middle = (1 + STEADY) / 2
    ratios = [balance.rate(middle, 1) / balance.rate(STEADY, middle) for balance in runs]
    # Particles are counted one by one, and leave a hopper more evenly than by chance.
    particles = sum((balance.left_particles[-1] for balance in runs))
    print("rate of the hopper, later over earlier: " + ", ".join(f"{ratio:.3f}" for ratio in ratios))
    return validation.row(
        "rate of a hopper that is refilled, later over earlier",
        "-",
        1,
        "a steady flow",
        "computed",
        float(np.mean(ratios)),
        float(2 / np.sqrt(particles)),
        10,
    )


def plot(runs: Any) -> None:
    figure, axes = pyplot.subplots(figsize=(6, 4))
    for balance in runs:
        name = balance.column.run.name
        (line,) = axes.plot(balance.time, 1e3 * balance.left, label=f"{name}, left")
        axes.plot(
            balance.time,
            1e3 * balance.inserted,
            ":",
            color=line.get_color(),
            label=f"{name}, inserted",
        )
    axes.set_xlabel("time [s]")
    axes.set_ylabel("mass [g]")
    axes.legend()
    figure.tight_layout()
    figure.savefig("results/openPatches.png", dpi=120)


runs = [(run, InsertionAndRemoval(run)) for run in sorted(Path("runs").iterdir())]
hoppers = [balance for run, balance in runs if run.name != "sieve"]
validation.write(
    [balances_row(*found) for found in runs]
    + [water_row(*found) for found in runs if found[0].name == "sieve"]
    + [rate_row(hoppers)]
)
plot([balance for _, balance in runs])
