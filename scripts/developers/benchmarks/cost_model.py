"""The cost model of coupling/run/costModel.h with speeds by particles and cells: measured, fitted, for runs that are
planned. fit_cost_model.py beside this file writes scripts/clepsydra/costModel.json. A run that has begun measures its
own speeds."""

from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import nnls

from clepsydra import environment
from developers.benchmarks.hopper import Hopper

from . import timing

FILE = environment.SCRIPTS / "clepsydra" / "costModel.json"
TERMS = ("perParticleStep", "perParticle", "perCell", "perCell43")
DURATION = 0.1
ESTIMATED_DURATION = 1
# Start-up and checkpoints are no part of the model.
NOT_MODELLED = ("other", "output")


def work(conservation: dict[str, Any], hopper: Hopper, cells: Any) -> Any:
    """Particle-steps, particle-, cell- and cell^(4/3)-intervals of a run."""
    p, duration = hopper.parameters, conservation["timeEnd"] - conservation["timeStart"]
    intervals, particles = duration / p["couplingTimeStep"], conservation["particlesStart"]
    return np.array(
        [particles * duration / p["demStep"], particles * intervals, cells * intervals, cells ** (4 / 3) * intervals]
    )


def cell_count(folder: Path) -> int:
    header = (folder / "constant" / "polyMesh" / "owner").read_bytes()[:2000].decode(errors="replace")
    return int(header.split("nCells:")[1].split()[0])


def measured(hopper: Hopper, ranks: int = 1) -> tuple[Any, Any]:
    """Terms and seconds of the submerged hopper: processor time of one rank, wall time of more."""
    run = hopper.run("submerged", f"cost{ranks}", DURATION, ranks)
    conservation = timing.timed(run).result
    phases = conservation["phaseProcessorSeconds" if ranks == 1 else "phaseSeconds"]
    seconds = sum(time for name, time in phases.items() if name not in NOT_MODELLED)
    return work(conservation, hopper, cell_count(run.folder)), seconds


def fit(rows: Any) -> dict[str, Any]:
    """Coefficients >= 0 with the smallest relative errors."""
    terms = np.array([row[0] / row[1] for row in rows])
    scale = terms.max(axis=0)
    return dict(zip(TERMS, nnls(terms / scale, np.ones(len(rows)))[0] / scale))


def predicted(model: Any, terms: Any, ranks: int = 1) -> Any:
    one_rank = sum(model[name] * term for name, term in zip(TERMS, terms))
    return one_rank * (model["serialFraction"] + (1 - model["serialFraction"]) / ranks)


def cost_model_error_percent(hopper: Hopper, repetitions: int) -> timing.Figure:
    """What a run itself expects once a hundredth of it is done, from its own first intervals."""
    run = hopper.run("submerged", "estimated", ESTIMATED_DURATION)
    conservations = [time.result for time in timing.interleaved({"run": run}, repetitions)["run"]]
    return timing.Figure(
        [
            100 * (conservation["estimatedProcessorSeconds"] / sum(conservation["phaseProcessorSeconds"].values()) - 1)
            for conservation in conservations
        ],
        target="+- 15",
        meaning=f"% by which a run's estimate after 1 % is above the time it took, first {ESTIMATED_DURATION} s",
    )


def unseen_hopper(hopper: Hopper) -> Any:
    return hopper.with_cells(2e-3 if hopper.quick else 3e-3)
