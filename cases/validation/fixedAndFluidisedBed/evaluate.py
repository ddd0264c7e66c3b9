#!/usr/bin/python3
"""Compares pressure drops with Ergun's equation and with the bed's weight, and finds the velocity that fluidises it."""

import re
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import closures, picture_style, validation
from clepsydra.column import Column
from clepsydra.picture_style import pyplot

AT_REST = 0.93  # of the weight: below it the bed lies still
FIRST_SECONDS = 0.05  # the start of the flow
CLEAR = 0.95  # Ergun's equation is for packed beds; layers with a larger void fraction count as clear


def fixed_row(run: Any) -> tuple[Any, Any, Any, Any]:
    column = Column(run)
    p = column["fluidDensity"] * column.layers(column.times()[-1], "p")
    drop = (p[0] - p[-1]) * len(p) / (len(p) - 1)
    velocity, *option = run.name.removeprefix("fixed").split("-")
    velocity = float(velocity)
    void_fraction = 1 - column["particleCount"] * column.particle_volume / column.area / column["height"]
    ergun = column["height"] * ergun_gradient(column, void_fraction, velocity)[0]
    return (
        velocity,
        drop,
        ergun,
        validation.row(
            " ".join([f"dp of the fixed column, U {velocity:g} m/s", *option]),
            "Pa",
            ergun,
            "Ergun 1952",
            "computed",
            drop,
            1e-5 * abs(drop),
            3,
        ),
    )  # steady and laminar: what the solvers' tolerance leaves


def ergun_gradient(column: Any, void_fraction: Any, velocity: np.ndarray) -> Any:
    return closures.values(
        "ergunPressureGradient",
        particleDiameter=column["particleDiameter"],
        fluidDensity=column["fluidDensity"],
        fluidViscosity=column["fluidViscosity"],
        voidFraction=void_fraction,
        superficialVelocity=velocity,
    )


class Ramp:
    """A bed whose flow rises and then falls."""

    def __init__(self, run: Any) -> None:
        self.column = Column(run)
        self.is_ergun = self.column["dragLaw"] == "GidaspowDrag"
        self.time, self.drop = self.column.pressure_drop()
        self.velocity = self.column.top_velocity()[1]
        # the corners of the inlet's table, see Allrun
        corners = [float(corner) for corner in re.findall(r"\(([0-9.]+) \(", self.column["inletVelocity"])]
        _, lifted, _, fast, _, fall, _ = corners
        lies = self.drop < AT_REST * self.column.load
        self.rising = lies & (self.time > FIRST_SECONDS) & (self.time < lifted)
        self.plateau = (self.time > lifted) & (self.time < fast)
        self.falling = lies & (self.time > fall)
        self.turn = fast

    def fluidising_velocity(self, part: Any) -> tuple[Any, Any]:
        """Where the line b U + c U^2 of a bed at rest reaches the buoyant weight, and its standard error."""
        u, drop = self.velocity[part], self.drop[part]
        powers = np.column_stack([u, u * u])
        (b, c), residual = np.linalg.lstsq(powers, drop, rcond=None)[:2]
        velocity = 2 * self.column.load / (b + np.sqrt(b * b + 4 * c * self.column.load))
        noise = np.sqrt(residual[0] / len(u))
        return velocity, noise / (b + 2 * c * velocity)

    def laws_velocity(self, part: Any) -> tuple[Any, Any]:
        """The same by the drag law, layer by layer of the bed's own void fraction at the part's middle."""
        column = self.column
        middle = self.time[part].mean()
        time = min(column.times(), key=lambda name: abs(float(name) - middle))
        bed = column.layers(time, "voidFraction")
        bed = bed[bed < CLEAR]
        # per layer b U + c U^2, from two velocities
        u = np.array([0.005, 0.02]) if self.is_ergun else np.array([0.9, 1.1]) * self.fluidising_velocity(part)[0]
        gradients = sum(self.gradients(layer, u) for layer in bed) * column["height"] / column["cellsUp"]
        b, c = np.linalg.solve(np.column_stack([u, u * u]), gradients)
        return 2 * column.load / (b + np.sqrt(b * b + 4 * c * column.load)), bed[:15].mean()

    def gradients(self, void_fraction: float, velocities: np.ndarray) -> np.ndarray:
        column = self.column
        if self.is_ergun:
            return np.ravel(ergun_gradient(column, void_fraction, velocities))
        return closures.bed_pressure_gradients(velocities, void_fraction, column.parameters)

    def rows(self) -> Any:
        column, found = self.column, []
        print(
            f"{column.run.name}: highest particle at the start, the turn and the end [d]: "
            + ", ".join(f"{top / column['particleDiameter']:.1f}" for top in self.tops())
        )
        for name in ("rising", "falling"):
            part = getattr(self, name)
            velocity, error = self.fluidising_velocity(part)
            expected, void_fraction = self.laws_velocity(part)
            print(f"{column.run.name}, {name}: U_mf {velocity:.5f} m/s, void fraction in the bed {void_fraction:.4f}")
            found.append(
                validation.row(
                    f"U_mf, {name} velocity, {column.run.name}",
                    "m/s",
                    expected,
                    f"{'Ergun 1952' if self.is_ergun else column['dragLaw']} in the layers of the bed's void fraction",
                    "computed",
                    velocity,
                    error,
                    5,
                )
            )
        plateau = self.drop[self.plateau]
        found.append(
            validation.row(
                f"dp while fluidised, {column.run.name}",
                "Pa",
                column.load,
                "buoyant weight / area",
                "computed",
                plateau.mean(),
                plateau.std() / np.sqrt(20),
                2,
            )
        )
        return found

    def tops(self) -> list[Any]:
        """Of the highest particle."""
        time, position, _ = self.column.particles()
        return [position[np.abs(time - at).argmin(), :, 2].max() for at in (0, self.turn, self.time[-1])]


