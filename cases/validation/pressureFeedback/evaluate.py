#!/usr/bin/python3
"""Compares the rise of a light bed with the rise at the shortest interval, without low-pass.

Before the particles' answer to the pressure was in the pressure's equation, those of 50 kg/m3 burst within some ms at
intervals of .2 and 1 ms. """

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import validation
from clepsydra.column import Column
from clepsydra.picture_style import pyplot


class Rise:
    """Mean height of the particles against time."""

    def __init__(self, run: Any) -> None:
        self.name = run.name
        self.bed = run.name.split("-")[0]
        column = Column(run)
        self.interval = column["couplingTimeStep"]
        self.low_pass = column["dilationTime"]
        self.time, position, velocity = column.particles()
        self.height = position[:, :, 2].mean(axis=1)
        self.risen = self.height[-1] - self.height[0]
        self.fastest = np.linalg.norm(velocity[1:], axis=2).max() / column.terminal_velocity()


rises = [Rise(run) for run in sorted(Path("runs").iterdir())]
rows = []
for bed in sorted({rise.bed for rise in rises}):
    mine = sorted((rise for rise in rises if rise.bed == bed), key=lambda rise: (rise.interval, rise.low_pass))
    reference = mine[0]
    for rise in mine[1:]:
        print(f"{rise.name}: risen {1e3 * rise.risen:.3f} mm, fastest particle {rise.fastest:.2f} terminal velocities")
        # A splitting of first order: the bed starts some part of an interval sooner or later.
        rows.append(
            validation.row(
                f"rise of the bed, {rise.name}",
                "m",
                reference.risen,
                f"{reference.name}, ours",
                "computed",
                rise.risen,
                reference.risen * 1e-3,
                5,
            )
        )
figure, axes = pyplot.subplots(figsize=(6, 4))
for rise in rises:
    axes.plot(rise.time, 1e3 * (rise.height - rise.height[0]), label=rise.name)
axes.set_xlabel("time [s]")
axes.set_ylabel("risen [mm]")
axes.legend(fontsize=7)
figure.tight_layout()
validation.write(rows)
figure.savefig("results/pressureFeedback.png", dpi=120)
