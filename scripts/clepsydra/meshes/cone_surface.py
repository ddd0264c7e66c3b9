#!/usr/bin/python3
"""Surface of a hopper whose bottom is a cone, for hopperFromSurface: STL on standard output.

Reads orificeDiameter, hopperDiameter and hopperHeight from the dictionary PARAMETERS. ANGLE is the cone's between wall
and axis [degrees]. """

import argparse
import sys
from math import radians, tan

from clepsydra import parameter_file
from clepsydra.meshes import hopper_walls

ROWS = 3  # of triangles in the cone, so that they stay compact


def main() -> None:
    parser = argparse.ArgumentParser(
        prog="coneSurface", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("parameters", metavar="PARAMETERS")
    parser.add_argument("angle", metavar="ANGLE")
    given = parser.parse_args()
    p = parameter_file.parameters(given.parameters)
    try:
        angle = float(given.angle)
    except ValueError:
        sys.exit(f"coneSurface: ANGLE is {given.angle}; allowed: a number of degrees")
    orifice, hopper, height = p["orificeDiameter"] / 2, p["hopperDiameter"] / 2, p["hopperHeight"]
    if not 0 < angle < 90 or (hopper - orifice) / tan(radians(angle)) >= height:
        sys.exit(
            f"coneSurface: ANGLE is {angle:g}; allowed: above 0, below 90 degrees, and a cone lower than hopperHeight"
        )
    cone = (hopper - orifice) / tan(radians(angle))
    profile = [(orifice + (hopper - orifice) * row / ROWS, cone * row / ROWS) for row in range(ROWS + 1)] + [
        (hopper, height)
    ]
    sys.stdout.write(hopper_walls.stl("hopper", hopper_walls.revolved(profile, hopper_walls.PARTICLE_CORNERS)))


if __name__ == "__main__":
    main()
