"""What scripts/parameterStudy has published: curves and inputs of runs, gathered by the entry of the parameter study's
list."""

import csv
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable

import numpy as np


@dataclass(frozen=True)
class Run:
    name: str  # <case>.<seed>.<step>
    case: str  # <entry>-<swept values>
    step: str
    seed: int
    parameters: dict
    time: np.ndarray  # s
    mass: np.ndarray  # in the hopper, kg
    cost: dict


def read(folder: Path | str) -> list[Run]:
    """All runs whose results lie in a folder, by name."""
    return [read_run(path) for path in sorted(Path(folder).glob("*.json"))]


def read_run(path: Path) -> Run:
    inputs = json.loads(path.read_text())
    with path.with_suffix(".csv").open() as stream:
        rows = np.array([[float(value) for value in row] for row in list(csv.reader(stream))[1:]])
    return Run(
        inputs["run"],
        inputs["run"].rsplit(".", 2)[0],
        inputs["step"],
        int(inputs["seed"]),
        inputs["parameters"],
        rows[:, 0],
        rows[:, 1],
        inputs["cost"],
    )


def by_case(runs: list[Run]) -> dict[str, list[Run]]:
    """The runs of each case, as {case: [Run, ...]}: repeats that differ by their packing."""
    found: dict[Any, Any] = {}
    for run in runs:
        found.setdefault(run.case, []).append(run)
    return found


def pooled_deviation(groups: Iterable[np.ndarray]) -> float:
    """Standard deviation of one run, taken to be the same in all groups of repeats."""
    groups = [np.asarray(group, dtype=float) for group in groups]
    freedom = sum(len(group) - 1 for group in groups)
    return np.sqrt(sum(((group - group.mean()) ** 2).sum() for group in groups) / freedom)


def mean_and_error(values: np.ndarray, deviation: float) -> tuple[float, float]:
    """Mean of repeats and its standard error, from the deviation of one run."""
    return np.mean(values), deviation / np.sqrt(len(values))
