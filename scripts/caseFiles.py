"""Reading what a case directory holds: its parameters and its observables."""

import re
from pathlib import Path

import numpy as np


def parameters(path):
    """The entries "name value;" of a flat OpenFOAM dictionary, $name replaced."""
    text = re.sub(r"//.*", "", Path(path).read_text())
    found = {}
    for name, value in re.findall(r"^\s*(\w+)\s+([^;]+);", text, re.MULTILINE):
        found[name] = found[value[1:]] if value.startswith("$") else number(value)
    return found


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def startDirectories(case, name):
    """postProcessing/<name>/<startTime>, in order of start time."""
    found = (Path(case) / "postProcessing" / name).glob("[0-9]*")
    return sorted(found, key=lambda directory: float(directory.name))


def columns(case, name):
    """The columns of an observable. Where a run was resumed, the later part wins."""
    rows = np.empty((0, 0))
    for directory in startDirectories(case, name):
        part = np.loadtxt(directory / f"{name}.dat", ndmin=2)
        if len(part) == 0:
            continue
        rows = np.vstack([rows[rows[:, 0] < part[0, 0]], part]) if len(rows) else part
    if not len(rows):
        raise SystemExit(f"{case}: no data in postProcessing/{name}")
    return rows.T
