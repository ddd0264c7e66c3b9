#!/usr/bin/python3
"""Measures hoppers of several sizes, fits the cost model to them and writes it to costModel.json beside this file.

10 minutes on a machine that has nothing else to do. One rank for the coefficients, two for the serial fraction.
"""

import argparse
import json
import tempfile
from pathlib import Path
from typing import Any

from clepsydra import whole_files
from developers.benchmarks import cost_model, report, timing
from developers.benchmarks.hopper import Hopper

# The paper's hopper: mass [kg], particle diameter [m], cells, DEM step [s], and the time [s] that it flows at the rate
# of the quick hopper, 9.8 g/s.
PAPER = {"500 g of 2 mm particles, 1.5 million cells": (0.5, 2e-3, 1.5e6, 4e-5, 51)}
DENSITY = 2540
INTERVAL = 2e-3


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    choice = parser.add_mutually_exclusive_group()
    choice.add_argument(
        "--realTime", dest="real_time", action="store_true", help="timed programs push all other work aside; root only"
    )
    choice.add_argument(
        "--predict",
        action="store_true",
        help="fit nothing, print the estimates for large runs from the file that is there",
    )
    given = parser.parse_args()
    if given.predict:
        predict(json.loads(cost_model.FILE.read_text()))
        return
    timing.real_time = given.real_time
    with tempfile.TemporaryDirectory(prefix="clepsydraCost") as folder:
        model = fitted(Path(folder))
    whole_files.write(cost_model.FILE, json.dumps(model, indent=2) + "\n")
    predict(model)


def fitted(folder: Path) -> Any:
    small, large = Hopper(folder / "small", quick=True), Hopper(folder / "large", quick=False)
    hoppers = [small.with_cells(4e-3), small, small.with_cells(1.5e-3), large.with_cells(4e-3), large]
    rows = []
    for hopper in hoppers:
        rows.append(cost_model.measured(hopper))
        print(f"{rows[-1][0]} {rows[-1][1]:.2f} s", flush=True)
    model = cost_model.fit(rows)
    # Amdahl's law: t2/t1 = f + (1 - f)/2
    _, on_two = cost_model.measured(large, ranks=2)
    model["serialFraction"] = max(0.0, 2 * on_two / rows[-1][1] - 1)
    model["machine"] = report.machine()
    model["fitted"] = [
        {
            "terms": list(terms),
            "seconds": seconds,
            "errorPercent": 100 * (cost_model.predicted(model, terms) / seconds - 1),
        }
        for terms, seconds in rows
    ]
    terms, seconds = cost_model.measured(cost_model.unseen_hopper(large))
    model["unseen"] = {
        "terms": list(terms),
        "seconds": seconds,
        "errorPercent": 100 * (cost_model.predicted(model, terms) / seconds - 1),
    }
    return model


def predict(model: Any) -> None:
    print(f"Estimates from {model['machine']}")
    for name, (mass, diameter, cells, dem_step, duration) in PAPER.items():
        particles = mass / (DENSITY * 3.14159265 / 6 * diameter**3)
        intervals = duration / INTERVAL
        terms = [
            particles * duration / dem_step,
            particles * intervals,
            cells * intervals,
            cells ** (4 / 3) * intervals,
        ]
        hours = cost_model.predicted(model, terms, ranks=2) / 3600
        print(f"{name}: {particles:.3g} particles, {duration} s: {hours:.3g} h on 2 ranks")


if __name__ == "__main__":
    main()
