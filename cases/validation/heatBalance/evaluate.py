#!/usr/bin/python3
"""The heat of water and particles in a closed column at the end over that at the start, and the temperature of the
particles against the exact one of two bodies of uniform temperature."""

from math import exp, log, pi
from pathlib import Path
from typing import Any

from clepsydra import case_files, closures, parameter_file, validation
from clepsydra.column import Column

# Sums of some hundred numbers over a hundred steps
ROUNDING_PERCENT = 1e-10
# The splitting between water and particles is of first order in the coupling time step, 1 % of the time constant.
SPLITTING_PERCENT = 1.5


class HeatedColumn(Column):
    """With the entries of constant/heat."""

    def __init__(self, run: Path) -> None:
        super().__init__(run)
        self.parameters = {**self.parameters, **parameter_file.parameters(run / "constant/heat")}


def main() -> None:
    runs = sorted(Path("runs").iterdir())
    rows = [balance_row(run) for run in runs]
    rows += [time_constant_row(run) for run in runs if run.name.startswith("mixed")]
    validation.write(rows)


def balance_row(run: Path) -> dict[str, Any]:
    found = case_files.balances(run)[-1]
    column = HeatedColumn(run)
    capacity = column["particleCount"] * heat_capacity(column)
    print(
        f"{run.name}: particles at {found['heatInParticles'] / capacity:.3f} K, heat error of the exchange "
        f"{found['heatError']:.1e}, of the equation {found['heatErrorOfFluid']:.1e}, "
        f"by the continuity error {found['heatOfContinuityError'] / found['heatStart']:.1e}"
    )
    ours = found["heatEnd"] / found["heatStart"]
    return validation.row(
        f"heat of water and particles at the end, {run.name}",
        "of that at the start",
        1,
        "a closed column",
        "computed",
        ours,
        ROUNDING_PERCENT / 100,
        ROUNDING_PERCENT,
    )


def heat_capacity(column: HeatedColumn) -> float:
    """Of a particle [J/K]."""
    return float(column["particleDensity"] * column.particle_volume * column["particleCp"])


def time_constant_row(run: Path) -> dict[str, Any]:
    """From the difference between the temperatures of particles and water at the end: two bodies that exchange h A n
    times their difference."""
    column = HeatedColumn(run)
    count = column["particleCount"]
    volume = column.area * column["height"]
    void_fraction = 1 - count * column.particle_volume / volume
    # at rest: 2 by Ranz & Marshall
    nusselt = (
        2.0
        if column["heatTransferModel"] == "RanzMarshall"
        else closures.value("gunnNusselt", reynolds=1e-12, prandtl=1, voidFraction=void_fraction)
    )
    conductance = nusselt * pi * column["waterConductivity"] * column["particleDiameter"] * count
    particles = count * heat_capacity(column)
    water = column["fluidDensity"] * column["waterCp"] * void_fraction * volume
    expected = 1 / (conductance * (1 / particles + 1 / water))

    found = case_files.balances(run)[-1]
    difference = found["heatInParticles"] / particles - found["heatInFluid"] / water
    at_start = column["particleTemperature"] - column["waterTemperature"]
    ours = -column["endTime"] / log_ratio(difference, at_start)
    return validation.row(
        f"time constant of the particles' cooling, {run.name}",
        "s",
        expected,
        "two bodies of uniform temperature",
        "computed",
        ours,
        1e-6 * expected,
        SPLITTING_PERCENT,
    )


def log_ratio(difference: float, at_start: float) -> float:
    if difference <= exp(-20) * at_start:
        raise SystemExit("the temperatures are equal at the end: decrease endTime")
    return log(difference / at_start)


if __name__ == "__main__":
    main()
