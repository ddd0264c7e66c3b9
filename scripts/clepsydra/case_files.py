"""Reading what a case directory holds: its parameters and its observables."""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np

TIME_ROUNDING = 1e-5  # a part's start is the name of a folder, in six digits


def start_directories(case: Path | str, name: str) -> list[Path]:
    """postProcessing/<name>/<startTime>, in order of start time."""
    found = (Path(case) / "postProcessing" / name).glob("[0-9]*")
    return sorted(found, key=lambda directory: float(directory.name))


def columns(case: Path | str, name: str, table: str | None = None) -> np.ndarray:
    """The columns of a function object's table, <name>.dat unless given. Brackets around vectors do not count. Where a
    run was resumed, the later part wins."""
    rows = np.empty((0, 0))
    for directory in start_directories(case, name):
        text = (directory / (table or f"{name}.dat")).read_text().replace("(", " ").replace(")", " ")
        lines = [line for line in text.splitlines() if line and not line.startswith("#")]
        if not lines:
            continue
        part = np.loadtxt(lines, ndmin=2)
        rows = np.vstack([rows[rows[:, 0] < part[0, 0]], part]) if len(rows) else part
    if not len(rows):
        raise SystemExit(f"{case}: no data in postProcessing/{name}")
    return rows.T


def balances(case: Path | str) -> list[dict[str, Any]]:
    """The conservation check's summaries of a run, in order of time. A part that is killed writes none."""
    files = [directory / "summary.json" for directory in start_directories(case, "conservation")]
    return [json.loads(file.read_text()) for file in files if file.exists()]


def solid_volume(case: Path | str, diameter: float) -> float:
    """Of the particles that the solver counted, which are all of one diameter."""
    parts = balances(case)
    if not parts:
        raise SystemExit("plot: there is no postProcessing/conservation: has the solver come to its end?")
    return float(parts[0]["particlesEnd"] * np.pi / 6 * diameter**3)


def missing_balances(case: Path | str, parts: list[dict[str, Any]], end: float) -> list[tuple[float, float]]:
    """(from, to) of each piece of a run, up to `end`, that none of these balances are of."""
    starts = [float(directory.name) for directory in Path(case).glob("postProcessing/*/[0-9]*")]
    missing, reached = [], min(starts)
    for part in [*parts, {"timeStart": end, "timeEnd": end}]:
        if part["timeStart"] - reached > TIME_ROUNDING * reached:
            missing.append((reached, part["timeStart"]))
        reached = max(reached, part["timeEnd"])
    return missing


def times(case: Path | str) -> list[str]:
    """Names of the time directories after the start, in order."""
    found = [path.name for path in Path(case).iterdir() if re.fullmatch(r"[0-9][0-9.e-]*", path.name)]
    return sorted((name for name in found if float(name) > 0), key=float)


def is_divided(case: Path | str, name: str) -> bool:
    """Whether a run on several ranks has written this field at a time after the start."""
    part = Path(case) / "processor0"
    return part.is_dir() and any((part / time / name).exists() for time in times(part))


def field(case: Path | str, time: str, name: str) -> np.ndarray:
    """Values of a field in all cells, one row per cell; of one row where the field is uniform. Written as ascii."""
    text = (Path(case) / time / name).read_text()
    entry = re.search(
        r"^internalField\s+(nonuniform List<\w+>\s*\d+\s*\((.*?)\)|uniform ([^;]*))\s*;",
        text,
        re.MULTILINE | re.DOTALL,
    )
    if not entry:
        raise SystemExit(f"{case}/{time}/{name}: no internalField in ascii")
    # A short list stands in one line.
    values = entry.group(2) or entry.group(3)
    rows = re.findall(r"\(([^()]*)\)", values) or (values.split() if entry.group(2) else [values])
    return np.array([[float(part) for part in row.split()] for row in rows])


def surface_values(case: Path | str, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Times and values, one row per time, of a function object surfaceFieldValue."""
    rows = columns(case, name, "surfaceFieldValue.dat").T
    return rows[:, 0], rows[:, 1:]


def dumped_particles(case: Path | str, dump: str = "DEM/particles.dump") -> list[tuple[int, np.ndarray]]:
    """The entries of a LIGGGHTS dump: step, and an array with a row per particle and the columns that the dump has."""
    lines = (Path(case) / dump).read_text().splitlines()
    entries, at = [], 0
    while at < len(lines):
        step, count = int(lines[at + 1]), int(lines[at + 3])
        entries.append((step, np.array([line.split() for line in lines[at + 9 : at + 9 + count]], dtype=float)))
        at += 9 + count
    return entries
