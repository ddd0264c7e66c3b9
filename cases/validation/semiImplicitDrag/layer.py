"""The layer of cells with a particle in the middle of each, as the run's parameters have it."""

import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path[:0] = [str(Path(__file__).resolve().parent.parent / "common/column"),
                str(Path(__file__).resolve().parent.parent / "../../scripts")]
from column import Column
import numpy as np

# Small enough for convection to be nothing, and for free particles to stay in their cells.
SPEED = {"wave": 1e-3, "vortex": 1e-3, "uniform": 0.05}


class Layer(Column):
    @property
    def cellWidth(self):
        return self.width / self.cellsAcross

    def centres(self):
        """Of the cells, x fastest [m]."""
        up, across = int(self.cellsUp), int(self.cellsAcross)
        return [((i + 0.5) * self.cellWidth, 0.5 * self.cellWidth, (k + 0.5) * self.height / up)
                for k in range(up) for i in range(across)]

    def velocity(self, start):
        x, _, z = np.array(self.centres()).T
        zero, x, z = 0 * x, np.pi * x / self.width, np.pi * z / self.height
        return SPEED[start] * np.column_stack({
            "wave": (zero, zero, np.cos(x)),
            "vortex": (np.sin(x) * np.cos(z), zero, -np.cos(x) * np.sin(z)),
            "uniform": (zero, zero, zero + 1)}[start])

    @property
    def waterMass(self):
        """In a cell [kg]."""
        return self.fluidDensity * (self.cellWidth**2 * self.height / self.cellsUp - self.particleVolume)

    @property
    def particleMass(self):
        return self.particleDensity * self.particleVolume

    def dragFactor(self, dragTime):
        """By which Stokes' drag is K couplingTimeStep/waterMass = dragTime."""
        stokes = 3 * np.pi * self.fluidDensity * self.fluidViscosity * self.particleDiameter
        return dragTime * self.waterMass / self.couplingTimeStep / stokes

    def leftBySmoothing(self):
        """Of the wave's amplitude: it is an eigenvector of the cells' Laplacian."""
        eigenvalue = 2 * (1 - np.cos(np.pi / self.cellsAcross)) / self.cellWidth**2
        return np.exp(-self.smoothingBandwidth**2 / 4 * eigenvalue)
