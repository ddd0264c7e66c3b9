#!/usr/bin/python3
"""usage: particlesToCloud DUMP POSITIONS: the places of the particles at the start of a run, as DPMFoam's manualInjection reads."""

import sys
from pathlib import Path

from clepsydra import case_files

dump, positions = sys.argv[1:]
_, particles = case_files.dumped_particles(".", dump)[0]
rows = "\n".join("({:.12g} {:.12g} {:.12g})".format(*particle[1:4]) for particle in particles)
Path(positions).write_text(
    f"FoamFile {{ version 2.0; format ascii; class vectorField; object kinematicCloudPositions; }}\n\n(\n{rows}\n)\n"
)
