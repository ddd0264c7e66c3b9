#!/usr/bin/python3
"""OpenFOAM's own DPMFoam beside pimpleDemFoam: writes where the particles of DPMFoam start, and reads what a run of
both left.

Equations: DPMFoam keeps the whole pressure gradient in the fluid and none on the particles, and its ErgunWenYuDrag
carries one 1/alpha more than model A's law: model B with GidaspowDrag, to the letter. What differs: DPMFoam counts a
particle in the cell of its centre and smooths nothing, so alpha jumps when a particle passes a face, and d(alpha)/dt
makes the pressure jump with it; it chooses DEM sub-steps by the speed of impacts, so that a bed at rest is never quite
at rest; its friction forgets its spring when it slips."""

import argparse
import re
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, validation
from clepsydra.column import GRAVITY, Column

SOURCE = "DPMFoam of OpenFOAM v1912"
LATE = 0.5  # of a run: after the start


class Ours:
    name, void_fraction = "pimpleDemFoam", "voidFraction"

    def __init__(self, run: Path) -> None:
        self.column = Column(run)
        self.case = run

    def pressure_drop(self) -> tuple[np.ndarray, np.ndarray]:
        return self.column.pressure_drop()

    def times(self) -> list[str]:
        return case_files.times(self.case)

    def mean_height(self) -> tuple[np.ndarray, np.ndarray]:
        """Times, and the height of the particles' centre of mass by the void fraction of the cells [m]."""
        times = self.times()
        cells = [case_files.field(self.case, time, self.void_fraction)[:, 0] for time in times]
        return np.array([float(time) for time in times]), np.array([self.centre_of_mass(one) for one in cells])

    def centre_of_mass(self, void_fractions: np.ndarray) -> float:
        """Its height [m]; of cells in the order of their layers."""
        solid = (1 - void_fractions).reshape(int(self.column["cellsUp"]), -1).sum(axis=1)
        return float((solid * self.column.heights()).sum() / solid.sum())

    def log(self) -> str:
        return (self.case / f"log.{self.name}").read_text()

    def processor_seconds(self) -> float:
        """Of the part of the run whose log is there: all of it, unless it was resumed."""
        phases = re.search(r"^Wall time by phase.*?\n\n", self.log(), re.MULTILINE | re.DOTALL)
        return sum(float(line.split()[-2]) for line in phases[0].splitlines()[1:] if line) if phases else float("nan")

    def simulated_seconds(self) -> float:
        """Of the same part."""
        times = [float(time) for time in re.findall(r"^Time = (\S+)", self.log(), re.MULTILINE)]
        return times[-1] - times[0] + times[1] - times[0] if len(times) > 1 else float("nan")


class Theirs(Ours):
    name, void_fraction = "DPMFoam", "alpha.fluid"

    def __init__(self, run: Path) -> None:
        super().__init__(run)
        self.case = run / "DPMFoam"

    def pressure_drop(self) -> tuple[np.ndarray, np.ndarray]:
        time, p = case_files.surface_values(self.case, "bottomPressure")
        return time, self.column["fluidDensity"] * (p[:, 0] - GRAVITY * self.column["height"])

    def lost_particles(self) -> int:
        counts = re.findall(r"Current number of parcels *= (\d+)", self.log())
        return int(self.column["particleCount"]) - int(counts[-1])

    def processor_seconds(self) -> float:
        seconds = re.findall(r"^ExecutionTime = (\S+) s", self.log(), re.MULTILINE)
        return float(seconds[-1]) if seconds else float("nan")


# --- comparing -----------------------------------------------------------------------------------


def late(time: np.ndarray, values: np.ndarray) -> tuple[float, float]:
    """Mean over the later part of a run, and its standard error from the means of ten blocks: DPMFoam's pressure jumps
    from step to step, up and down."""
    part = values[time > LATE * time[-1]]
    blocks = [block.mean() for block in np.array_split(part, min(10, len(part)))]
    return float(np.mean(blocks)), float(np.std(blocks, ddof=1) / np.sqrt(len(blocks)))


def compare(
    quantity: str,
    unit: str,
    ours: tuple[float, float],
    theirs: tuple[float, float],
    tolerance: float,
    finding: str | None = None,
    spread: float = 0,
) -> dict[str, Any]:
    """Each a value and its standard error. spread: of packings, relative; both codes begin with the same one."""
    (value, error), (reference, reference_error) = ours, theirs
    return validation.row(
        quantity,
        unit,
        reference,
        SOURCE,
        "otherCode",
        value,
        float(np.hypot(error, reference_error)),
        at_least_scatter(tolerance, theirs),
        finding,
        float(np.hypot(error, spread * value)),
    )


def at_least_scatter(tolerance: float, theirs: tuple[float, float]) -> float:
    """Percent: what DPMFoam itself does not resolve says nothing about us."""
    reference, error = theirs
    return max(tolerance, round(validation.ALLOWED_ERRORS * 100 * error / reference, 1))


def tell_speed(*codes: Ours) -> None:
    for code in codes:
        seconds, simulated = code.processor_seconds(), code.simulated_seconds()
        print(
            f"{code.case}: {seconds:.1f} s on one core for {simulated:g} simulated seconds,"
            f" {seconds / simulated / code.column['particleCount']:.2f} s per particle and simulated second"
        )


# --- the start of DPMFoam ------------------------------------------------------------------------


def write_places(dump: str, positions: Path) -> None:
    """The particles of a dump's first entry, as DPMFoam's manualInjection reads them."""
    _, particles = case_files.dumped_particles(".", dump)[0]
    rows = "\n".join("({:.12g} {:.12g} {:.12g})".format(*particle[1:4]) for particle in particles)
    positions.write_text(
        "FoamFile { version 2.0; format ascii; class vectorField; object kinematicCloudPositions; }\n\n"
        f"(\n{rows}\n)\n"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description="The places of the particles at the start of a run, for DPMFoam.")
    parser.add_argument("dump", metavar="DUMP")
    parser.add_argument("positions", type=Path, metavar="POSITIONS")
    given = parser.parse_args()
    write_places(given.dump, given.positions)


if __name__ == "__main__":
    main()
