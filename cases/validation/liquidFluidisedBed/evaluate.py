#!/usr/bin/python3
"""Compares the void fraction of the bed, read from the slope of the pressure, with the drag law's and the formula's."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import closures, validation
from clepsydra.column import GRAVITY, Column
from clepsydra.picture_style import pyplot

STEADY = 0.6  # of the run: after the bed has risen
WITHIN = 0.9  # of the weight: the bed without its loose top, as the authors take it
COLUMN_DIAMETER = 0.1  # of the experiment
SINGLE_PARTICLE = "BrownLawlerDrag"
LAWS = ("RongDrag", "DiFeliceDrag", "BeetstraDrag", "KochHillDrag", "GidaspowDrag")


class Bed:
    def __init__(self, run: Any) -> None:
        column = self.column = Column(run)
        self.name = run.name
        late = [time for time in column.times() if float(time) > STEADY * column["endTime"]]
        profiles = column["fluidDensity"] * np.array([column.layers(time, "p") for time in late])
        # the mean first: at any one time parts of the bed are being accelerated
        self.profile = profiles.mean(axis=0)
        self.void_fraction = self.by_slope(self.profile)
        # the bed sways: five parts of the time that counts
        parts = [self.by_slope(part.mean(axis=0)) for part in np.array_split(profiles, 5)]
        self.error = np.std(parts, ddof=1) / np.sqrt(5)
        self.waves = self.unevenness(late)
        time, velocity = column.top_velocity()
        self.velocity = velocity[time > STEADY * column["endTime"]].mean()
        time, drop = column.pressure_drop()
        drop = drop[time > STEADY * column["endTime"]]
        self.drop, self.drop_error = drop.mean(), drop.std() / np.sqrt(5)

    def by_slope(self, pressure: Any) -> Any:
        """1 - slope/((rho_p - rho_f) g), the slope by least squares in the bed."""
        column = self.column
        part = pressure > (1 - WITHIN) * column.load
        slope = -np.polyfit(column.heights()[part], pressure[part], 1)[0]
        return 1 - slope / ((column["particleDensity"] - column["fluidDensity"]) * GRAVITY)

    def unevenness(self, times: Any) -> Any:
        """Standard deviation of the layers' void fractions in the bed, over heights and times."""
        bed = self.profile > (1 - WITHIN) * self.column.load
        return np.std([self.column.layers(time, "voidFraction")[bed] for time in times])

    def rows(self) -> list[Any]:
        column = self.column
        implied = implied_void_fraction(column, column["dragLaw"], self.velocity)
        formula = richardson_zaki(column, self.velocity)
        print(
            f"{self.name}: U {self.velocity:.4f} m/s; void fraction by the slope {self.void_fraction:.4f}, by the laws "
            + ", ".join(f"{law} {implied_void_fraction(column, law, self.velocity):.3f}" for law in LAWS)
            + f", by Richardson & Zaki {formula:.3f}"
        )
        laws_own = None
        uneven = (
            "the bed is not uniform: waves move up through it, the void fraction of its layers has a standard"
            f" deviation of {self.waves:.3f} over heights and times, and one bed of"
            f" {column['width'] / column['particleDiameter']:.1f} d across holds a few of them only; free to circulate"
            " (four cells across) it stands lower than the law's uniform bed, as plugs (one cell across) higher"
        )
        if abs(implied / formula - 1) > 0.05:
            laws_own = (
                f"{column['dragLaw']} in a uniform bed has {implied:.3f}, the formula {formula:.3f}: that law's"
                f" isolated particle settles at {terminal(column, column['dragLaw']):.3f} m/s, measured particles"
                f" ({SINGLE_PARTICLE}) at {terminal(column, SINGLE_PARTICLE):.3f} m/s"
            )
        return [
            validation.row(
                f"void fraction, {self.name}",
                "1",
                implied,
                f"{column['dragLaw']} in a uniform bed",
                "computed",
                self.void_fraction,
                self.error,
                3,
                uneven,
            ),
            # scatter of the measurements behind the formula
            validation.row(
                f"void fraction, {self.name} ",
                "1",
                formula,
                f"Richardson & Zaki 1954, formula, v_t by {SINGLE_PARTICLE}",
                "measured",
                self.void_fraction,
                self.error,
                5,
                laws_own or uneven,
            ),
            validation.row(
                f"dp, {self.name}",
                "Pa",
                column.load,
                "buoyant weight / area",
                "computed",
                self.drop,
                self.drop_error,
                2,
            ),
        ]


def options(column: Any, law: Any) -> Any:
    return column.closure_options() | {"dragLaw": law}


def terminal(column: Any, law: Any) -> Any:
    return closures.value("terminalVelocity", **options(column, law))


def implied_void_fraction(column: Any, law: Any, velocity: np.ndarray) -> Any:
    """Of the uniform bed that the law carries at a superficial velocity."""
    grid = np.linspace(0.35, 0.98, 127)
    speeds = closures.values("hinderedSettlingVelocity", voidFraction=grid, **options(column, law))
    return np.interp(velocity, speeds, grid) if (np.diff(speeds) > 0).all() else grid[np.argmax(speeds > velocity)]


def richardson_zaki(column: Any, velocity: np.ndarray) -> Any:
    """U = v_t 10^(-d/D) eps^n, their equation for beds."""
    ratio = column["particleDiameter"] / COLUMN_DIAMETER
    isolated = terminal(column, SINGLE_PARTICLE)
    n = closures.value(
        "richardsonZakiExponent",
        diameterRatio=ratio,
        reynolds=isolated * column["particleDiameter"] / column["fluidViscosity"],
    )
    return (velocity / (isolated * 10**-ratio)) ** (1 / n)


def plot(beds: Any) -> None:
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4.5))
    for index, bed in enumerate(beds):
        left.plot(
            bed.profile / bed.column.load,
            bed.column.heights() / bed.column["particleDiameter"],
            f"C{index}o-",
            markersize=3,
            label=bed.name,
        )
        right.errorbar(
            bed.velocity / terminal(bed.column, SINGLE_PARTICLE),
            bed.void_fraction,
            bed.error,
            fmt=f"C{index}o",
            label=bed.name,
        )
    left.set_xlabel("p / (buoyant weight / area), mean of the steady part")
    left.set_ylabel("height / d")
    left.legend()
    column = beds[-1].column
    relative = np.linspace(0.15, 0.5, 30)
    for law, style in zip(LAWS, ("-", "--", "-.", ":", (0, (1, 3)))):
        right.plot(
            relative,
            [implied_void_fraction(column, law, u * terminal(column, SINGLE_PARTICLE)) for u in relative],
            color="grey",
            linestyle=style,
            linewidth=0.8,
            label=law,
        )
    right.plot(
        relative,
        [richardson_zaki(column, u * terminal(column, SINGLE_PARTICLE)) for u in relative],
        "k-",
        label="Richardson & Zaki, D 100 mm",
    )
    right.set_xlabel(f"superficial velocity / terminal velocity ({SINGLE_PARTICLE})")
    right.set_ylabel("void fraction")
    right.set_title(f"lines: the particles of {beds[-1].name}", fontsize=9)
    right.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig("results/liquidFluidisedBed.png", dpi=120)


beds = [Bed(run) for run in sorted(Path("runs").iterdir())]
validation.write([found for bed in beds for found in bed.rows()])
plot(beds)
