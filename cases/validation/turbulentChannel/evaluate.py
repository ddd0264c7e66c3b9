#!/usr/bin/python3
"""Holds the turbulent flow between two plates against other codes and against measured friction.

Without particles the equations are those of pimpleFoam, so that only the tolerances of the linear solvers differ. The
canopy's particles are fixed, one in the middle of each cell, so that the void fraction is the same in DPMFoam, whose
particles count for the cell of their centre. What differs there: DPMFoam has div(eps tau), we have div(tau) in model B.
"""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, parameter_file, validation
from clepsydra.picture_style import pyplot

# Of the inlet [m/s].
MEAN_VELOCITY = 1.0
# Distances of the plates after which the flow hardly changes along them.
DEVELOPED = 50
# The part of the canopy that is compared, between its ends, where the flow still changes along it.
WITHIN_CANOPY = 0.5, 0.95

SAME_IN_PIMPLEFOAM = "pimpleFoam has the same: the model with wall functions and 20 cells between the plates gives it"


class Flow:
    def __init__(self, case: Path, phase: str = "") -> None:
        self.case, self.phase = case, phase
        self.value = parameter_file.parameters(case / "parameters")
        self.along, self.across = int(self.value["cellsUp"]), int(self.value["cellsAcross"])
        self.time = case_files.times(case)[-1]

    def field(self, name: str) -> Any:
        """By cell across and cell along; of a velocity the component along the plates."""
        named = name if name == "p" else name + self.phase
        return case_files.field(self.case, self.time, named)[:, -1].reshape(self.along, self.across).T

    def distances(self) -> Any:
        return (np.arange(self.across) + 0.5) * self.value["width"] / self.across

    def friction_factor(self) -> float:
        """Shear stress at the plates over rho U2/2, from the pressure between 0.7 and 0.95 of the length."""
        first, last = (round(part * self.along) for part in (0.7, 0.95))
        p = self.field("p").mean(axis=0)
        gradient = (p[first] - p[last]) / ((last - first) * self.value["height"] / self.along)
        return float(gradient * self.value["width"] / MEAN_VELOCITY**2)

    def in_canopy(self, name: str, top: float) -> Any:
        """Values at the distances from the plate below `top`, mean along a part of the canopy."""
        cell = self.value["height"] / self.along
        start, length = self.value["canopyStart"], self.value["canopyEnd"] - self.value["canopyStart"]
        first, last = (round((start + part * length) / cell) for part in WITHIN_CANOPY)
        return self.field(name)[self.distances() < top, first:last].mean(axis=1)


def clear_rows(run: Path) -> list[dict[str, Any]]:
    ours, theirs = Flow(run), Flow(run / "pimpleFoam")
    model = run.name.split("-")[1]
    middle = ours.across // 2

    def beside(quantity: str, unit: str, value: Any) -> dict[str, Any]:
        reference = float(value(theirs))
        source = "pimpleFoam of OpenFOAM v1912"
        return validation.row(
            f"{quantity}, {model}", unit, reference, source, "otherCode", float(value(ours)), 1e-7 * reference, 1e-5
        )

    print(f"{run.name}: largest difference of U {np.abs(ours.field('U') - theirs.field('U')).max():.1e} m/s")
    rows = [
        beside("velocity in the middle of the outlet", "m/s", lambda flow: flow.field("U")[middle, -1]),
        beside("k beside the plate at the outlet", "m2/s2", lambda flow: flow.field("k")[0, -1]),
        beside("pressure at the inlet", "m2/s2", lambda flow: flow.field("p")[middle, 0]),
    ]
    if ours.value["height"] < DEVELOPED * ours.value["width"]:
        return rows
    reynolds = MEAN_VELOCITY * ours.value["width"] / ours.value["fluidViscosity"]
    dean = 0.073 * reynolds**-0.25
    return rows + [
        validation.row(
            f"friction factor, Re {reynolds:.0f}, {model}",
            "-",
            dean,
            "R. B. Dean, J. Fluids Eng. 100, 215 (1978)",
            "measured",
            ours.friction_factor(),
            0.05 * dean,
            10,
            SAME_IN_PIMPLEFOAM,
            1e-3 * dean,
        ),
    ]


def canopy_rows(run: Path) -> list[dict[str, Any]]:
    ours, theirs = Flow(run), Flow(run / "DPMFoam", ".fluid")
    top, distance = ours.value["canopyHeight"], ours.value["width"]
    print(f"{run.name}: void fraction between the particles {ours.in_canopy('voidFraction', top).mean():.4f}")

    def beside(quantity: str, unit: str, value: Any, tolerance: float) -> dict[str, Any]:
        reference = float(value(theirs))
        return validation.row(
            f"{quantity}, canopy",
            unit,
            reference,
            "DPMFoam of OpenFOAM v1912",
            "otherCode",
            float(value(ours)),
            1e-3 * reference,
            tolerance,
        )

    return [
        beside("velocity between the particles", "m/s", lambda flow: flow.in_canopy("U", top).mean(), 2),
        beside("largest velocity above them", "m/s", lambda flow: flow.in_canopy("U", distance).max(), 1),
        beside("largest k", "m2/s2", lambda flow: flow.in_canopy("k", distance).max(), 5),
        beside("pressure at the inlet", "m2/s2", lambda flow: flow.field("p")[-1, 0], 2),
    ]


def plot(runs: list[Path]) -> None:
    figure, axes = pyplot.subplots(2, len(runs), figsize=(4 * len(runs), 6), squeeze=False)
    for column, run in zip(axes.T, runs):
        for code, phase, style in (("", "", "C0-"), ("pimpleFoam", "", "C1o"), ("DPMFoam", ".fluid", "C1o")):
            if not (run / code).is_dir():
                continue
            flow = Flow(run / code, phase)
            for axis, name in zip(column, ("U", "k")):
                values = flow.in_canopy(name, np.inf) if run.name == "canopy" else flow.field(name)[:, -1]
                axis.plot(values, 1e3 * flow.distances(), style, markersize=3, label=code or "pimpleDemFoam")
        column[0].set_title(run.name)
        column[0].set_xlabel("U [m/s]")
        column[1].set_xlabel("k [m2/s2]")
        column[1].legend()
    axes[0][0].set_ylabel("x [mm]")
    axes[1][0].set_ylabel("x [mm]")
    figure.tight_layout()
    figure.savefig("results/turbulentChannel.png", dpi=120)


runs = sorted(Path("runs").iterdir())
validation.write([found for run in runs for found in (canopy_rows(run) if run.name == "canopy" else clear_rows(run))])
plot(runs)
