"""The same beads from the same packing, dry, in other programs."""

import shutil
import subprocess
import sys

from . import timing
from .stockLiggghts import STOCK_STEP, script


# In a flowing hopper lists are renewed about as often; a bed at rest would renew none.
STEPS_PER_LIST = 25


def overLammps(hopper, repetitions):
    """The bed in the closed hopper, in LIGGGHTS with our settings and in LAMMPS with pair granular: the same contact law
    (Hertz, Mindlin with history, Tsuji's damping), walls, step and neighbour lists. Not the drain itself: LAMMPS has no
    plate with a hole whose edge beads touch."""
    if not shutil.which("lmp"):
        sys.exit("benchmark: there is no program lmp; run  scripts/setup --with otherCodes")
    steps = 5000 if hopper.quick else 20000
    folder = hopper.stage("dry", "besideLammps", 0)
    writeLammpsData(hopper, folder)
    (folder / "in.lammps").write_text(lammpsScript(hopper.parameters, steps))
    (folder / "in.liggghts").write_text(liggghtsScript(hopper, steps))
    times = timing.interleaved({
        "LAMMPS": timing.Run(["lmp", "-in", "in.lammps", "-screen", "none", "-log", "log.lammps"], folder),
        "LIGGGHTS": timing.Run(["liggghts", "-in", "in.liggghts", "-screen", "/dev/null", "-log", "log.bed"], folder),
    }, repetitions)
    return timing.Figure(
        timing.ratios(times, "LAMMPS", "LIGGGHTS", "processor"), target=">= 1.2",
        meaning=f"processor time of LAMMPS (pair granular) over LIGGGHTS as we run it; bed in the closed hopper, {steps} steps",
        details={name: [time.processor for time in of] for name, of in times.items()})


def writeLammpsData(hopper, folder):
    """The packing, read by LIGGGHTS, as a data file of LAMMPS."""
    p = hopper.parameters
    setUp = script(hopper, 0).split("thermo")[0]
    (folder / "in.dump").write_text(setUp + "dump beads all custom 1 beads.dump id x y z\nrun 0\n")
    subprocess.run(["liggghts", "-in", "in.dump", "-screen", "/dev/null", "-log", "log.dump"], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL)
    lines = (folder / "beads.dump").read_text().splitlines()
    beads = [line.split() for line in lines[lines.index(next(l for l in lines if l.startswith("ITEM: ATOMS"))) + 1:]]
    half, top = 0.51 * p["tankDiameter"], 1.02 * (p["hopperHeight"] + p["waterAboveRim"])
    (folder / "beads.data").write_text(
        f"beads\n\n{len(beads)} atoms\n1 atom types\n\n{-half} {half} xlo xhi\n{-half} {half} ylo yhi\n"
        f"{-1.02 * p['tankDepth']} {top} zlo zhi\n\nAtoms # sphere\n\n"
        + "".join(f"{bead[0]} 1 {p['beadDiameter']} {p['beadDensity']} {' '.join(bead[1:])}\n" for bead in beads))


def lammpsScript(p, steps):
    law = (f"hertz/material {p['youngsModulus']} {p['restitution']} {p['poissonRatio']} "
           f"tangential mindlin NULL 1.0 {p['friction']} damping tsuji")
    return f"""units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
read_data beads.data
neighbor {0.5 * p["beadDiameter"]} bin
neigh_modify delay 0 every {STEPS_PER_LIST} check no
pair_style granular
pair_coeff * * {law}
timestep {p["demStep"]}
fix barrel all wall/gran granular {law} zcylinder {p["hopperDiameter"] / 2}
fix bottom all wall/gran granular {law} zplane 0 NULL
fix gravity all gravity 9.81 vector 0 0 -1
fix motion all nve/sphere
run {steps}
"""


def liggghtsScript(hopper, steps):
    p = hopper.parameters
    setUp = script(hopper, 0).split("fix cylinder")[0].replace(f"timestep {STOCK_STEP}", f"timestep {p['demStep']}")
    return setUp + f"""neighbor {0.5 * p["beadDiameter"]} bin
neigh_modify delay 0 every {STEPS_PER_LIST} check no
fix barrel all wall/gran model hertz tangential history primitive type 2 zcylinder {p["hopperDiameter"] / 2} 0 0
fix bottom all wall/gran model hertz tangential history primitive type 3 zplane 0
fix motion all nve/sphere
run {steps}
"""
