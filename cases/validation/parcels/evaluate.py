#!/usr/bin/python3
"""Compares parcels with the particles that they stand for, and both with the drag law."""

import re
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import closures, periods, picture_style, validation
from clepsydra.column import Column
from clepsydra.picture_style import pyplot

AT_REST = 0.93  # of the weight: below it the bed lies still
CLEAR = 0.95  # layers with a larger void fraction are outside the bed
LAST_PART = 7 / 8  # of a fall, which is nine relaxation times long
COARSE = (
    "the bed of parcels is 12 parcels high and 8 wide: the walls and the top disturb its packing over a few diameters, "
    "and its surface moves in larger pieces"
)


class Run(Column):
    """`particleDiameter` of its parameters is that of the spheres, parcels or particles."""

    @property
    def ratio(self) -> int:
        return round(self["coarseGraining"])

    @property
    def real_diameter(self) -> float:
        return self["particleDiameter"] / self["coarseGraining"]

    @property
    def name(self) -> str:
        return "particles" if self.ratio == 1 else f"parcels of {self.ratio} diameters"

    def ergun_gradient(self, void_fraction: Any, velocity: Any) -> Any:
        return closures.values(
            "ergunPressureGradient",
            particleDiameter=self.real_diameter,
            fluidDensity=self["fluidDensity"],
            fluidViscosity=self["fluidViscosity"],
            voidFraction=void_fraction,
            superficialVelocity=velocity,
        )


def fall_row(run: Run) -> dict[str, Any]:
    options = run.closure_options() | {"particleDiameter": run.real_diameter}
    expected = closures.value("terminalVelocity", **options)
    time, _, velocity = run.particles()
    speeds = -velocity[time > LAST_PART * time[-1], 0, 2]
    print(f"{run.run.name}: falls at {speeds.mean():.5f} m/s, the law of one particle gives {expected:.5f} m/s")
    return validation.row(
        f"terminal velocity, {run.name}",
        "m/s",
        expected,
        f"{run['dragLaw']} of one particle",
        "computed",
        speeds.mean(),
        speeds.std(),
        1,
    )


def fixed_row(run: Run) -> dict[str, Any]:
    velocity = float(run.run.name.removeprefix("fixed").split("-")[0])
    p = run["fluidDensity"] * run.layers(run.times()[-1], "p")
    gradient = (p[0] - p[-1]) / (len(p) - 1) * run["cellsUp"] / run["height"]
    void_fraction = 1 - run["particleCount"] * run.particle_volume / run.area / run["height"]
    expected = run.ergun_gradient(void_fraction, velocity)[0]
    print(f"{run.run.name}: {gradient:.2f} Pa/m, Ergun's equation for the particles {expected:.2f} Pa/m")
    return validation.row(
        f"pressure gradient of a fixed bed, U {velocity:g} m/s, {run.name}",
        "Pa/m",
        expected,
        "Ergun 1952 with the particles' diameter",
        "computed",
        gradient,
        1e-4 * gradient,
        1,
    )


