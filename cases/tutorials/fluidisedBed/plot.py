#!/usr/bin/python3
"""Pressure drop and height of the bed against time: printed, and drawn into bed.png."""

from pathlib import Path

import matplotlib
import numpy as np

from clepsydra import case_files, parameter_file

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

CASE = Path(__file__).parent
GRAVITY = 9.81
SETTLED = 0.5  # of the run: what comes before is the start


def bed_height() -> tuple[np.ndarray, np.ndarray]:
    """Where the void fraction along the axis is half-way between the bed's and 1."""
    times, heights = [], []
    for path in (CASE / "postProcessing/bedHeight").glob("*/axis_voidFraction.xy"):
        z, void = np.loadtxt(path).T
        top = np.flatnonzero(void < 0.5 * (1 + np.median(void[void < 0.8])))[-1]
        times.append(float(path.parent.name))
        heights.append(z[top])
    order = np.argsort(times)
    return np.array(times)[order], np.array(heights)[order]


def main() -> None:
    p = parameter_file.parameters(CASE / "parameters")
    solid = case_files.solid_volume(CASE, p["particleDiameter"])
    area = p["width"] ** 2
    load = solid * (p["particleDensity"] - p["fluidDensity"]) * GRAVITY / area
    time, drop = case_files.columns(CASE, "pressureDrop", "surfaceFieldValue.dat")
    drop = p["fluidDensity"] * drop
    late = time > SETTLED * time[-1]
    height_time, height = bed_height()
    mean_height = height[height_time > SETTLED * time[-1]].mean()
    void = 1 - solid / (area * mean_height)
    print(f"pressure drop {drop[late].mean():.0f} Pa, buoyant weight of the bed over its area {load:.0f} Pa")
    print(f"height of the bed {1e3 * mean_height:.0f} mm, mean void fraction {void:.3f}")

    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5))
    left.plot(time, drop, linewidth=0.5, label="pressure drop")
    left.axhline(load, color="black", linestyle="--", label="buoyant weight / area")
    left.set(xlabel="time [s]", ylabel="pressure drop [Pa]", ylim=(0, 2 * load))
    left.legend()
    right.plot(height_time, 1e3 * height, "o-", markersize=3)
    right.set(xlabel="time [s]", ylabel="height of the bed [mm]", ylim=(0, 1e3 * p["height"]))
    figure.tight_layout()
    figure.savefig(CASE / "bed.png", dpi=120)


main()
