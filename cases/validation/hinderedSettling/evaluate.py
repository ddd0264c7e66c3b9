#!/usr/bin/python3
"""Compares the exponent n of v = v_t eps^n with the one that the drag law implies, and with Richardson & Zaki's."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import closures, validation
from clepsydra.column import Column
from clepsydra.picture_style import pyplot

ZONE = (0.3, 0.6)  # of the height: above the sediment, below the clear fluid
SETTLED = 0.6  # of the run: after the start
# Standard deviation of n from one packing to the next (seeds 100003, 100019, 100043), where streams form
OF_STREAMS = 0.053


class Suspension:
    """Void fraction and settling velocity against the column, in the zone that neither front reaches."""

    def __init__(self, run: Any) -> None:
        column = self.column = Column(run)
        time, position, velocity = column.particles()
        self.time = time
        height = position[:, :, 2] / column["height"]
        inside = (height > ZONE[0]) & (height < ZONE[1])
        self.history = np.array([-v[inside[i], 2].mean() for i, v in enumerate(velocity)])
        late = time > SETTLED * time[-1]
        self.velocity = self.history[late].mean()
        layers = column.heights() / column["height"]
        zone = (layers > ZONE[0]) & (layers < ZONE[1])
        self.void_fraction = np.mean(
            [column.layers(at, "voidFraction")[zone].mean() for at in column.times() if float(at) > SETTLED * time[-1]]
        )


def exponent(void_fraction: Any, relative_velocity: Any) -> tuple[Any, Any]:
    """n of v/v_t = eps^n by least squares in logarithms, and its standard error."""
    x, y = np.log(void_fraction), np.log(relative_velocity)
    n = (x * y).sum() / (x * x).sum()
    return n, np.sqrt(((y - n * x) ** 2).sum() / (len(x) - 1) / (x * x).sum())


class Family:
    """The concentrations of one particle in one fluid."""

    def __init__(self, name: str, runs: Any) -> None:
        self.name = name
        suspensions = sorted((Suspension(run) for run in runs), key=lambda one: one.void_fraction)
        self.void_fraction = np.array([one.void_fraction for one in suspensions])
        self.velocity = np.array([one.velocity for one in suspensions])
        column = self.column = suspensions[0].column
        self.terminal = column.terminal_velocity()
        self.reynolds = self.terminal * column["particleDiameter"] / column["fluidViscosity"]
        self.expected = closures.values(
            "hinderedSettlingVelocity", voidFraction=self.void_fraction, **column.closure_options()
        )

    def rows(self) -> list[Any]:
        ours, _ = exponent(self.void_fraction, self.velocity / self.terminal)
        implied, _ = exponent(self.void_fraction, self.expected / self.terminal)
        # the law's n varies with eps: what scatters is the ratio to it
        _, error = exponent(self.void_fraction, self.velocity / self.expected)
        richardson_zaki = closures.value("richardsonZakiExponent", reynolds=self.reynolds, diameterRatio=0)
        print(
            f"{self.name}: Re {self.reynolds:.2f}, v_t {self.terminal:.4f} m/s; void fractions "
            + " ".join(f"{eps:.3f}" for eps in self.void_fraction)
            + "; velocity beside the law's [%] "
            + " ".join(f"{100 * (v / u - 1):+.1f}" for v, u in zip(self.velocity, self.expected))
        )
        law = self.column["dragLaw"]
        title = f"Re {self.reynolds:.2g}, {self.name}"
        repeats = error if self.column["cellsAcross"] == 1 else OF_STREAMS
        return [
            validation.row(
                f"n, {title}",
                "1",
                implied,
                f"{law} in a uniform suspension",
                "computed",
                ours,
                error,
                2,
                self.convection(ours, implied),
                repeats,
            ),
            # scatter of the measurements behind the formula
            validation.row(
                f"n, {title} ",
                "1",
                richardson_zaki,
                "Richardson & Zaki 1954, formula",
                "measured",
                ours,
                error,
                10,
                self.laws_own(implied, richardson_zaki) or self.convection(ours, implied),
                repeats,
            ),
        ]

    def convection(self, ours: Any, implied: Any) -> str | None:
        """A finding where the fluid is free to circulate."""
        if self.column["cellsAcross"] == 1:
            return None
        return (
            f"with {self.column['cellsAcross']:.0f} cells across, n is {ours - implied:+.2f} from the law's: crowded"
            " parts of a random suspension sink as streams and the particles of a stream in each other's wake, while"
            " the law's velocity is that of a uniform suspension; the wider the smoothing, the less; with one cell"
            " across, where the fluid cannot circulate, it is the law's"
        )

    def laws_own(self, implied: Any, richardson_zaki: Any) -> str | None:
        """A finding where the drag law itself has another exponent."""
        if abs(implied / richardson_zaki - 1) < 0.1:
            return None
        return (
            f"{self.column['dragLaw']} in a uniform suspension has n {implied:.2f}, the formula {richardson_zaki:.2f}"
        )

    def plot(self, axes: Any, colour: Any) -> None:
        axes.loglog(
            self.void_fraction,
            self.velocity / self.terminal,
            "o",
            color=colour,
            label=f"{self.name}, Re {self.reynolds:.2g}",
        )
        axes.loglog(self.void_fraction, self.expected / self.terminal, "-", color=colour)
        richardson_zaki = closures.value("richardsonZakiExponent", reynolds=self.reynolds, diameterRatio=0)
        axes.loglog(self.void_fraction, self.void_fraction**richardson_zaki, ":", color=colour)


def plot(families: Any) -> None:
    figure, axes = pyplot.subplots(figsize=(7, 5))
    for index, family in enumerate(families):
        family.plot(axes, f"C{index}")
    axes.plot([], [], "k-", label="drag law in a uniform suspension")
    axes.plot([], [], "k:", label="Richardson & Zaki's formula")
    axes.set_xlabel("void fraction")
    axes.set_ylabel("settling velocity / terminal velocity")
    axes.set_xticks([0.7, 0.8, 0.9, 1], ["0.7", "0.8", "0.9", "1"])
    axes.minorticks_off()
    axes.legend()
    figure.tight_layout()
    figure.savefig("results/hinderedSettling.png", dpi=120)


runs = sorted(Path("runs").iterdir())
names = sorted({run.name.split("-")[0] for run in runs})
families = [Family(name, [run for run in runs if run.name.split("-")[0] == name]) for name in names]
validation.write([found for family in families for found in family.rows()])
plot(families)
