#!/usr/bin/python3
"""Puts the bed of pimpleDemFoam beside that of DPMFoam: height of the particles' centre of mass and pressure drop, each
by its mean, its swing and its main frequency, and the pressure drop beside the weight of the particles. With --quick,
means of the height and of the pressure drop at rest and while the bed begins to rise."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, periods, validation
from clepsydra.dpm_foam import Ours, Theirs, at_least_scatter, compare, late, tell_speed
from clepsydra.periods import Swings

START = 1.0  # [s] the bed has left its first state behind
WINDOW = 0.01  # [s] over which the pressure is averaged: DPMFoam's jumps from step to step
# Equations, drag and contacts are the same: means within some percent. Swings and frequencies are of a few periods.
TOLERANCES = {"mean": 5, "deviation": 30, "frequency": 25}
NOT_TRACED = "one packing, one mesh; not traced"
SMOOTHED = "smoothing over three diameters blurs the ends of a bed of some twenty: without smoothing -0.6 % at rest"


class OurBed(Ours):
    def mean_height(self) -> tuple[np.ndarray, np.ndarray]:
        """Times, and the mean height of the particles' centres [m]."""
        step, height = np.loadtxt(self.case / "DEM/meanHeight.dat").T
        return (step - step[0]) * self.column["demStep"], height


class TheirBed(Theirs):
    def mean_height(self) -> tuple[np.ndarray, np.ndarray]:
        """The same, but each particle counts as if it were in the middle of its cell."""
        time, *cells = case_files.columns(self.case, "cells", self.void_fraction)
        return time, np.array([self.centre_of_mass(one) for one in np.transpose(cells)])


def rows(run: Path) -> list[dict[str, Any]]:
    ours, theirs = OurBed(run), TheirBed(run)
    tell_speed(ours, theirs)
    print(f"{theirs.case}: {theirs.lost_particles()} particles lost")
    return rows_of_swings(ours, theirs) if ours.column["endTime"] > START else rows_of_means(ours, theirs)


# --- the bubbling bed ----------------------------------------------------------------------------


def rows_of_swings(ours: Ours, theirs: Ours) -> list[dict[str, Any]]:
    found = []
    end = min(code.pressure_drop()[0][-1] for code in (ours, theirs))
    print(f"compared from {START:g} to {end:g} s")
    heights = [swings(*code.mean_height(), end) for code in (ours, theirs)]
    drops = [swings(*in_windows(*code.pressure_drop()), end) for code in (ours, theirs)]
    for signal, unit, both in (("height of the centre of mass", "m", heights), ("pressure drop", "Pa", drops)):
        for name, tolerance in TOLERANCES.items():
            pair = [(value.value, value.error) for value in (getattr(one, name) for one in both)]
            unit_here = "1/s" if name == "frequency" else unit
            found.append(compare(f"{name} of the {signal}", unit_here, pair[0], pair[1], tolerance, NOT_TRACED))
    for code, drop in zip((ours, theirs), drops):
        found.append(beside_weight(code, (drop.mean.value, drop.mean.error)))
    return found


def swings(time: np.ndarray, values: np.ndarray, end: float) -> Swings:
    compared = (time > START) & (time <= end)
    return periods.swings(time[compared], values[compared])


def in_windows(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Means over whole windows, and their middles."""
    window = np.floor(time / WINDOW).astype(int)
    counts = np.bincount(window)
    filled = np.flatnonzero(counts)[:-1]
    return (filled + 0.5) * WINDOW, np.bincount(window, values)[filled] / counts[filled]


def beside_weight(code: Ours, drop: tuple[float, float]) -> dict[str, Any]:
    return validation.row(
        f"pressure drop of {code.name} against the weight",
        "Pa",
        code.column.load,
        "buoyant weight / area",
        "computed",
        *drop,
        at_least_scatter(TOLERANCES["mean"], drop),
        NOT_TRACED,
    )


# --- the small bed, at rest and beginning to rise ------------------------------------------------


def rows_of_means(ours: Ours, theirs: Ours) -> list[dict[str, Any]]:
    """The spreads are those of two packings."""
    of_run = f"U {ours.column['superficialVelocity']:g} m/s"
    tolerance = TOLERANCES["mean"]
    height, their_height = (late(*code.mean_height()) for code in (ours, theirs))
    drop, their_drop = (late(*code.pressure_drop()) for code in (ours, theirs))
    return [
        compare(f"height of the centre of mass, {of_run}", "m", height, their_height, tolerance, spread=0.003),
        compare(f"pressure drop, {of_run}", "Pa", drop, their_drop, tolerance, SMOOTHED, spread=0.008),
    ]


def main() -> None:
    validation.write([row for run in sorted(Path("runs").glob("bed*")) for row in rows(run)])


main()
