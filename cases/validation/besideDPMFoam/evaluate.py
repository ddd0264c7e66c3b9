#!/usr/bin/python3
"""Puts what pimpleDemFoam and DPMFoam make of the same case side by side."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import validation
from clepsydra.dpm_foam import LATE, Ours, Theirs, at_least_scatter, compare, late, tell_speed
from clepsydra.picture_style import pyplot


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
        "DPMFoam's pressure drop is less than the weight of its bed, and jumps by"
        f" {theirs.pressure_drop()[1].std():.0f} Pa from step to step; its bed does not accelerate, so that the rest"
        " is carried by the floor or is not returned to the fluid (not traced)"
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
        scatter = at_least_scatter(2, late(*theirs.pressure_drop()))
        for code, tolerance, found_in_it in (ours, 2, None), (theirs, scatter, finding):
            found.append(
                validation.row(
                    f"dp of {code.name} against the weight",
                    "Pa",
                    code.column.load,
                    "buoyant weight / area",
                    "computed",
                    *late(*code.pressure_drop()),
                    tolerance,
                    found_in_it,
                )
            )
    return found


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
