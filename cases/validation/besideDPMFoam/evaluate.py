#!/usr/bin/python3
"""Puts what pimpleDemFoam and DPMFoam make of the same case side by side.

Equations: DPMFoam keeps the whole pressure gradient in the fluid and none on the particles, and its ErgunWenYuDrag
carries one 1/alpha more than model A's law: model B with GidaspowDrag, to the letter. What differs: DPMFoam counts a
particle in the cell of its centre and smooths nothing, so alpha jumps when a particle passes a face, and d(alpha)/dt
makes the pressure jump with it; it chooses DEM sub-steps by the speed of impacts, so that a bed at rest is never quite
at rest; its friction forgets its spring when it slips. """

import re
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, validation
from clepsydra.column import GRAVITY, Column
from clepsydra.picture_style import pyplot

SOURCE = "DPMFoam of OpenFOAM v1912"
LATE = 0.5  # of a run: after the start


class Ours:
    name, void_fraction = "pimpleDemFoam", "voidFraction"

    def __init__(self, run: Any) -> None:
        self.column = Column(run)
        self.case = run

    def pressure_drop(self) -> Any:
        return self.column.pressure_drop()

    def times(self) -> Any:
        return case_files.times(self.case)

    def mean_height(self) -> tuple[Any, Any]:
        """Times, and the height of the particles' centre of mass by the void fraction of the cells [m]."""
        times = self.times()
        heights = []
        for time in times:
            solid = 1 - case_files.field(self.case, time, self.void_fraction)[:, 0]
            solid = solid.reshape(int(self.column["cellsUp"]), -1).sum(axis=1)
            heights.append((solid * self.column.heights()).sum() / solid.sum())
        return np.array([float(time) for time in times]), np.array(heights)

    def cpu_seconds(self) -> float:
        return float((self.case / f"cpuSeconds.{self.name}").read_text())


class Theirs(Ours):
    name, void_fraction = "DPMFoam", "alpha.fluid"

    def __init__(self, run: Any) -> None:
        super().__init__(run)
        self.case = run / "DPMFoam"

    def pressure_drop(self) -> tuple[Any, Any]:
        time, p = case_files.surface_values(self.case, "bottomPressure")
        return time, self.column["fluidDensity"] * (p[:, 0] - GRAVITY * self.column["height"])

    def lost_particles(self) -> int:
        counts = re.findall(r"Current number of parcels *= (\d+)", (self.case / "log.DPMFoam").read_text())
        return int(self.column["particleCount"]) - int(counts[-1])


def late(time: np.ndarray, values: Any) -> tuple[Any, Any]:
    """Mean over the later part of a run, and its standard error from the means of ten blocks: DPMFoam's pressure jumps
    by thousands of Pa from step to step, up and down."""
    part = values[time > LATE * time[-1]]
    blocks = [block.mean() for block in np.array_split(part, min(10, len(part)))]
    return np.mean(blocks), np.std(blocks, ddof=1) / np.sqrt(len(blocks))


def compare(quantity: str, unit: str, ours: Any, theirs: Any, tolerance: float, finding: Any = None) -> Any:
    (value, error), (reference, reference_error) = ours, theirs
    return validation.row(
        quantity,
        unit,
        reference,
        SOURCE,
        "otherCode",
        value,
        np.hypot(error, reference_error),
        at_least_scatter(tolerance, theirs),
        finding,
        error,
    )


def at_least_scatter(tolerance: float, theirs: Any) -> Any:
    """Percent: what DPMFoam itself does not resolve says nothing about us."""
    reference, error = theirs
    return max(tolerance, round(validation.ALLOWED_ERRORS * 100 * error / reference, 1))


def settling_velocity(code: Any) -> tuple[Any, Any]:
    """By the centre of mass: slope over the later part, its standard error."""
    time, height = code.mean_height()
    part = time > LATE * time[-1]
    slope, cover = (
        np.polyfit(time[part], height[part], 1, cov=True)
        if part.sum() > 4
        else (np.polyfit(time[part], height[part], 1), np.zeros((2, 2)))
    )
    return -slope[0], np.sqrt(cover[0, 0])


def rows(run: Any) -> Any:
    ours, theirs = Ours(run), Theirs(run)
    tell_speed(ours, theirs)
    if run.name == "settling":
        return [
            compare("settling velocity, void fraction .9", "m/s", settling_velocity(ours), settling_velocity(theirs), 5)
        ]
    finding = (
        f"DPMFoam loses {theirs.lost_particles()} of {theirs.column['particleCount']:.0f} particles, thrown out by its"
        f" contacts, and its pressure jumps by {theirs.pressure_drop()[1].std():.0f} Pa from step to step"
    )
    found = [
        compare(
            f"dp, {run.name}",
            "Pa",
            late(*ours.pressure_drop()),
            late(*theirs.pressure_drop()),
            2 if run.name == "fluidised" else 10,
            finding,
        )
    ]
    found.append(
        compare(
            f"height of the centre of mass, {run.name}",
            "m",
            late(*ours.mean_height()),
            late(*theirs.mean_height()),
            5,
            finding,
        )
    )
    if run.name == "fluidised":
        for code, tolerance in (ours, 2), (theirs, at_least_scatter(2, late(*theirs.pressure_drop()))):
            found.append(
                validation.row(
                    f"dp of {code.name} against the weight",
                    "Pa",
                    code.column.load,
                    "buoyant weight / area",
                    "computed",
                    *late(*code.pressure_drop()),
                    tolerance,
                )
            )
    return found


def tell_speed(*codes: Any) -> None:
    for code in codes:
        column = code.column
        particle_seconds = column["particleCount"] * column["endTime"]
        print(
            f"{code.case}: {code.cpu_seconds():.1f} s on one core, {code.cpu_seconds() / particle_seconds:.2f} s per"
            f" particle and simulated second; its fluid steps {column['endTime'] / column['couplingTimeStep']:.0f}"
        )


def plot(runs: Any) -> None:
    figure, axes = pyplot.subplots(2, len(runs), figsize=(4 * len(runs), 6), squeeze=False, sharex="col")
    for column, run in zip(axes.T, runs):
        for code, style in ((Ours(run), "C0-"), (Theirs(run), "C1-")):
            time, drop = code.pressure_drop()
            column[0].plot(time, drop / code.column.load, style, linewidth=0.8, label=code.name)
            time, height = code.mean_height()
            column[1].plot(time, 1e3 * height, style + "o", markersize=3)
        column[0].set_title(run.name)
        column[0].set_ylim(-0.5, 2)
        column[1].set_xlabel("time [s]")
    axes[0][0].set_ylabel("dp / (buoyant weight / area)")
    axes[1][0].set_ylabel("height of the centre of mass [mm]")
    axes[0][0].legend()
    figure.tight_layout()
    figure.savefig("results/besideDPMFoam.png", dpi=120)


runs = sorted(Path("runs").iterdir())
validation.write([found for run in runs for found in rows(run)])
plot(runs)
