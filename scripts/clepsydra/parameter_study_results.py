"""What scripts/parameterStudy has published: curves and inputs of runs, gathered by the entry of the parameter study's
list."""

import csv
import json
import os
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable, Union

import numpy as np

from clepsydra import whole_files


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


File = Union[Path, zipfile.Path]


def archive_of(folder: Path) -> Path:
    return folder.parent / f"{folder.name}.zip"


def archive(folder: Path) -> int:
    """Puts the files of a folder into the archive beside it, where they take the place of those with the same names,
    and removes them from the folder. The same files make the same archive. Returns how many files it has."""
    target = archive_of(folder)
    contents: dict[str, bytes] = {}
    if target.exists():
        with zipfile.ZipFile(target) as old:
            contents = {name: old.read(name) for name in old.namelist()}
    added = [path for path in sorted(folder.glob("*")) if path.suffix in (".csv", ".json")]
    if added:
        contents |= {path.name: path.read_bytes() for path in added}
        unfinished = target.with_name(f"{target.name}.unfinished")
        with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED) as new:
            for name in sorted(contents):
                # without a time: the archive would differ each time it is made
                new.writestr(zipfile.ZipInfo(name), contents[name], zipfile.ZIP_DEFLATED)
        whole_files.settle(unfinished)
        os.replace(unfinished, target)
        whole_files.settle(target.parent)
        for path in added:
            path.unlink()
    return len(contents)


def files(folder: Path, suffix: str = ".json") -> dict[str, File]:
    """The files with this suffix, by the name before it: those in a folder, and those in the archive beside it. A file
    in the folder takes the place of one in the archive. There is a JSON file for each run."""
    archived = archive_of(folder)
    found: dict[str, File] = {}
    if archived.exists():
        found = {path.name: path for path in zipfile.Path(archived).iterdir() if path.name.endswith(suffix)}
    found.update({path.name: path for path in folder.glob(f"*{suffix}")})
    return {name.removesuffix(suffix): path for name, path in sorted(found.items())}


def read(folder: Path | str) -> list[Run]:
    """All runs whose results lie in a folder or in the archive beside it, by name."""
    return [read_run(path) for path in files(Path(folder)).values()]


def read_run(path: File) -> Run:
    inputs = json.loads(path.read_text())
    beside: Any = path.parent  # zipfile.Path does not say that it is one of its own kind
    table = (beside / f"{path.name.removesuffix('.json')}.csv").read_text()
    rows = np.array([[float(value) for value in row] for row in list(csv.reader(table.splitlines()))[1:]])
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


def pooled_deviation(groups: Iterable[Any]) -> float:
    """Standard deviation of one run, taken to be the same in all groups of repeats."""
    groups = [np.asarray(group, dtype=float) for group in groups]
    freedom = sum(len(group) - 1 for group in groups)
    return np.sqrt(sum(((group - group.mean()) ** 2).sum() for group in groups) / freedom)


def mean_and_error(values: Any, deviation: float) -> tuple[float, float]:
    """Mean of repeats and its standard error, from the deviation of one run."""
    return np.mean(values), deviation / np.sqrt(len(values))
