#!/usr/bin/python3
"""The numbers of study.yaml from the tracks, where these are (they are not ours to keep here): mean speeds in four
parts of the way.

usage: measure.py FILE ...     prints a line for each track
"""

import argparse
from pathlib import Path
from typing import Any

import numpy as np

# As the features of study.yaml have them [mm below the picture's top]
PARTS = ((20, 65), (65, 120), (120, 180), (180, 240))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", metavar="FILE", nargs="+")
    for name in parser.parse_args().files:
        time, position = np.loadtxt(name, skiprows=2).T
        seen = position > 0
        print(Path(name).stem, *(f"{mean_speed(time[seen], position[seen], *part):.4f}" for part in PARTS))


def mean_speed(time: np.ndarray, position: np.ndarray, begin: Any, end: Any) -> Any:
    """The way over its time [mm/s]."""
    deepest = np.maximum.accumulate(position)
    if deepest[0] > begin or deepest[-1] < end:
        return float("nan")
    return (end - begin) / np.diff(np.interp((begin, end), deepest, time))[0]


if __name__ == "__main__":
    main()
