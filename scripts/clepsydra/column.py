"""What a run of a column left: shared by the evaluate of the cases that have the column as their template."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, closures, parameter_file

GRAVITY = 9.81


class Column:
    def __init__(self, run: Path | str) -> None:
        self.run = Path(run)
        self.parameters = parameter_file.parameters(self.run / "parameters")

    def __getitem__(self, name: str) -> Any:
        """An entry of the run's parameters."""
        try:
            return self.parameters[name]
        except KeyError:
            raise KeyError(f"{self.run}/parameters has no entry {name}") from None

    @property
    def area(self) -> float:
        """Of the cross-section, a square unless the run has a depth [m2]."""
        return float(self["width"] * self.parameters.get("depth", self["width"]))

    @property
    def particle_volume(self) -> float:
        return np.pi / 6 * self["particleDiameter"] ** 3

    @property
    def load(self) -> float:
        """Buoyant weight of all particles per cross-section [Pa]."""
        return (
            self["particleCount"]
            * self.particle_volume
            * (self["particleDensity"] - self["fluidDensity"])
            * GRAVITY
            / self.area
        )

    def terminal_velocity(self) -> float:
        return closures.value("terminalVelocity", **self.closure_options())

    def closure_options(self) -> dict[str, Any]:
        return {
            name: self[name]
            for name in ("dragLaw", "particleDiameter", "particleDensity", "fluidDensity", "fluidViscosity")
        }

    def pressure_drop(self) -> tuple[np.ndarray, np.ndarray]:
        """Times and the pressure at the bottom face above that at the top [Pa], without its hydrostatic part."""
        time, p = case_files.surface_values(self.run, "bottomPressure")
        return time, self["fluidDensity"] * p[:, 0]

    def top_velocity(self) -> tuple[np.ndarray, np.ndarray]:
        """Times and the mean velocity at the top: the superficial one, where the fluid is clear."""
        time, velocity = case_files.surface_values(self.run, "topVelocity")
        return time, velocity[:, 2]

    def times(self) -> list[str]:
        return case_files.times(self.run)

    def layers(self, time: str, name: str, component: int = 0) -> np.ndarray:
        """Mean of a field over each layer of cells, from the bottom up."""
        values = case_files.field(self.run, time, name)[:, component]
        layers = int(self["cellsUp"])
        return values.reshape(layers, -1).mean(axis=1) if len(values) > 1 else np.full(layers, values[0])

    def heights(self) -> np.ndarray:
        """Middles of the layers of cells [m]."""
        return (np.arange(self["cellsUp"]) + 0.5) * self["height"] / self["cellsUp"]

    def particles(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Times, positions and velocities (time, particle, axis) of all particles."""
        entries = case_files.dumped_particles(self.run)
        start = entries[0][0]
        time = np.array([(step - start) * self["demStep"] for step, _ in entries])
        rows = np.array([particles for _, particles in entries])
        return time, rows[:, :, 1:4], rows[:, :, 4:7]
