#!/usr/bin/python3
"""What the measurement says: velocities with their standard errors, and the viscosity that particle 3 needs.

Writes `measured` from the raw files where they are (they are not ours to keep here); else leaves the committed one.
"""

from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq

from clepsydra import closures, parameter_file

DATA = Path("../../../../shared/data/beadfall_glycerol/data")
# of another group with the same set, +-0.02 mm
DIAMETERS = {1: 1.59e-3, 2: 2.37e-3, 3: 3.16e-3, 4: 4.73e-3, 5: 6.34e-3}
FITTED = 3
# Of five repeats the fifth, and the two files named centre and edge, were filmed in another setting: there a particle
# seems to lose 12 % of its speed on the way down, in the others 2 %. They serve for a ratio only.
REPEATS = (1, 2, 3, 4)
# Seen from the first to the last mark, away from the release and the floor [mm]
WINDOW = (20, 240)


def main() -> None:
    if not DATA.is_dir():
        print(f"{DATA} is not here: using the committed file `measured`, which was computed from it")
        return
    entries: dict[Any, Any] = {}
    for particle, diameter in DIAMETERS.items():
        velocities = [velocity(DATA / "glycerol" / f"glycerolbead{particle}t{repeat}.txt") for repeat in REPEATS]
        entries |= {
            f"particleDiameter{particle}": diameter,
            f"velocity{particle}": np.mean(velocities),
            f"velocityError{particle}": np.std(velocities, ddof=1) / np.sqrt(len(velocities)),
        }
    quarters = [
        velocity(DATA / "glycerolbead3tedge.txt", part) / velocity(DATA / "glycerolbead3tcenter.txt", part)
        for part in range(4)
    ]
    entries |= {"edgeOverCentre": np.mean(quarters), "edgeOverCentreError": np.std(quarters, ddof=1) / 2}
    entries["fluidViscosity"] = fitted_viscosity(entries)
    Path("measured").write_text(
        "// Written by ./measure.py from kyleyhw/PHY324_motion_in_fluids (GitHub), 1f0af8ed. SI units; errors are"
        " standard\n// errors of the mean of four repeats. fluidViscosity (kinematic) is fitted to particle 3 on the"
        " axis.\n" + "".join(f"{name:<20}{value:.5g};\n" for name, value in entries.items())
    )


def velocity(file: Path, quarter: Any = None) -> Any:
    """Slope of a straight line [m/s] through the window, or through one quarter of its depth."""
    time, depth = np.loadtxt(file, skiprows=2).T
    low, high = WINDOW
    if quarter is not None:
        low, high = low + (high - low) * quarter / 4, low + (high - low) * (quarter + 1) / 4
    seen = (depth > low) & (depth < high)
    return 1e-3 * np.polyfit(time[seen], depth[seen], 1)[0]


def fitted_viscosity(entries: Any) -> Any:
    def too_fast(viscosity: Any) -> Any:
        return axis_velocity(entries[f"particleDiameter{FITTED}"], viscosity) - entries[f"velocity{FITTED}"]

    return brentq(too_fast, 1e-4, 1e-3, xtol=1e-9)


def axis_velocity(diameter: Any, viscosity: Any, wall: Any = True) -> Any:
    """Of a particle on the axis, by the case's drag law and, with a wall, Di Felice's."""
    p = parameter_file.parameters("parameters")
    free = closures.value(
        "terminalVelocity",
        dragLaw=p["dragLaw"],
        particleDiameter=diameter,
        particleDensity=p["particleDensity"],
        fluidDensity=p["fluidDensity"],
        fluidViscosity=viscosity,
    )
    if not wall:
        return free
    return free * closures.value(
        "tubeVelocityRatio", diameterRatio=diameter / p["tankDiameter"], reynolds=free * diameter / viscosity
    )


if __name__ == "__main__":
    main()