class FreeBed:
    """A bed that is fluidised, and then at rest while the flow becomes slower."""

    def __init__(self, run: Run) -> None:
        self.run = run
        self.time, self.drop = run.pressure_drop()
        self.velocity = run.top_velocity()[1]
        corners = [float(corner) for corner in re.findall(r"\(([0-9.]+) \(", run["inletVelocity"])]
        _, fast, slows, _, falls, _ = corners
        # The first half of the time is for the bed to forget how it was filled.
        self.fluidised = ((fast + slows) / 2, slows)
        self.plateau = (self.time > self.fluidised[0]) & (self.time < slows)
        self.falling = (self.time > falls) & (self.drop < AT_REST * run.load)

    def minimum_velocity(self) -> tuple[float, float]:
        """Where the line b U + c U^2 of the bed at rest reaches the buoyant weight, and its standard error."""
        u, drop, load = self.velocity[self.falling], self.drop[self.falling], self.run.load
        (b, c), residual = np.linalg.lstsq(np.column_stack([u, u * u]), drop, rcond=None)[:2]
        velocity = 2 * load / (b + np.sqrt(b * b + 4 * c * load))
        return velocity, np.sqrt(residual[0] / len(u)) / (b + 2 * c * velocity)

    def void_fraction_at_rest(self) -> float:
        """Of the lower half of the bed."""
        run = self.run
        bed = run.layers(run.times()[-1], "voidFraction")
        bed = bed[bed < CLEAR]
        return float(bed[: len(bed) // 2].mean())

    def heights(self) -> np.ndarray:
        """Twice the mean height of the spheres while fluidised, at each entry of the dump [m]."""
        time, position, _ = self.run.particles()
        some = (time > self.fluidised[0]) & (time < self.fluidised[1])
        return 2 * position[some, :, 2].mean(axis=1)


def mean_and_error(values: np.ndarray) -> tuple[float, float]:
    """Of a series whose values a tenth of its length apart are taken as independent."""
    return float(values.mean()), periods.error_by_parts(values, 10)


def free_rows(fine: FreeBed, coarse: FreeBed) -> list[dict[str, Any]]:
    rows = []
    seed = f"{fine.run['seed']:.0f}"
    quantities: dict[str, Any] = {}
    for bed in (fine, coarse):
        drop, drop_error = mean_and_error(bed.drop[bed.plateau])
        quantities[bed.run.name] = (bed.minimum_velocity(), mean_and_error(bed.heights()))
        print(
            f"{bed.run.run.name}: U_mf {bed.minimum_velocity()[0]:.4f} m/s, void fraction at rest "
            f"{bed.void_fraction_at_rest():.4f}, fluidised: {quantities[bed.run.name][1][0] * 1e3:.2f} mm high, "
            f"pressure drop {drop:.1f} Pa of {bed.run.load:.1f}, its standard deviation "
            f"{bed.drop[bed.plateau].std():.1f} Pa"
        )
        rows.append(
            validation.row(
                f"dp while fluidised, {bed.run.name}, {seed}",
                "Pa",
                bed.run.load,
                "buoyant weight / area",
                "computed",
                drop,
                drop_error,
                3,
            )
        )
    for at, (name, unit) in enumerate((("minimum fluidisation velocity", "m/s"), ("height while fluidised", "m"))):
        (expected, error), (ours, own_error) = (quantities[bed.run.name][at] for bed in (fine, coarse))
        rows.append(
            validation.row(
                f"{name}, {coarse.run.name}, {seed}",
                unit,
                expected,
                "the same bed of particles",
                "computed",
                ours,
                float(np.hypot(error, own_error)),
                5,
                COARSE,
            )
        )
    return rows


def plot(beds: list[FreeBed]) -> None:
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4.5), constrained_layout=True)
    for bed in beds:
        colour = picture_style.LINE if bed.run.ratio == 1 else picture_style.MARK
        left.plot(bed.time, bed.drop / bed.run.load, color=colour, linewidth=0.7, label=bed.run.name)
        some = bed.time > bed.time[-1] * 2 / 3
        right.plot(bed.velocity[some], bed.drop[some] / bed.run.load, color=colour, linewidth=1, label=bed.run.name)
    left.set(xlabel="time [s]", ylabel="pressure drop / buoyant weight")
    right.set(xlabel="superficial velocity [m/s]", ylabel="pressure drop / buoyant weight", xlim=(0, None))
    for axes in (left, right):
        axes.set(ylim=(0, None))
        axes.grid(alpha=0.3)
        axes.legend(loc="lower right")
    figure.savefig("results/parcels.png", dpi=picture_style.DPI)


runs = sorted((Run(path) for path in Path("runs").iterdir()), key=lambda run: run.run.name)
falls = [run for run in runs if run.run.name.startswith("fall")]
fixed = [run for run in runs if run.run.name.startswith("fixed")]
free = [FreeBed(run) for run in runs if run.run.name.startswith("free")]
validation.write(
    [fall_row(run) for run in falls]
    + [fixed_row(run) for run in fixed]
    + [found for fine, coarse in zip(free[::2], free[1::2]) for found in free_rows(fine, coarse)]
)
plot(free)
