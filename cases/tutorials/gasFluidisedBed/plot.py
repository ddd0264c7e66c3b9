#!/usr/bin/python3
"""Pressure drop against time and the mean solid fraction in the bed: printed, and drawn into bed.png."""

from pathlib import Path
from typing import Any

import matplotlib
import numpy as np

from clepsydra import case_files, parameter_file

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

CASE = Path(__file__).parent
GRAVITY = 9.81


def main() -> None:
    p = parameter_file.parameters(CASE / "parameters")
    solid = case_files.solid_volume(CASE, p["particleDiameter"])
    area = p["width"] * p["depth"]
    load = solid * (p["particleDensity"] - p["fluidDensity"]) * GRAVITY / area
    time, drop = case_files.columns(CASE, "pressureDrop", "surfaceFieldValue.dat")
    drop = p["fluidDensity"] * drop
    late = time >= p["meansFrom"]

    means = case_files.columns(CASE, "particleMeans").T
    means = means[means[:, 0] == means[-1, 0]]
    x, z, particles, fraction = means[:, 1], means[:, 3], means[:, 5], means[:, 11]
    height = np.average(z, weights=particles)
    print(
        f"pressure drop {drop[late].mean():.0f} ± {drop[late].std():.0f} Pa (mean, swing), weight / area {load:.0f} Pa"
    )
    print(f"mean height of the particles {1e3 * height:.1f} mm, {height * area / solid:.2f} solid heights")

    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), width_ratios=(2, 1))
    left.plot(time, drop, linewidth=0.5, label="pressure drop")
    left.axhline(load, color="black", linestyle="--", label="buoyant weight / area")
    left.set(xlabel="time [s]", ylabel="pressure drop [Pa]", ylim=(0, 2 * load))
    left.legend()
    edges: Any = [np.linspace(0, p[side], int(np.ceil(p[side] / 2e-3 - 1e-6)) + 1) for side in ("width", "height")]
    table = np.histogram2d(z, x, bins=edges[::-1], weights=fraction)[0]
    shown = right.pcolormesh(1e3 * edges[0], 1e3 * edges[1], table, cmap="viridis")
    figure.colorbar(shown, label="mean solid fraction")
    right.set(xlabel="x [mm]", ylabel="z [mm]", ylim=(0, 1e3 * min(4 * height, p["height"])), aspect="equal")
    figure.tight_layout()
    figure.savefig(CASE / "bed.png", dpi=120)


main()
