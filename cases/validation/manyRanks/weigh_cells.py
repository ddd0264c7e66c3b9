#!/usr/bin/python3
"""Prints a field with 1 for each cell and WEIGHT more for each particle that RUN has in it at its first time."""

import argparse
from pathlib import Path

import numpy as np

from clepsydra import case_files, parameter_file


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", type=Path, metavar="RUN")
    parser.add_argument("weight", type=float, metavar="WEIGHT")
    given = parser.parse_args()
    p = parameter_file.parameters(given.run / "parameters")
    solid = 1 - case_files.field(given.run, case_files.times(given.run)[0], "voidFraction")[:, 0]
    particles = solid * p["width"] ** 2 * p["height"] / len(solid) / (np.pi / 6 * p["particleDiameter"] ** 3)
    weights = "\n".join(f"{value:.6g}" for value in 1 + given.weight * particles)
    print(
        f"""FoamFile {{ version 2.0; format ascii; class volScalarField; object cellWeight; }}
dimensions [0 0 0 0 0 0 0];
internalField nonuniform List<scalar>
{len(solid)}
(
{weights}
)
;
boundaryField {{ ".*" {{ type zeroGradient; }} }}"""
    )


if __name__ == "__main__":
    main()
