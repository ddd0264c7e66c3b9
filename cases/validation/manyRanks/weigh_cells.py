#!/usr/bin/python3
"""weighCells RUN WEIGHT: a field with 1 for each cell and WEIGHT more for each particle that RUN has in it at its first time."""

import sys

import numpy as np

from clepsydra import case_files, parameter_file

run, weight = sys.argv[1], float(sys.argv[2])
p = parameter_file.parameters(f"{run}/parameters")
solid = 1 - case_files.field(run, case_files.times(run)[0], "voidFraction")[:, 0]
particles = solid * p["width"] ** 2 * p["height"] / len(solid) / (np.pi / 6 * p["particleDiameter"] ** 3)
weights = "\n".join(f"{value:.6g}" for value in 1 + weight * particles)
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
