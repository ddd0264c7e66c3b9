"""Particles that a drum about the z axis carries: the torque of the drum on them, that of their weight, and the slope
of the bed, from the dump of a case like the tutorial wetDrum."""

from pathlib import Path

import numpy as np

from clepsydra import case_files, parameter_file

GRAVITY = 9.81


class Drum:
    """One value for each time of the dump: times [s], torques on the particles about the axis [N m], of the drum and of
    the weight less buoyancy (its sign turned), and angles [degrees] of the line from the axis through the centre of
    mass, against the vertical."""

    def __init__(self, case: Path):
        p = parameter_file.parameters(case / "parameters")
        volume = np.pi / 6 * p["particleDiameter"] ** 3
        in_water = p["fluid"] != "none"
        weight = volume * (p["particleDensity"] - in_water * p["fluidDensity"]) * GRAVITY
        radius = 0.5 * p["drumDiameter"]
        steps, entries = zip(*case_files.dumped_particles(case, "DEM/drum.dump"))
        self.count = len(entries[-1])
        self.last = entries[-1]
        self.times = p["demStep"] * np.array(steps)
        self.steady = self.times >= p["steadyTime"]
        self.torques = np.array([wall_torque(particles, radius, p["particleDiameter"]) for particles in entries])
        self.weights = np.array([weight * particles[:, 1].sum() for particles in entries])
        centres = np.array([particles[:, 1:3].mean(axis=0) for particles in entries])
        self.angles = np.degrees(np.arctan2(centres[:, 0], -centres[:, 1]))


def wall_torque(particles: np.ndarray, radius: float, diameter: float) -> float:
    """Of the drum on the particles, about its axis. A particle touches the drum where the radius through it ends."""
    touching = particles[np.linalg.norm(particles[:, 1:3], axis=1) > radius - 0.5 * diameter]
    position, force = touching[:, 1:3], touching[:, 8:10]
    contact = radius * position / np.linalg.norm(position, axis=1)[:, None]
    return float(np.sum(contact[:, 0] * force[:, 1] - contact[:, 1] * force[:, 0]))
