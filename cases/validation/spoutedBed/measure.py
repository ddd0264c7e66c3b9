#!/usr/bin/python3
"""What the measured curves say at each height: mean speed across the bed, speed on the axis, width of the jet, and
means over bands of 20 mm.

Writes `measured.json` from the digitised curves where they are (they are not ours to keep here); else leaves the
committed one."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import particle_means, whole_files

DATA = Path("../../../../shared/data/spouted_bed")
HEIGHTS = {"0.15": "height_015.csv", "0.45": "height_045.csv", "0.75": "height_075.csv"}  # over the height at rest
SOURCE = "Yue et al., points as they stand in Lethe's example gas-solid-spouted-rectangular-bed"
BAND = 20e-3


def main() -> None:
    if not DATA.is_dir():
        print(f"{DATA} is not here: using the committed file measured.json, which was computed from it")
        return
    found = {height: features(*curve(DATA / file)) for height, file in HEIGHTS.items()}
    whole_files.write(Path("measured.json"), json.dumps({"source": SOURCE, "heights": found}, indent=1) + "\n")


def curve(file: Path) -> tuple[np.ndarray, np.ndarray]:
    x, speed = np.loadtxt(file, delimiter=",", skiprows=1).T
    return 1e-3 * x, speed


def features(x: np.ndarray, speed: np.ndarray) -> dict[str, Any]:
    """In m and m/s. The bed and its jet are symmetric: the difference of its halves tells the error of a mean, that of
    the two points beside the axis the error there. The width is not known better than the points are apart."""
    left, right = x < 0, x > 0
    halves = [particle_means.mean_across(x[half], speed[half]) for half in (left, right)]
    beside = speed[[np.flatnonzero(left)[-1], np.flatnonzero(right)[0]]]
    spacing = float(np.diff(x).mean())
    edges = np.arange(-0.14, 0.14 + BAND / 2, BAND)
    bands = [float(speed[(x >= low) & (x < high)].mean()) for low, high in zip(edges, edges[1:])]
    return {
        "from": float(x[0]),
        "to": float(x[-1]),
        "mean": {"value": particle_means.mean_across(x, speed), "error": abs(halves[1] - halves[0]) / 2},
        "axis": {"value": float(np.interp(0, x, speed)), "error": float(abs(beside[1] - beside[0])) / 2},
        "width": {"value": particle_means.width_at_half(x, speed), "error": spacing * (2 / 12) ** 0.5},
        "bandWidth": BAND,
        "bands": bands,
    }


if __name__ == "__main__":
    main()
