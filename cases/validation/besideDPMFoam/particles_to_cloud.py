#!/usr/bin/python3
"""The places of the particles at the start of a run, as DPMFoam's manualInjection reads them."""

import argparse
from pathlib import Path

from clepsydra import case_files


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dump", metavar="DUMP")
    parser.add_argument("positions", type=Path, metavar="POSITIONS")
    given = parser.parse_args()
    _, particles = case_files.dumped_particles(".", given.dump)[0]
    rows = "\n".join("({:.12g} {:.12g} {:.12g})".format(*particle[1:4]) for particle in particles)
    given.positions.write_text(
        "FoamFile { version 2.0; format ascii; class vectorField; object kinematicCloudPositions; }\n\n"
        f"(\n{rows}\n)\n"
    )


if __name__ == "__main__":
    main()
