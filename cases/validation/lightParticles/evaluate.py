#!/usr/bin/python3
"""Compares the velocity of rising suspensions with the one that the drag law gives a uniform suspension."""

from pathlib import Path
from typing import Any

from clepsydra import closures, validation
from clepsydra.column import Column

ZONE = (0.4, 0.7)  # of the height: below the packing at the lid, above the clear fluid
STEADY = (0.3, 0.8)  # of the run: after the start, before the clear fluid reaches the zone


def rows(run: Any) -> list[Any]:
    column = Column(run)
    time, position, velocity = column.particles()
    height = position[:, :, 2] / column["height"]
    steady = [i for i, t in enumerate(time) if STEADY[0] <= t / time[-1] <= STEADY[1]]
    inside = [(height[i] > ZONE[0]) & (height[i] < ZONE[1]) for i in steady]
    speeds = [velocity[i][some, 2].mean() for i, some in zip(steady, inside) if some.any()]
    layers = column.heights() / column["height"]
    zone = (layers > ZONE[0]) & (layers < ZONE[1])
    eps = sum(
        column.layers(at, "voidFraction")[zone].mean()
        for at in column.times()
        if STEADY[0] <= float(at) / time[-1] <= STEADY[1]
    )
    eps /= sum(STEADY[0] <= float(at) / time[-1] <= STEADY[1] for at in column.times())
    expected = closures.value("hinderedSettlingVelocity", voidFraction=eps, **column.closure_options())
    ours = sum(speeds) / len(speeds)
    error = (sum((v - ours) ** 2 for v in speeds) / max(len(speeds) - 1, 1) / len(speeds)) ** 0.5
    print(f"{run.name}: void fraction {eps:.3f}, rises at {ours:.5f} m/s, uniform suspension {expected:.5f} m/s")
    return [
        validation.row(
            f"velocity of rise, {run.name}",
            "m/s",
            expected,
            f"{column['dragLaw']} in a uniform suspension of {column['particleDensity']:.0f} kg/m3",
            "computed",
            ours,
            error,
            3,
        )
    ]


validation.write([found for run in sorted(Path("runs").iterdir()) for found in rows(run)])
