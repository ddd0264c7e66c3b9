"""The cost model that coupling/run/costModel.h states, and that every run prints its estimate from: measured, fitted,
held against a case that the fit has not seen. fitCostModel beside this file writes costModel.json."""

import json
from pathlib import Path

import numpy as np
from scipy.optimize import nnls

from . import timing
from .hopper import Hopper

FILE = Path(__file__).resolve().parent / "costModel.json"
TERMS = ("perBeadStep", "perBead", "perCell", "perCell43")
DURATION = 0.1
# Start-up and checkpoints are no part of the model.
NOT_MODELLED = ("other", "output")


def work(ledger, hopper, cells):
    """Bead-steps, bead-, cell- and cell^(4/3)-intervals of a run."""
    p, duration = hopper.parameters, ledger["timeEnd"] - ledger["timeStart"]
    intervals, beads = duration / p["couplingInterval"], ledger["beadsStart"]
    return np.array([beads * duration / p["demStep"], beads * intervals, cells * intervals, cells**(4 / 3) * intervals])


def cellCount(folder):
    header = (folder / "constant" / "polyMesh" / "owner").read_bytes()[:2000].decode(errors="replace")
    return int(header.split("nCells:")[1].split()[0])


def measured(hopper, ranks=1):
    """Terms and seconds of the submerged hopper: processor time of one rank, wall time of more."""
    run = hopper.run("submerged", f"cost{ranks}", DURATION, ranks)
    ledger = timing.timed(run).result
    phases = ledger["phaseProcessorSeconds" if ranks == 1 else "phaseSeconds"]
    seconds = sum(time for name, time in phases.items() if name not in NOT_MODELLED)
    return work(ledger, hopper, cellCount(run.folder)), seconds


def fit(rows):
    """Coefficients >= 0 with the smallest relative errors."""
    terms = np.array([row[0] / row[1] for row in rows])
    scale = terms.max(axis=0)
    return dict(zip(TERMS, nnls(terms / scale, np.ones(len(rows)))[0] / scale))


def predicted(model, terms, ranks=1):
    oneRank = sum(model[name] * term for name, term in zip(TERMS, terms))
    return oneRank * (model["serialFraction"] + (1 - model["serialFraction"]) / ranks)


def costModelErrorPercent(hopper, repetitions):
    """The committed model on a hopper that was no part of its fit: other cells, and an hour of this machine later."""
    if not FILE.exists():
        raise timing.Skipped(f"there is no {FILE.name}; scripts/benchmarks/fitCostModel writes it")
    model = json.loads(FILE.read_text())
    unseen = unseenHopper(hopper)
    errors = []
    for _ in range(repetitions):
        terms, seconds = measured(unseen)
        errors.append(100 * (predicted(model, terms) / seconds - 1))
    return timing.Figure(
        errors, target="",
        meaning=f"% by which the model of {model['machine']} is above the time of a hopper that it was not fitted to")


def unseenHopper(hopper):
    return hopper.withCells(2e-3 if hopper.quick else 3e-3)
