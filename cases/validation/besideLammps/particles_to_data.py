#!/usr/bin/python3
"""Writes DEM/particles.data, which LIGGGHTS and LAMMPS both read: particles at rest, where the last entry of a LIGGGHTS
dump has them, or on a lattice in the box, moved at random by less than their gaps. """

import argparse
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, parameter_file


def lattice(p: dict[str, Any]) -> Any:
    """7 x 7 x 8 particles, gaps of .4 diameters."""
    across, up = 7, 8
    spacing = np.array([p["width"] / across, p["width"] / across, 1.4 * p["particleDiameter"]])
    grid = np.stack(np.meshgrid(np.arange(across), np.arange(across), np.arange(up), indexing="ij"), axis=-1)
    shift = 0.4 * (np.random.default_rng(1).random((across * across * up, 3)) - 0.5) * p["particleDiameter"]
    return (grid.reshape(-1, 3) + 0.5) * spacing + 0.5 * shift


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", metavar="lattice|DUMP")
    source = parser.parse_args().source
    p = parameter_file.parameters("parameters")
    if source == "lattice":
        points, types, low, high = lattice(p), 2, -p["particleDiameter"], p["height"]
        sides = (low, p["width"] + p["particleDiameter"])
    else:
        _, particles = case_files.dumped_particles(".", source)[-1]
        points, types = particles[:, 1:4], 3
        sides = (-0.51 * p["tankDiameter"], 0.51 * p["tankDiameter"])
        low, high = -1.02 * p["tankDepth"], p["hopperHeight"] + p["waterAboveRim"]
    head = (
        f"particles at rest\n\n{len(points)} atoms\n{types} atom types\n\n"
        f"{sides[0]} {sides[1]} xlo xhi\n{sides[0]} {sides[1]} ylo yhi\n{low} {high} zlo zhi\n\nAtoms\n\n"
    )
    rows = "".join(
        "{} 1 {} {} {:.16g} {:.16g} {:.16g}\n".format(index + 1, p["particleDiameter"], p["particleDensity"], *point)
        for index, point in enumerate(points)
    )
    Path("DEM/particles.data").write_text(head + rows)


if __name__ == "__main__":
    main()
