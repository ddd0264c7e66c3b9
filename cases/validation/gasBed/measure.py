#!/usr/bin/python3
"""Means, swings and main frequencies of the measured curves, with the standard errors that their periods give.

The curve that is called voidage is taken as the solid fraction: it goes from 0.13 to 0.51, and no packing of equal
spheres has a void fraction below 0.26, nor one that flows below 0.36.

Writes `measured.json` from the digitised curves where they are (they are not ours to keep here); else leaves the
committed one."""

import json
from dataclasses import asdict
from pathlib import Path

import numpy as np

from clepsydra import periods, whole_files

DATA = Path("../../../../shared/data/fluidised_bed_pseudo2d")
SIGNALS = {"height": ("height", "m"), "solid fraction": ("voidage", "1"), "pressure": ("pressure", "Pa")}


def main() -> None:
    if not DATA.is_dir():
        print(f"{DATA} is not here: using the committed file measured.json, which was computed from it")
        return
    found = {}
    for name, (file, unit) in SIGNALS.items():
        time, values = np.loadtxt(DATA / f"{file}.csv", delimiter=",", skiprows=1).T
        in_order = np.argsort(time, kind="stable")
        found[name] = {"unit": unit, **asdict(periods.swings(time[in_order], values[in_order]))}
    whole_files.write(Path("measured.json"), json.dumps(found, indent=1) + "\n")


main()
