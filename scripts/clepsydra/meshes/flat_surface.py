"""Surface of a flat-bottomed hopper, its bottom with a round orifice: STL on standard output.

Reads orificeDiameter, hopperDiameter, hopperHeight, landHeight and bevelHeight from the dictionary PARAMETERS. The
orifice's edge lies in the plane z = 0; below it the orifice goes on as a vertical land, and then widens by 45 degrees.
"""

import argparse
import sys
from math import ceil, log

from clepsydra import parameter_file
from clepsydra.meshes import hopper_walls

ROWS_PER_DIAMETER = 2  # of triangles in the cylinder: long ones are near more particles


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        usage="flatSurface PARAMETERS > hopper.stl",
    )
    parser.add_argument("parameters", metavar="PARAMETERS", help="a case's file `parameters`")
    path = parser.parse_args().parameters
    p = parameter_file.parameters(path)
    for name in ("orificeDiameter", "hopperDiameter", "hopperHeight", "landHeight", "bevelHeight"):
        if not isinstance(p.get(name), float) or p[name] < 0:
            sys.exit(f"flatSurface: {path}: entry '{name}' is {p.get(name, 'missing')}; allowed: a length [m]")
    orifice, hopper, height = p["orificeDiameter"] / 2, p["hopperDiameter"] / 2, p["hopperHeight"]
    if not 0 < orifice + p["bevelHeight"] < hopper:
        sys.exit(f"flatSurface: {path}: orificeDiameter and bevelHeight; allowed: both together within hopperDiameter")
    rings = max(1, round(log(hopper / orifice) / 0.25))  # wider apart as they grow, so that triangles stay compact
    bottom = [(orifice * (hopper / orifice) ** (ring / rings), 0.0) for ring in range(rings + 1)]
    rows = max(1, ceil(ROWS_PER_DIAMETER * height / (2 * hopper)))
    cylinder = [(hopper, height * row / rows) for row in range(1, rows + 1)]
    profile = hopper_walls.exit_profile(p)[:0:-1] + bottom + cylinder
    sys.stdout.write(hopper_walls.stl("hopper", hopper_walls.revolved(profile, hopper_walls.PARTICLE_CORNERS)))


if __name__ == "__main__":
    main()
