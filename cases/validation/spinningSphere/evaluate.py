#!/usr/bin/python3
"""How the spin of a sphere dies away in liquid, what the liquid receives of it, and how far the lift carries the
sphere, against exact solutions and against the equations of motion of one sphere, integrated here."""

from math import exp, pi, sqrt
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, parameter_file, validation

STOKES = "Stokes' torque, exact"
DENNIS = "Dennis, Singh & Ingham 1980, integrated"
FLIGHT = "equations of motion of one sphere, integrated"
BALANCE = "angular momentum that the sphere has lost"
TOLERANCE = 0.5
FLIGHT_TOLERANCE = 2
SPIN = 100.0  # rad/s


class Sphere:
    def __init__(self, run: Path):
        p = parameter_file.parameters(run / "parameters")
        self.diameter = p["particleDiameter"]
        self.density = p["particleDensity"]
        self.fluid_density = p["fluidDensity"]
        self.viscosity = p["fluidDensity"] * p["fluidViscosity"]
        self.duration = p["endTime"]
        self.release_speed = p["releaseSpeed"]
        self.mass = self.density * pi / 6 * self.diameter**3
        self.inertia = 0.1 * self.mass * self.diameter**2
        self.added_mass = p["addedMassCoefficient"] * self.mass * self.fluid_density / self.density

    def rotation_reynolds(self, spin: float) -> float:
        return self.fluid_density * abs(spin) * self.diameter**2 / self.viscosity

    def dennis_torque(self, spin: float) -> float:
        reynolds = self.rotation_reynolds(spin)
        if reynolds == 0:
            return 0
        coefficient = max(64 * pi / reynolds, 12.9 / sqrt(reynolds) + 128.4 / reynolds)
        return -0.5 * self.fluid_density * (self.diameter / 2) ** 5 * coefficient * abs(spin) * spin

    def stokes_spin(self) -> float:
        time = self.density * self.diameter**2 / (60 * self.viscosity)
        return SPIN * exp(-self.duration / time)

    def rates(self, state: np.ndarray, torque: bool) -> np.ndarray:
        """Of (x, z, vx, vz, spin about y)."""
        velocity, spin = state[2:4], state[4]
        speed = float(np.hypot(*velocity))
        reynolds = self.fluid_density * speed * self.diameter / self.viscosity
        force = -3 * pi * self.viscosity * self.diameter * (1 + 0.15 * reynolds**0.687) * velocity
        turning = self.rotation_reynolds(spin)
        if turning > 0 and reynolds > 0:
            ratio = turning / reynolds
            coefficient = 0.45 + (ratio - 0.45) * exp(-0.05684 * turning**0.4 * reynolds**0.3)
            # spin x velocity, with the spin along y: (spin vz, 0, -spin vx)
            across = np.array([velocity[1], -velocity[0]]) * np.sign(spin)
            force = force + pi / 8 * self.fluid_density * self.diameter**2 * coefficient * speed * across
        return np.array(
            [
                *velocity,
                *(force / (self.mass + self.added_mass)),
                self.dennis_torque(spin) / self.inertia if torque else 0,
            ]
        )

    def flight(self, torque: bool) -> np.ndarray:
        state = np.array([0, 0, 0, -self.release_speed, SPIN])
        steps = 2000
        step = self.duration / steps
        for _ in range(steps):
            k1 = self.rates(state, torque)
            k2 = self.rates(state + step / 2 * k1, torque)
            k3 = self.rates(state + step / 2 * k2, torque)
            k4 = self.rates(state + step * k3, torque)
            state = state + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        return state


def track(run: str) -> np.ndarray:
    """Columns id, position, velocity, spin; one row per coupling step."""
    return np.array([entry[0] for _, entry in case_files.dumped_particles(Path("runs") / run, "DEM/spin.dump")])


def spin_row(run: str, name: str, reference: float, source: str) -> dict[str, Any]:
    ours = float(track(run)[-1, 8])
    return validation.row(name, "rad/s", reference, source, "computed", ours, 1e-3, TOLERANCE)


def angular_momentum_of_fluid(run: str, about: np.ndarray) -> float:
    """About the y axis through a point."""
    folder = Path("runs") / run
    p = parameter_file.parameters(folder / "parameters")
    size, across, high = p["cellSize"], int(p["cellsAcross"]), int(p["cellsHigh"])
    velocity = case_files.field(folder, case_files.times(folder)[-1], "U").reshape(high, across, across, 3)
    x = (np.arange(across) + 0.5) * size - 0.5 * across * size - about[0]
    z = (np.arange(high) + 0.5) * size - about[2]
    moment = z[:, None, None] * velocity[..., 0] - x[None, None, :] * velocity[..., 2]
    return float(p["fluidDensity"] * size**3 * np.sum(moment))


def main() -> None:
    creeping, dennis, neutral, flight = (
        Sphere(Path("runs") / name) for name in ("creeping", "dennis", "neutral", "flight")
    )
    rows = [
        spin_row("creeping", "spin after 0.1 s, Stokes' law", creeping.stokes_spin(), STOKES),
        spin_row("dennis", "spin after 0.1 s, Dennis' law", float(dennis.flight(True)[4]), DENNIS),
        spin_row("neutral", "spin after 0.1 s, density of water", float(neutral.flight(True)[4]), DENNIS),
    ]
    neutral_track = track("neutral")
    lost = neutral.inertia * (SPIN - float(neutral_track[-1, 8]))
    received = angular_momentum_of_fluid("neutral", neutral_track[-1, 1:4])
    rows.append(
        validation.row(
            "angular momentum of the water, density of water",
            "kg m2/s",
            lost,
            BALANCE,
            "computed",
            received,
            1e-4 * lost,
            TOLERANCE,
        )
    )
    for name, run, torque in (("", "flight", True), (", without torque", "flightWithoutTorque", False)):
        reference = float(flight.flight(torque)[0])
        positions = track(run)[:, 1]
        rows.append(
            validation.row(
                f"sideways way in flight{name}",
                "m",
                reference,
                FLIGHT,
                "computed",
                float(positions[-1] - positions[0]),
                1e-3 * abs(reference),
                FLIGHT_TOLERANCE,
            )
        )
    validation.write(rows)


if __name__ == "__main__":
    main()
