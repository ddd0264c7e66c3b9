"""Orifices of five particle diameters that close when the plug is taken away: runs of arches.yaml.

Tells arches of the start from clogs of a flow: each packing is one start, and after it each particle that leaves is one
chance to clog. """

from __future__ import annotations

from typing import Any

import numpy as np

from clepsydra import parameter_study_results, validation

RUNS = "results/runs/arches"
STARTED = 200  # particles out, after which the flow has started: an arch of the start lets at most some 90 pass
PAPER = "Koivisto et al., arXiv 1703.09584: hoppers of this hole and these particles flow until they are empty"
LOW, HIGH = (0.3, 0.4), (0.6, 0.8)  # frictions
# A packing that closes is one of twelve.
TOLERANCE = 8  # %
FINDING = (
    "at a high friction an arch closes the hole in every third packing, within the first 80 particles, as in "
    "CFDEMcoupling: the packing comes to rest on the plug, which is gone at once"
)


def read() -> list[parameter_study_results.Run]:
    return parameter_study_results.read(RUNS)


def left(run: parameter_study_results.Run) -> int:
    return round((run.mass[0] - run.mass[-1]) / run.mass[0] * run.parameters["particleCount"])


def stopped(run: parameter_study_results.Run) -> bool:
    """A step that ends before its time does so because no more particles leave."""
    return bool(run.time[-1] < run.parameters[f"{run.step}Time"] - 1e-6)


def report(runs: list[parameter_study_results.Run]) -> None:
    print("arches over a hole of 5 diameters: packings, of these closed, and the particles that had left before")
    for name, own in parameter_study_results.by_case(runs).items():
        closed = sorted(left(run) for run in own if stopped(run))
        print(f"  {name:22}{len(own):3}{len(closed):4}  {', '.join(map(str, closed))}")
    after = [run for run in runs if left(run) > STARTED]
    flowed = sum(left(run) - STARTED for run in after)
    print(f"  after the first {STARTED} particles: {sum(map(stopped, after))} clogs, {flowed} particles left")


def rows_of(runs: list[parameter_study_results.Run]) -> list[Any]:
    """Parts of the packings that start to flow, and of the flows that go on."""
    plain = [run for run in runs if run.case.startswith("friction-")]
    starts = {
        "friction 0.3 and 0.4": [left(run) > STARTED for run in plain if run.parameters["friction"] in LOW],
        "friction 0.6 and 0.8": [left(run) > STARTED for run in plain if run.parameters["friction"] in HIGH],
    }
    compared = {f"part of the packings that start to flow, D/d 5, {name}": flows for name, flows in starts.items()}
    compared["part of the flows that go on for 0.5 s and more, D/d 5, all runs"] = [
        not stopped(run) for run in runs if left(run) > STARTED
    ]
    return [
        validation.row(quantity, "-", 1, PAPER, "measured", float(np.mean(hits)), error_of(hits), TOLERANCE, FINDING, 0)
        for quantity, hits in compared.items()
        if hits
    ]


def error_of(hits: list[bool]) -> float:
    """Standard error of a part (Agresti & Coull, Am. Stat. 52, 119 (1998)), which is not 0 where all are alike."""
    part = (sum(hits) + 2) / (len(hits) + 4)
    return float(np.sqrt(part * (1 - part) / (len(hits) + 4)))
