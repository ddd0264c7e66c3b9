#!/usr/bin/python3
"""Compares the bed's height, its solid fraction and the pressure 45 mm above the distributor with the measured ones.

Each is compared by its mean, its swing and its main frequency; with --quick the pressure gradient in a bed at rest is
compared with the drag law. With --signals the three of them are written to results/signals.dat instead."""

import argparse
import json
from math import hypot
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, closures, parameter_file, periods, validation
from clepsydra.periods import Estimate, Swings

START = 1.0  # [s] the bed has left its first state behind
INNER_DIAMETERS = 5  # from the distributor and from the top of the bed at rest
SOURCE = "van Wachem et al. 2001, as digitised for Lethe"
# A fifth: what other codes' beds of this kind differ by; swings and frequencies of a few periods by more.
TOLERANCES = {"mean": 20, "deviation": 40, "frequency": 25}
LOOSER_CELLS = "the gas prefers the looser cells: with each cell's own velocity the law gives 2 % less"
NOT_TRACED = "tried with one drag law, one packing and one mesh; not traced"


class Bed:
    def __init__(self, run: Path) -> None:
        self.run, self.parameters = run, parameter_file.parameters(run / "parameters")

    def __getitem__(self, name: str) -> Any:
        return self.parameters[name]

    # --- what moves ---

    def signals(self) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Times, and values in the units of measured.json."""
        step, height = np.loadtxt(self.run / "DEM/height.dat").T
        time, pressure = self.probe("p")
        _, void_fraction = self.probe("voidFraction")
        return {
            "height": ((step - step[0]) * self["demStep"], height),
            "solid fraction": (time, 1 - void_fraction),
            "pressure": (time, self["fluidDensity"] * pressure),
        }

    def probe(self, field: str) -> tuple[np.ndarray, np.ndarray]:
        rows = np.vstack([np.loadtxt(part / field) for part in case_files.start_directories(self.run, "probes")])
        return rows[:, 0], rows[:, 1]

    def swings(self, signal: str) -> Swings:
        time, values = self.signals()[signal]
        moving = time > START
        return periods.swings(time[moving], values[moving])

    # --- what is at rest ---

    def layer_means(self, name: str) -> np.ndarray:
        values = case_files.field(self.run, case_files.times(self.run)[-1], name)[:, 0]
        return values.reshape(int(self["cellsUp"]), -1).mean(axis=1)

    def inner_gradients(self) -> tuple[float, float]:
        """Of the pressure [Pa/m], and of the drag law with the void fraction of the same layers of cells."""
        void_fraction, pressure = self.layer_means("voidFraction"), self["fluidDensity"] * self.layer_means("p")
        cell_height = self["height"] / self["cellsUp"]
        solid_height = np.sum(1 - void_fraction) * cell_height
        top = solid_height / (1 - void_fraction[0])
        middles = (np.arange(len(pressure)) + 0.5) * cell_height
        margin = INNER_DIAMETERS * self["particleDiameter"]
        inner = np.flatnonzero((middles > margin) & (middles < top - margin))
        first, last = int(inner[0]), int(inner[-1])
        weights = np.ones(last - first + 1)
        weights[[0, -1]] = 0.5
        law = [self.gradient(one) for one in void_fraction[first : last + 1]]
        return (pressure[first] - pressure[last]) / (last - first) / cell_height, float(
            np.average(law, weights=weights)
        )

    def gradient(self, void_fraction: float) -> float:
        return closures.bed_pressure_gradient(self["superficialVelocity"], void_fraction, self.parameters)


def rows_beside_measurement(bed: Bed) -> list[dict[str, Any]]:
    measured = json.loads(Path("measured.json").read_text())
    rows = []
    for signal, of_signal in measured.items():
        ours = bed.swings(signal)
        for name, tolerance in TOLERANCES.items():
            if (signal, name) == ("pressure", "mean"):
                continue  # it was measured without its mean
            reference, here = Estimate(**of_signal[name]), getattr(ours, name)
            rows.append(
                validation.row(
                    f"{name} of the {signal}, {bed['dragLaw']}",
                    "1/s" if name == "frequency" else of_signal["unit"],
                    reference.value,
                    SOURCE,
                    "measured",
                    here.value,
                    hypot(reference.error, here.error),
                    tolerance,
                    finding=NOT_TRACED,
                    repeats=here.error,
                )
            )
    return rows


def row_at_rest(bed: Bed) -> dict[str, Any]:
    ours, law = bed.inner_gradients()
    where = f"gradient within the bed at rest, U {bed['superficialVelocity']:g} m/s"
    source = f"{bed['dragLaw']}, cells' void fraction"
    return validation.row(where, "Pa/m", law, source, "computed", ours, 1e-4 * ours, 2, finding=LOOSER_CELLS)


def write_signals(bed: Bed) -> None:
    """At the times of the probes."""
    signals = bed.signals()
    time, pressure = signals["pressure"]
    columns = [time, np.interp(time, *signals["height"]), signals["solid fraction"][1], pressure]
    Path("results").mkdir(exist_ok=True)
    titles = "time [s]\theight [m]\tsolidFraction [1]\tpressure [Pa]"
    np.savetxt("results/signals.dat", np.transpose(columns), "%.6g", "\t", header=titles)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--signals", action="store_true", help="write them; nothing is compared")
    if parser.parse_args().signals:
        write_signals(Bed(Path("runs/bed0.9")))
        return
    beds = [Bed(run) for run in sorted(Path("runs").glob("bed*"))]
    rows = [row for bed in beds if bed["endTime"] > START for row in rows_beside_measurement(bed)]
    rows += [row_at_rest(bed) for bed in beds if bed["endTime"] < START]
    validation.write(rows)


main()
