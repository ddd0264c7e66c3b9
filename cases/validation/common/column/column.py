"""What a run of a column left: shared by the evaluate of the cases that have the column as their template."""

import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[4]
sys.path.insert(0, str(ROOT / "scripts"))
import caseFiles
import closures

GRAVITY = 9.81


class Column:
    def __init__(self, run):
        self.run = Path(run)
        self.parameters = caseFiles.parameters(self.run / "parameters")

    def __getattr__(self, name):
        """An entry of the run's parameters."""
        try:
            return self.parameters[name]
        except KeyError:
            raise AttributeError(f"{self.run}/parameters has no entry {name}") from None

    @property
    def area(self):
        return self.width**2

    @property
    def particleVolume(self):
        return np.pi / 6 * self.particleDiameter**3

    @property
    def load(self):
        """Buoyant weight of all particles per cross-section [Pa]."""
        return self.particleCount * self.particleVolume * (self.particleDensity - self.fluidDensity) * GRAVITY / self.area

    def terminalVelocity(self):
        return closures.value("terminalVelocity", **self.closureOptions())

    def closureOptions(self):
        return {name: getattr(self, name)
                for name in ("dragLaw", "particleDiameter", "particleDensity", "fluidDensity", "fluidViscosity")}

    def pressureDrop(self):
        """Times and the pressure at the bottom face above that at the top [Pa], without its hydrostatic part."""
        time, p = caseFiles.surfaceValues(self.run, "bottomPressure")
        return time, self.fluidDensity * p[:, 0]

    def topVelocity(self):
        """Times and the mean velocity at the top: the superficial one, where the fluid is clear."""
        time, velocity = caseFiles.surfaceValues(self.run, "topVelocity")
        return time, velocity[:, 2]

    def times(self):
        return caseFiles.times(self.run)

    def layers(self, time, name, component=0):
        """Mean of a field over each layer of cells, from the bottom up."""
        values = caseFiles.field(self.run, time, name)[:, component]
        layers = int(self.cellsUp)
        return values.reshape(layers, -1).mean(axis=1) if len(values) > 1 else np.full(layers, values[0])

    def heights(self):
        """Middles of the layers of cells [m]."""
        return (np.arange(self.cellsUp) + 0.5) * self.height / self.cellsUp

    def particles(self):
        """Times, positions and velocities (time, particle, axis) of all particles."""
        entries = caseFiles.dumpedParticles(self.run)
        start = entries[0][0]
        time = np.array([(step - start) * self.demStep for step, _ in entries])
        rows = np.array([particles for _, particles in entries])
        return time, rows[:, :, 1:4], rows[:, :, 4:7]
