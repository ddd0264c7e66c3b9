#!/usr/bin/python3
"""Pressure drop against time and the mean solid fraction in the bed: printed, and drawn into bed.png."""

import json
import re
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

CASE = Path(__file__).parent
GRAVITY = 9.81


def parameters() -> dict[str, float]:
    entries = re.findall(r"(?m)^(\w+)\s+([-+.\deE]+);", (CASE / "parameters").read_text())
    return {name: float(value) for name, value in entries}


def solid_volume(p: dict[str, float]) -> float:
    """Of the particles that the solver counted: it writes this balance at its end."""
    balances = sorted((CASE / "postProcessing/conservation").glob("*/summary.json"))
    if not balances:
        raise SystemExit("plot: there is no postProcessing/conservation: has the solver come to its end?")
    return json.loads(balances[0].read_text())["particlesEnd"] * np.pi / 6 * p["particleDiameter"] ** 3


def rows(name: str, table: str) -> np.ndarray:
    """All of a function object's rows, those of a resumed run behind the ones before."""
    parts = sorted((CASE / "postProcessing" / name).glob(f"*/{table}"), key=lambda path: float(path.parent.name))
    lines = [line for path in parts for line in path.read_text().splitlines() if not line.startswith("#")]
    return np.loadtxt(lines, ndmin=2)


def main() -> None:
    p = parameters()
    solid = solid_volume(p)
    area = p["width"] * p["depth"]
    load = solid * (p["particleDensity"] - p["fluidDensity"]) * GRAVITY / area
    time, drop = rows("pressureDrop", "surfaceFieldValue.dat").T
    drop = p["fluidDensity"] * drop
    late = time >= p["meansFrom"]

    means = rows("particleMeans", "particleMeans.dat")
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