def plot(fixed: Any, ramps: Any) -> None:
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4.5), constrained_layout=True)
    velocity, drop, ergun, _ = zip(*fixed)
    millimetres = [1e3 * one for one in velocity]
    left.plot(millimetres, ergun, "k-", label="Ergun")
    left.plot(millimetres, drop, "o", color=picture_style.LINE, label="pimpleDemFoam")
    left.set(title="particles held fast", ylabel="pressure drop [Pa]", ylim=(0, None))
    colours = {"velocity rises": picture_style.LINE, "velocity falls": picture_style.MARK}
    for ramp in ramps:
        for part, name in ((ramp.time < ramp.turn, "velocity rises"), (ramp.time >= ramp.turn, "velocity falls")):
            part &= ramp.time > FIRST_SECONDS
            right.plot(
                1e3 * ramp.velocity[part],
                ramp.drop[part] / ramp.column.load,
                colours[name],
                linewidth=1,
                label=name if ramp is ramps[0] else None,
            )
    right.axhline(1, color="black", linewidth=0.7)
    right.axvline(
        1e3 * ramps[0].fluidising_velocity(ramps[0].falling)[0],
        color="grey",
        linestyle=":",
        label="U_mf, velocity falls",
    )
    right.set(title="free particles", ylabel="pressure drop / buoyant weight", ylim=(0, None))
    for axes in (left, right):
        axes.set(xlabel="superficial velocity [mm/s]", xlim=(0, None))
        axes.grid(alpha=0.3)
        axes.legend(loc="lower right")
    figure.savefig("results/fixedAndFluidisedBed.png", dpi=picture_style.DPI)


fixed = sorted(fixed_row(run) for run in Path("runs").glob("fixed*"))
ramps = [Ramp(run) for run in sorted(Path("runs").glob("free*"))]
validation.write([found for *_, found in fixed] + [found for ramp in ramps for found in ramp.rows()])
plot(fixed, [ramp for ramp in ramps if ramp.is_ergun])
