#!/usr/bin/python3
"""Continuity errors of the conservation check; the water's flux against the particles'; where a closed tank's imbalance
went."""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, validation
from clepsydra.column import Column
from clepsydra.picture_style import pyplot

# The pressure's residuals, over all intervals
SOLVER_PERCENT = 1e-6
ROUNDING_PERCENT = 1e-8
# The file's twelve digits in differences between two times
DIGITS_PERCENT = 1e-4
# A particle on cells of half its size jerks on its way by a little; floor and lid are beyond the smoothing.
DISPLACED_PERCENT = 1


def main() -> None:
    found = [row for run in sorted(Path("runs").glob("balanced*")) for row in of_balanced(run)]
    found += of_clipped(Path("runs/clipped"))
    found += [of_stop(run) for run in sorted(Path("runs").glob("stopsAt-*"))]
    validation.write(found)


def computed(quantity: str, unit: str, reference: Any, source: Any, ours: Any, tolerance: float) -> Any:
    return validation.row(
        quantity, unit, reference, source, "computed", ours, abs(reference) * tolerance / 100, tolerance
    )


def of_balanced(run: Any) -> Any:
    summary = json.loads((run / "postProcessing/conservation/0/summary.json").read_text())
    print(
        f"{run.name}: continuity error {summary['continuityError']:.1e} at most, "
        f"{summary['cumulativeContinuityError']:+.1e} in all; spread {summary['imbalance']:+.1e}"
    )
    still = [
        computed(
            f"water that {what}, {run.name}", "of the tank", 1, "none is made or lost", 1 + summary[entry], tolerance
        )
        for what, entry, tolerance in (
            ("was there, with the largest local error of an interval", "continuityError", SOLVER_PERCENT),
            ("was there, with the cumulative error", "cumulativeContinuityError", ROUNDING_PERCENT),
            ("was there, with what was spread", "imbalance", ROUNDING_PERCENT),
        )
    ]
    return still + ([of_fluxes(run)] if Column(run)["cellsAcross"] == 1 else [])


def of_fluxes(run: Any) -> Any:
    """Over the last interval of those that were written: what the particles carry down, the water carries up."""
    column = Column(run)
    time, position, _ = column.particles()
    end = column.times()[0]
    at = int(np.abs(time - float(end)).argmin())
    water = upwards(run, end).sum() * column["height"] / column["cellsUp"]
    particles = column.particle_volume * (position[at] - position[at - 1])[:, 2].sum() / (time[at] - time[at - 1])
    return computed(
        f"volume flux of the water, integrated over the height, {run.name}",
        "m4/s",
        -particles,
        "what the particles displace",
        water,
        DISPLACED_PERCENT,
    )


def of_clipped(run: Any) -> list[Any]:
    """One cell across: a sink of the reference cell, the lowest, is seen by all above."""
    times = Column(run).times()
    before, now = (case_files.field(run, time, "voidFractionInContinuity")[:, 0] for time in times[-2:])
    recorded = [
        float(value)
        for value in re.findall(r"imbalance of a closed tank (\S+)", (run / "log.pimpleDemFoam").read_text())
    ]
    changes = [case_files.field(run, time, "voidFraction")[:, 0].mean() for time in times]
    column = Column(run)
    cell = column.area * column["height"] / column["cellsUp"]
    sink = (now - before) / column["couplingTimeStep"] + np.diff(upwards(run, times[-1])) / cell
    plot(column.heights(), sink)
    print(
        f"{run.name}: {recorded[-1]:+.3e} of the tank recorded; sink {sink[0]:.3e} /s in the reference cell, "
        f"{sink.mean():.3e} in the mean"
    )
    return [
        computed(
            "imbalance that is recorded where the void fraction is clipped",
            "of the tank",
            changes[-1] - changes[0],
            "change of the tank's void fraction",
            recorded[len(times) - 1] - recorded[0],
            1e-2,
        ),
        computed("its sink in the reference cell", "1/s", sink.mean(), "spread evenly", sink[0], DIGITS_PERCENT * 100),
        computed(
            "its sink in the cell that is farthest from the mean",
            "1/s",
            sink.mean(),
            "spread evenly",
            sink[np.abs(sink - sink.mean()).argmax()],
            DIGITS_PERCENT * 100,
        ),
    ]


def upwards(run: Any, time: str) -> Any:
    """Of the water through the faces between the cells, one above the other, floor and lid included [m3/s]."""
    void_fraction = case_files.field(run, time, "voidFraction")[:, 0]
    between = 0.5 * (void_fraction[1:] + void_fraction[:-1])
    return np.concatenate([[0], between * case_files.field(run, time, "phi")[:, 0], [0]])


def of_stop(run: Any) -> Any:
    entry = run.name.split("-")[1]
    log = (run / "log.pimpleDemFoam").read_text()
    stopped = "FOAM FATAL ERROR" in log and entry in log.split("FOAM FATAL ERROR")[1]
    return computed(f"stops and names {entry}", "-", 1, "above the tolerance", int(stopped), 0)


def plot(height: Any, sink: Any) -> None:
    figure, axes = pyplot.subplots(figsize=(5, 4))
    axes.plot(sink, 1e3 * height, "o-")
    axes.set_xlabel(r"$\partial\epsilon/\partial t + \nabla\cdot\epsilon U$ before it was spread [1/s]")
    axes.set_xlim(*sorted((0, 2 * sink.mean())))
    axes.set_ylabel("height [mm]")
    axes.set_title("a closed tank's imbalance, reference cell below")
    figure.tight_layout()
    figure.savefig("results/imbalance.png", dpi=120)


if __name__ == "__main__":
    main()
