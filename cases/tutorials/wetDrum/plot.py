#!/usr/bin/python3
"""Torque of the drum and slope of the bed, printed and drawn against time into drum.png beside the last particles."""

from pathlib import Path

import matplotlib
import numpy as np

from clepsydra import parameter_file
from clepsydra.drum import Drum
from clepsydra.periods import error_by_parts

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

CASE = Path(__file__).parent


def main() -> None:
    drum = Drum(CASE)
    radius = 0.5 * parameter_file.parameters(CASE / "parameters")["drumDiameter"]
    torques, weights, angles = drum.torques[drum.steady], drum.weights[drum.steady], drum.angles[drum.steady]
    error = error_by_parts(torques - weights)
    print(
        f"{drum.count} particles: torque of the drum {1e6 * torques.mean():.1f} ± {1e6 * error:.1f} uN m, "
        f"of the weight less buoyancy {1e6 * weights.mean():.1f} uN m"
    )
    print(f"slope of the bed {angles.mean():.1f} ± {error_by_parts(angles):.1f} degrees")

    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), width_ratios=(3, 2))
    left.plot(drum.times, 1e6 * drum.torques, linewidth=0.5, label="torque of the drum on the particles")
    left.plot(drum.times, 1e6 * drum.weights, label="torque of the weight less buoyancy")
    left.set(xlabel="time [s]", ylabel="torque [uN m]")
    left.legend()
    _, x, y, _, vx, vy, vz = drum.last[:, :7].T
    shown = right.scatter(1e3 * x, 1e3 * y, c=1e3 * np.sqrt(vx**2 + vy**2 + vz**2), s=18, cmap="viridis")
    right.add_patch(plt.Circle((0, 0), 1e3 * radius, fill=False))
    figure.colorbar(shown, label="speed [mm/s]")
    right.set(xlabel="x [mm]", ylabel="y [mm]", aspect="equal")
    figure.tight_layout()
    figure.savefig(CASE / "drum.png", dpi=120)


main()
