#!/usr/bin/python3
"""Mean velocity of the particles in the bed, and their mean speed across it at three heights: printed, and drawn into
spout.png."""

from pathlib import Path
from typing import Any

import matplotlib
import numpy as np

from clepsydra import case_files, parameter_file

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

CASE = Path(__file__).parent
PACKED = 0.58  # solid fraction of a bed at rest
REACH = 4e-3  # [m] within which particles count for a height


def main() -> None:
    p = parameter_file.parameters(CASE / "parameters")
    means = case_files.columns(CASE, "particleMeans").T
    means = means[means[:, 0] == means[-1, 0]]
    x, z, particles, speed, upwards = means[:, 1], means[:, 3], means[:, 5], means[:, 6], means[:, 10]
    solid = case_files.solid_volume(CASE, p["particleDiameter"])
    rest = solid / PACKED / (p["width"] * p["depth"])

    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
    edges: Any = [np.arange(0, p[side] + 1e-3, 2e-3) for side in ("width", "height")]
    edges[0] -= p["width"] / 2
    table = np.histogram2d(z, x, bins=edges[::-1], weights=upwards)[0]
    held = np.histogram2d(z, x, bins=edges[::-1], weights=particles)[0]
    limit = float(np.abs(upwards[z < 2 * rest]).max())
    colours = {"cmap": "RdBu_r", "vmin": -limit, "vmax": limit}
    shown = left.pcolormesh(1e3 * edges[0], 1e3 * edges[1], np.where(held > 0, table, np.nan), **colours)
    figure.colorbar(shown, label="mean velocity upwards [m/s]")
    left.set(xlabel="x [mm]", ylabel="z [mm]", ylim=(0, 2e3 * rest), aspect="equal")

    print(f"height of the bed at rest, of a solid fraction of {PACKED:g}: {1e3 * rest:.0f} mm")
    for part in (0.25, 0.5, 0.75):
        places, profile = profile_at(part * rest, x, z, particles, speed)
        middle, side = np.abs(places) < 0.5 * p["channelWidth"], np.abs(places) > 0.4 * p["width"]
        print(
            f"mean speed at {part:g} of it: {profile[middle].mean():.2f} m/s above the channel, "
            f"{profile[side].mean():.2f} m/s at the walls"
        )
        right.plot(1e3 * places, profile, "o-", markersize=3, label=f"{1e3 * part * rest:.0f} mm")
    right.set(xlabel="x [mm]", ylabel="mean speed of the particles [m/s]", ylim=(0, None))
    right.legend(title="height")
    figure.tight_layout()
    figure.savefig(CASE / "spout.png", dpi=120)


def profile_at(height: float, *columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places and mean speeds of the particles within REACH of a height."""
    near = np.abs(columns[1] - height) < REACH
    x, _, particles, speed = (column[near] for column in columns)
    places = np.unique(x)
    counts = np.array([particles[x == place].sum() for place in places])
    return places, np.array([(particles * speed)[x == place].sum() for place in places]) / counts


main()
