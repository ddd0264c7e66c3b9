#!/usr/bin/python3
"""When the temperature at the outlet of a packed bed passes 16, 50 and 84 % of the step at the inlet, against
Schumann's solution, and the heat that bed and water took up against the heat that came in."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import packed_bed, picture_style, validation
from clepsydra.picture_style import pyplot

SOURCE = "Schumann 1929"
# The middle does not depend on what disperses the front: heat is conserved, so that only the heat capacities matter.
MIDDLE_PERCENT = 2
# Smoothing and the scheme for div(phi,T) widen the front, conduction in the water too.
WIDTH_PERCENT = 10
# Schumann's water has one velocity. The runs with one cell across the column are those with plug flow.
UNEVEN_FLOW = "the water flows faster at the walls and in the gaps of the lattice; in the runs with plug flow it cannot"


def main() -> None:
    beds = [packed_bed.HeatedBed(run) for run in sorted(Path("runs").iterdir())]
    validation.write([row for bed in beds for row in rows_of(bed)])
    plot(beds)


def rows_of(bed: packed_bed.HeatedBed) -> list[dict[str, Any]]:
    time, temperature = bed.outlet()
    exact_time = np.linspace(0, time[-1], 2000)
    exact = bed.schumann(exact_time)
    ours = {value: packed_bed.time_at(time, temperature, value) for value in (0.16, 0.5, 0.84)}
    theirs = {value: packed_bed.time_at(exact_time, exact, value) for value in ours}
    name = bed.run.name
    print(
        f"{name}: {bed.balance['particlesEnd']:.0f} particles, void fraction {bed.void_fraction():.4f}, "
        f"{bed.transfer_units():.2f} transfer units; 16, 50, 84 % after "
        + ", ".join(f"{one:.3f}" for one in ours.values())
        + " s, Schumann "
        + ", ".join(f"{one:.3f}" for one in theirs.values())
        + " s"
    )
    middle = validation.row(
        f"half of the step at the outlet, {name}",
        "s",
        theirs[0.5],
        SOURCE,
        "computed",
        ours[0.5],
        bed.parameters["couplingTimeStep"],
        MIDDLE_PERCENT,
    )
    width = validation.row(
        f"from 16 to 84 % of the step at the outlet, {name}",
        "s",
        theirs[0.84] - theirs[0.16],
        SOURCE,
        "computed",
        ours[0.84] - ours[0.16],
        bed.parameters["couplingTimeStep"],
        WIDTH_PERCENT,
        finding=UNEVEN_FLOW if bed.parameters["cellsAcross"] > 1 else None,
    )
    balance = bed.balance
    heat = validation.row(
        f"heat taken up by bed and water, {name}",
        "J",
        balance["heatOfContinuityError"] - balance["heatThroughBoundary"],
        "heat through the boundary",
        "computed",
        balance["heatEnd"] - balance["heatStart"],
        1e-8 * abs(balance["heatThroughBoundary"]),
        1e-6,
    )
    return [middle, width, heat]


def plot(beds: list[packed_bed.HeatedBed]) -> None:
    figure, axes = pyplot.subplots(figsize=(6, 4))
    for bed in beds:
        time, temperature = bed.outlet()
        (line,) = axes.plot(time, temperature, label=bed.run.name)
        some = np.linspace(0, time[-1], 200)
        axes.plot(some, bed.schumann(some), "--", color=line.get_color())
    axes.set(xlabel="time [s]", ylabel="outlet temperature, 0 initial, 1 inlet", title="dashed: Schumann 1929")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig("results/breakthrough.png", dpi=picture_style.DPI)


if __name__ == "__main__":
    main()
