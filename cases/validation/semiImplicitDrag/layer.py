"""The layer of cells with a particle in the middle of each, as the run's parameters have it."""

from typing import Any

import numpy as np

from clepsydra.column import Column

# Small enough for convection to be nothing, and for free particles to stay in their cells.
SPEED = {"wave": 1e-3, "vortex": 1e-3, "uniform": 0.05}


class Layer(Column):
    @property
    def cell_width(self) -> Any:
        return self["width"] / self["cellsAcross"]

    def centres(self) -> list[tuple[Any, Any, Any]]:
        """Of the cells, x fastest [m]."""
        up, across = int(self["cellsUp"]), int(self["cellsAcross"])
        return [
            ((i + 0.5) * self.cell_width, 0.5 * self.cell_width, (k + 0.5) * self["height"] / up)
            for k in range(up)
            for i in range(across)
        ]

    def velocity(self, start: Any) -> Any:
        x, _, z = np.array(self.centres()).T
        zero, x, z = 0 * x, np.pi * x / self["width"], np.pi * z / self["height"]
        return SPEED[start] * np.column_stack(
            {
                "wave": (zero, zero, np.cos(x)),
                "vortex": (np.sin(x) * np.cos(z), zero, -np.cos(x) * np.sin(z)),
                "uniform": (zero, zero, zero + 1),
            }[start]
        )

    @property
    def water_mass(self) -> Any:
        """In a cell [kg]."""
        return self["fluidDensity"] * (self.cell_width**2 * self["height"] / self["cellsUp"] - self.particle_volume)

    @property
    def particle_mass(self) -> Any:
        return self["particleDensity"] * self.particle_volume

    def drag_factor(self, drag_time: Any) -> Any:
        """By which Stokes' drag is K couplingTimeStep/waterMass = dragTime."""
        stokes = 3 * np.pi * self["fluidDensity"] * self["fluidViscosity"] * self["particleDiameter"]
        return drag_time * self.water_mass / self["couplingTimeStep"] / stokes

    def left_by_smoothing(self) -> Any:
        """Of the wave's amplitude: it is an eigenvector of the cells' Laplacian."""
        eigenvalue = 2 * (1 - np.cos(np.pi / self["cellsAcross"])) / self.cell_width**2
        return np.exp(-self["smoothingBandwidth"] ** 2 / 4 * eigenvalue)
