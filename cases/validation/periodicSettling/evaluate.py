#!/usr/bin/python3
"""Compares the exponent n of w = v_t eps^n, with w relative to the mean of particles and water, with the one that the
drag law implies and with Richardson & Zaki's, and the momentum of particles and water with what it was."""

import re
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, closures, validation
from clepsydra.column import Column, GRAVITY

SETTLED = 0.5  # of the run: after the start
# The pressure is corrected twice in a coupling step, not until nothing changes: what that leaves of the equation.
PRESSURE_CORRECTION_PERCENT = 0.2


class Suspension:
    """A run; velocities are upwards."""

    def __init__(self, run: Path) -> None:
        column = self.column = Column(run)
        self.volume = column["width"] ** 3
        self.count = column["particlesAcross"] ** 3
        self.solid = self.count * column.particle_volume / self.volume
        self.void_fraction = 1 - self.solid
        time, _, velocities = column.particles()
        particles = velocities[:, :, 2].mean(axis=1)
        table = case_files.columns(run, "waterVelocity", "volFieldValue.dat")
        # There is no row at the start, when both are at rest.
        water = np.interp(time, np.append(0, table[0]), np.append(0, table[3]))
        late = time > SETTLED * time[-1]
        # The box moves with neither: the velocity counts that is relative to all volume in it.
        self.velocity = float(self.void_fraction * (water - particles)[late].mean())
        self.momentum = self.gained(particles[-1], water[-1]) / self.impulse(time[-1])

    def impulse(self, time: float) -> float:
        """Of the particles' weight less their buoyancy, downwards [N s]."""
        column = self.column
        return (
            self.count * column.particle_volume * (column["particleDensity"] - column["fluidDensity"]) * GRAVITY * time
        )

    def gained(self, particles: float, water: float) -> float:
        """Momentum of particles and water at the end, downwards, with what is on its way between them [N s]. Both were
        at rest."""
        column = self.column
        of_particles = column["particleDensity"] * self.solid * self.volume * particles
        of_water = column["fluidDensity"] * self.void_fraction * self.volume * water
        return -(of_particles + of_water + self.semi_implicit())

    def semi_implicit(self) -> float:
        """At the end, along z [N s]."""
        log = self.column.run / ("log.mpirun" if "Ranks" in self.column.run.name else "log.pimpleDemFoam")
        return float(re.findall(r"of which semi-implicit \(\S+ \S+ (\S+)\)", log.read_text())[-1])


def exponent(void_fraction: np.ndarray, relative_velocity: np.ndarray) -> tuple[float, float]:
    """n of w/v_t = eps^n by least squares in logarithms, and its standard error."""
    x, y = np.log(void_fraction), np.log(relative_velocity)
    n = (x * y).sum() / (x * x).sum()
    return n, np.sqrt(((y - n * x) ** 2).sum() / (len(x) - 1) / (x * x).sum())


class Packing:
    """The concentrations of one particle in one fluid, each in one arrangement."""

    def __init__(self, runs: list[Path]) -> None:
        self.suspensions = sorted((Suspension(run) for run in runs), key=lambda one: one.void_fraction)
        self.void_fraction = np.array([one.void_fraction for one in self.suspensions])
        self.velocity = np.array([one.velocity for one in self.suspensions])
        column = self.column = self.suspensions[0].column
        self.terminal = column.terminal_velocity()
        self.law = closures.values(
            "hinderedSettlingVelocity", voidFraction=self.void_fraction, **column.closure_options()
        )
        self.n, _ = exponent(self.void_fraction, self.velocity / self.terminal)
        self.laws_n, _ = exponent(self.void_fraction, self.law / self.terminal)
        # the law's n varies with eps: what scatters is the ratio to it
        _, self.error = exponent(self.void_fraction, self.velocity / self.law)


