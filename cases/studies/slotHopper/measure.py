#!/usr/bin/python3
"""Rates and residue of the digitised curves, as study.yaml has them, with errors by the scatter of their points.

Each point's error in time is that of the points between 8 and 82 % about a parabola through them."""

from pathlib import Path

import numpy as np

DATA = Path(__file__).resolve().parents[4] / "shared/data/hopper_dry_digitised"
WINDOWS = {"start": (0.93, 0.68), "end": (0.68, 0.18)}


def main() -> None:
    for curve in ("plastic_ball", "plastic_cylinder"):
        time, discharged = np.loadtxt(DATA / f"{curve}.csv", delimiter=",", skiprows=1).T
        left = 1 - discharged / 100
        straight = (left > 0.18) & (left < 0.92)
        parabola = np.polyfit(left[straight], time[straight], 2)
        errors = time[straight] - np.polyval(parabola, left[straight])
        error = np.sqrt(np.sum(errors**2) / (np.count_nonzero(straight) - 3))
        for window, ends in WINDOWS.items():
            duration = np.ptp(np.interp(ends, left[::-1], time[::-1]))
            rate = (ends[0] - ends[1]) / duration
            print(f"{curve} {window}: {rate:.4f} 1/s, relative error {np.sqrt(2) * error / duration:.3f}")
        print(f"{curve} residue: {left[-1]:.4f}")


main()
