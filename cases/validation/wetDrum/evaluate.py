#!/usr/bin/python3
"""The torque with which a turning drum carries its particles, against the torque of their weight, in water and dry."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, parameter_file, validation

BALANCE = "torque of the particles' weight less buoyancy"
BALANCE_DRY = "torque of the particles' weight"
GRAVITY = 9.81
# What the liquid takes up while it is still being accelerated, and the scatter of momentary forces
TOLERANCE = 4


class Drum:
    """Means over the steady part of a run."""

    def __init__(self, name: str):
        run = Path("runs") / name
        p = parameter_file.parameters(run / "parameters")
        volume = np.pi / 6 * p["particleDiameter"] ** 3
        wet = p["fluid"] != "none"
        weight = volume * (p["particleDensity"] - wet * p["fluidDensity"]) * GRAVITY
        radius = 0.5 * p["drumDiameter"]
        entries = [
            particles
            for step, particles in case_files.dumped_particles(run, "DEM/drum.dump")
            if step * p["demStep"] >= p["steadyTime"]
        ]
        self.count = len(entries[0])
        self.torques = np.array([wall_torque(particles, radius, p["particleDiameter"]) for particles in entries])
        self.weights = np.array([weight * particles[:, 1].sum() for particles in entries])
        centres = np.array([particles[:, 1:3].mean(axis=0) for particles in entries])
        # of the line from the axis through the centre of mass, against the vertical
        self.angles = np.degrees(np.arctan2(centres[:, 0], -centres[:, 1]))


def wall_torque(particles: np.ndarray, radius: float, diameter: float) -> float:
    """Of the drum on the particles, about its axis. A particle touches the drum where the radius through it ends."""
    touching = particles[np.linalg.norm(particles[:, 1:3], axis=1) > radius - 0.5 * diameter]
    position, force = touching[:, 1:3], touching[:, 8:10]
    contact = radius * position / np.linalg.norm(position, axis=1)[:, None]
    return float(np.sum(contact[:, 0] * force[:, 1] - contact[:, 1] * force[:, 0]))


def standard_error(values: np.ndarray, parts: int = 5) -> float:
    """Of a mean over time, from means over its parts."""
    means = [part.mean() for part in np.array_split(values, parts)]
    return float(np.std(means, ddof=1) / np.sqrt(parts))


def balance(drum: Drum, name: str, source: str) -> dict[str, Any]:
    return validation.row(
        f"torque of the drum, {name}",
        "N m",
        float(drum.weights.mean()),
        source,
        "computed",
        float(drum.torques.mean()),
        standard_error(drum.torques - drum.weights),
        TOLERANCE,
    )


def main() -> None:
    wet, dry = Drum("wet"), Drum("dry")
    print(f"{wet.count} particles")
    for name, drum in (("water", wet), ("dry", dry)):
        print(f"{name}: bed at {drum.angles.mean():.2f} +- {standard_error(drum.angles):.2f} degrees")
    validation.write([balance(wet, "in water", BALANCE), balance(dry, "dry", BALANCE_DRY)])


if __name__ == "__main__":
    main()
