#!/usr/bin/python3
"""Prints the particles' mean speed across the bed at a height: x [mm], mean speed and its standard error [m/s]."""

import argparse
from pathlib import Path

from beds import BLOCK, RUN, STORED, Bed, stored


def main() -> None:
    parser = argparse.ArgumentParser(prog="profile", description=__doc__)
    parser.add_argument("height_ratio", type=float, help="height over that of the bed at rest")
    parser.add_argument(
        "run", type=Path, nargs="?", help=f"case directory; default: {RUN}, or the stored {STORED} where there is none"
    )
    options = parser.parse_args()
    bed = Bed(options.run or RUN) if options.run or RUN.exists() else stored()
    found = bed.profile(options.height_ratio)
    print(f"# mean speed at {options.height_ratio:g} H0 ({options.height_ratio * bed['restHeight']:g} m)")
    print(f"# x [mm], speed [m/s], standard error from blocks of {BLOCK:g} s [m/s]")
    for x, speed, error in zip(found.x, found.speed, found.error):
        print(f"{1e3 * x:7.1f} {speed:10.5f} {error:10.5f}")


main()
