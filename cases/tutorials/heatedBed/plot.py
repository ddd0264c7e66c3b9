#!/usr/bin/python3
"""Temperature at the outlet against time, beside Schumann's solution: printed, and drawn into breakthrough.png."""

from pathlib import Path

import matplotlib
import numpy as np

from clepsydra import packed_bed

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

CASE = Path(__file__).parent


def main() -> None:
    bed = packed_bed.HeatedBed(CASE)
    time, temperature = bed.outlet()
    some = np.linspace(0, time[-1], 200)
    schumann = bed.schumann(some)
    balance = bed.balance
    print(
        f"{balance['particlesEnd']:.0f} particles, void fraction {bed.void_fraction():.3f}, "
        f"{bed.transfer_units():.1f} transfer units; temperature at the outlet at the end "
        f"{temperature[-1]:.3f} of the way from the initial to the inlet temperature, by Schumann {schumann[-1]:.3f}"
    )
    change = balance["heatEnd"] - balance["heatStart"]
    print(
        f"heat taken up {change:.2f} J, through the boundary {-balance['heatThroughBoundary']:.2f} J, "
        f"by the continuity error {balance['heatOfContinuityError']:.2g} J"
    )

    figure, axes = plt.subplots(figsize=(6, 4))
    axes.plot(time, temperature, label="pimpleDemFoam")
    axes.plot(some, schumann, "k--", label="Schumann 1929")
    axes.set(xlabel="time [s]", ylabel="outlet temperature, 0 initial, 1 inlet", ylim=(0, 1.02))
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(CASE / "breakthrough.png", dpi=120)


main()
