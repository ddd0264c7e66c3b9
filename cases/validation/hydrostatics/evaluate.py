#!/usr/bin/python3
"""Compares the pressure with the hydrostatic one and the bed with itself before the water came."""

import sys
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import validation
from clepsydra.column import GRAVITY, Column
from clepsydra.picture_style import pyplot

# The springs of the contacts carry less when the water comes. That motion is over after [s]:
QUIET = 0.1
# By it a particle that lay on top of others may begin to roll, slowly at first, as in five of eight runs (four
# packings, both models). While one moves faster than this part of the terminal velocity, the bed does not lie still;
ROLLS = 0.002
# and so long it has to [s].
STILL = 0.1


def rows(run: Any) -> list[Any]:
    """What must stay: the pressure of still water, and the particles where they lie."""
    name, column = run.name, Column(run)
    particle_time, position, velocity = column.particles()
    start = still_from(name, particle_time, np.linalg.norm(velocity, axis=2).max(axis=1) / column.terminal_velocity())
    time, drop = column.pressure_drop()
    excess = drop[time > start]
    hydrostatic = column["fluidDensity"] * GRAVITY * column["height"]
    height = position[:, :, 2].mean(axis=1)
    quiet = particle_time > start
    print(
        f"{name}: from {start:.2f} s on excess pressure {excess.mean():+.2e} Pa (at most {np.abs(excess).max():.1e}),"
        f" buoyant weight {column.load:.1f} Pa; fastest particle"
        f" {np.linalg.norm(velocity[quiet], axis=2).max():.1e} m/s, terminal velocity"
        f" {column.terminal_velocity():.3f} m/s"
    )
    worst = excess[np.abs(excess).argmax()]
    return [
        # .2 % of the bed's weight: what the springs' last motion may leave
        validation.row(
            f"dp over the height, {name}",
            "Pa",
            hydrostatic,
            "rho g H",
            "computed",
            hydrostatic + worst,
            excess.std(),
            0.1,
        ),
        # the springs shorten by some 1e-3 d per layer when 40 % of their load goes
        validation.row(
            f"mean height of the particles, {name}",
            "m",
            height[0],
            "the bed before the water came",
            "computed",
            height[-1],
            height[quiet].std(),
            0.5,
        ),
    ]


def still_from(name: str, time: np.ndarray, fastest: np.ndarray) -> float:
    """Time from which on no particle rolls."""
    start = max(time[fastest > ROLLS], default=0)
    if time[-1] - start < STILL:
        sys.exit(
            f"hydrostatics: {name}: a particle moves with {fastest[-1]:.2g} terminal velocities at {start:.2f} s still"
        )
    return max(start, QUIET)


def plot(runs: Any) -> None:
    figure, (pressure, speed) = pyplot.subplots(2, sharex=True, figsize=(6, 6))
    for run in runs:
        column = Column(run)
        time, drop = column.pressure_drop()
        pressure.plot(time, 100 * drop / column.load, label=run.name)
        particle_time, _, velocity = column.particles()
        speed.semilogy(particle_time, np.linalg.norm(velocity, axis=2).max(axis=1) / column.terminal_velocity() + 1e-12)
    pressure.axhline(0, color="black", linewidth=0.5)
    pressure.set_ylabel("pressure beside the hydrostatic one\n[% of the bed's buoyant weight]")
    pressure.legend()
    speed.set_ylabel("fastest particle / terminal velocity")
    speed.set_xlabel("time since the water came [s]")
    figure.tight_layout()
    figure.savefig("results/hydrostatics.png", dpi=120)


runs = sorted(Path("runs").iterdir())
validation.write([found for run in runs for found in rows(run)])
plot(runs)