class Family:
    """The same in several arrangements."""

    def __init__(self, name: str, packings: list[Packing]) -> None:
        self.name = name
        self.packings = packings
        self.column = packings[0].column
        self.n = float(np.mean([one.n for one in packings]))
        self.laws_n = packings[0].laws_n
        self.error = packings[0].error
        if len(packings) > 1:
            self.error = float(np.std([one.n for one in packings], ddof=1) / np.sqrt(len(packings)))
        self.terminal = packings[0].terminal
        self.reynolds = self.terminal * self.column["particleDiameter"] / self.column["fluidViscosity"]
        self.richardson_zaki = closures.value("richardsonZakiExponent", reynolds=self.reynolds, diameterRatio=0)
        self.title = f"Re {self.reynolds:.2g}, {name}"

    def show(self) -> None:
        print(
            f"{self.title}: v_t {self.terminal:.4f} m/s, n {self.n:.3f} +- {self.error:.3f}, the law's"
            f" {self.laws_n:.3f}, Richardson & Zaki's {self.richardson_zaki:.3f}"
        )
        for one in self.packings:
            print(
                "    velocity beside the law's [%] "
                + ", ".join(
                    f"{100 * (v / law - 1):+.2f} at eps {eps:.3f}"
                    for eps, v, law in zip(one.void_fraction, one.velocity, one.law)
                )
                + f"; n {one.n:.3f}"
            )

    def rows(self) -> list[dict[str, Any]]:
        law = self.column["dragLaw"]
        return [
            validation.row(
                f"n, {self.title}",
                "1",
                self.laws_n,
                f"{law} in a uniform suspension",
                "computed",
                self.n,
                self.error,
                2,
                self.convection(),
            ),
            # scatter of the measurements behind the formula
            validation.row(
                f"n, {self.title} ",
                "1",
                self.richardson_zaki,
                "Richardson & Zaki 1954, formula without walls",
                "measured",
                self.n,
                self.error,
                10,
                self.laws_own() or self.convection(),
            ),
            self.momentum_row(),
        ]

    def momentum_row(self) -> dict[str, Any]:
        worst = max((one.momentum for packing in self.packings for one in packing.suspensions), key=abs)
        return validation.row(
            f"weight's impulse that the pressure gradient takes up, {self.title}",
            "1",
            1,
            "momentum of particles and water together",
            "computed",
            1 - worst,
            PRESSURE_CORRECTION_PERCENT / 100,
            PRESSURE_CORRECTION_PERCENT,
        )

    def convection(self) -> str | None:
        """A finding where the water is free to circulate."""
        across = self.column["cellsAcross"]
        if across == 1:
            return None
        return (
            f"with {across:.0f} cells across, n is {self.n - self.laws_n:+.2f} from the law's: crowded parts of a"
            " random suspension sink as streams and the particles of a stream in each other's wake, while the law's"
            " velocity is that of a uniform suspension; with one cell across, where the water cannot circulate,"
            " it is the law's"
        )

    def laws_own(self) -> str | None:
        """A finding where the drag law itself has another exponent."""
        if abs(self.laws_n / self.richardson_zaki - 1) < 0.1:
            return None
        return (
            f"{self.column['dragLaw']} in a uniform suspension has n {self.laws_n:.2f}, the formula"
            f" {self.richardson_zaki:.2f}"
        )


def ranks_rows(serial: Family, divided: Family) -> list[dict[str, Any]]:
    """The first arrangement on one rank and on two."""
    one, two = serial.packings[0], divided.packings[0]
    row = validation.row(
        f"n on two ranks, {serial.title}",
        "1",
        one.n,
        "the same arrangement on one rank",
        "computed",
        two.n,
        serial.error,
        2,
    )
    return [row, divided.momentum_row()]


def main() -> None:
    families: dict[str, dict[str, list[Path]]] = {}
    for run in sorted(Path("runs").iterdir()):
        name, packing, _ = run.name.split("-")
        families.setdefault(name, {}).setdefault(packing, []).append(run)
    found = {name: Family(name, [Packing(runs) for runs in of.values()]) for name, of in families.items()}
    rows = []
    for name, family in found.items():
        family.show()
        rows += ranks_rows(found["sixCells"], family) if name == "sixCellsRanks" else family.rows()
    validation.write(rows)


if __name__ == "__main__":
    main()
