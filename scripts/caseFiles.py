"""Reading what a case directory holds: its parameters and its observables."""

import re
from pathlib import Path

import numpy as np


ENTRY = re.compile(r"^(\s*)(\w+)(\s+)([^;]+);", re.MULTILINE)


def parameters(path):
    """The entries "name value;" of a flat OpenFOAM dictionary, $name replaced."""
    return parametersIn(Path(path).read_text())


def parametersIn(text):
    found = {}
    for _, name, _, value in ENTRY.findall(re.sub(r"//.*", "", text)):
        found[name] = found[value[1:]] if value.startswith("$") else number(value)
    return found


def withParameters(text, values):
    """The dictionary's text with other values of entries that it has."""
    missing = set(values) - set(parametersIn(text))
    if missing:
        raise KeyError(", ".join(sorted(missing)))
    return ENTRY.sub(lambda entry: entry[1] + entry[2] + entry[3] + values.get(entry[2], entry[4]) + ";", text)


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
