"""The same particles from the same packing, dry, in other programs."""

import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

from developers.benchmarks.hopper import Hopper

from . import timing
from .hopper import conservation, forget_results, solver
from .stock_liggghts import STOCK_STEP, liggghts, script

# In a flowing hopper lists are renewed about as often; a bed at rest would renew none.
STEPS_PER_LIST = 25


def over_lammps(hopper: Hopper, repetitions: int) -> timing.Figure:
    """The bed in the closed hopper, in our program and in LAMMPS with pair granular: the same contact law (Hertz,
    Mindlin with history, Tsuji's damping), walls, step and neighbour lists."""
    require("lmp")
    steps = 5000
    folder = closed_hopper(hopper, "besideLammps", steps)
    (folder / "in.lammps").write_text(lammps_script(hopper.parameters, steps))
    log = folder / "log.lammps"
    times = timing.interleaved(
        {
            "LAMMPS": timing.Run(
                ["lmp", "-in", "in.lammps", "-screen", "none", "-log", log.name], folder, result=lambda: loop_time(log)
            ),
            "ours": bed(folder),
        },
        repetitions,
    )
    return per_step_ratio(
        hopper,
        times,
        "LAMMPS",
        {"LAMMPS": steps, "ours": steps},
        ">= 1.2",
        "LAMMPS (pair granular)",
        f"{steps} steps of each",
    )


def over_yade(hopper: Hopper, repetitions: int) -> timing.Figure:
    """The same bed in Yade: Hertz-Mindlin with damping by restitution, the cylinder of triangles, its own neighbour
    lists of the same width. Yade takes so long that it does fewer steps."""
    require("yade")
    steps, yade_steps = 5000, 1000 if hopper.quick else 400
    folder = closed_hopper(hopper, "besideYade", steps)
    (folder / "bed.py").write_text(yade_script(hopper.parameters, yade_steps))
    loop = folder / "seconds"
    times = timing.interleaved(
        {
            "Yade": timing.Run(["yade", "-n", "-x", "-j1", "bed.py"], folder, result=lambda: float(loop.read_text())),
            "ours": bed(folder),
        },
        repetitions,
    )
    return per_step_ratio(
        hopper, times, "Yade", {"Yade": yade_steps, "ours": steps}, ">= 10", "Yade", f"{yade_steps} and {steps} steps"
    )


def closed_hopper(hopper: Hopper, name: str, steps: Any) -> Any:
    """A step with the packing in the closed hopper, for our program; the packing as LAMMPS' data beside it."""
    (hopper.case / "DEM" / "in.bed").write_text(liggghts_script(hopper))
    folder = hopper.step("dry", name, steps * hopper.parameters["demStep"], stepScript='"DEM/in.bed"')
    write_lammps_data(hopper, folder)
    return folder


def bed(folder: Path) -> Any:
    return timing.Run(
        solver(),
        folder,
        prepare=lambda: forget_results(folder),
        result=lambda: conservation(folder)["phaseProcessorSeconds"]["DEM"],
    )


def per_step_ratio(
    hopper: Hopper, times: Any, other: Any, steps: Any, target: Any, said: str, took: Any
) -> timing.Figure:
    """Loops only, without the start of the programs."""
    per_step = {name: [time.result / steps[name] for time in of] for name, of in times.items()}
    return timing.Figure(
        [theirs / ours for theirs, ours in zip(per_step[other], per_step["ours"])],
        target=target,
        meaning=f"time per DEM step of {said} over pimpleDemFoam's; bed in the closed hopper, {took}",
        details={
            name: {"particleStepsPerSecond": [hopper.parameters["particleCount"] / seconds for seconds in of]}
            for name, of in per_step.items()
        },
    )


def require(program: Any) -> None:
    if not shutil.which(program):
        raise timing.Skipped(f"there is no program {program}; scripts/setup --with otherCodes installs it")


def loop_time(log: Path) -> float:
    """Processor seconds of LAMMPS' loop."""
    text = log.read_text()
    (wall,), (percent,) = re.findall(r"Loop time of (\S+)", text)[:1], re.findall(r"(\S+)% CPU use", text)[:1]
    return float(wall) * float(percent) / 100


def yade_script(p: dict[str, Any], steps: Any) -> str:
    radius = p["hopperDiameter"] / 2
    return f"""from yade import geom
import time
glass = O.materials.append(FrictMat(young={p["youngsModulus"]}, poisson={p["poissonRatio"]},
                                    density={p["particleDensity"]}, frictionAngle=atan({p["friction"]})))
text = open("particles.data").read().split("Atoms # sphere\\n\\n")[1]
for line in text.splitlines():
    O.bodies.append(sphere([float(x) for x in line.split()[-3:]], {p["particleDiameter"] / 2}, material=glass))
height = {p["hopperHeight"]}
O.bodies.append(geom.facetCylinder((0, 0, height / 2), {radius}, height, segmentsNumber=40, wallMask=4, material=glass))
O.bodies.append(wall(0, axis=2, material=glass))
{yade_engines(p)}O.run(10, True)
start = time.process_time()
O.run({steps}, True)
open("seconds", "w").write(str(time.process_time() - start))
"""


def yade_engines(p: dict[str, Any]) -> str:
    """Contacts as Hertz and Mindlin have them, gravity, and the step."""
    return f"""law = Ip2_FrictMat_FrictMat_MindlinPhys(en={p["restitution"]}, es={p["restitution"]})
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb(), Bo1_Wall_Aabb()],
                          verletDist={0.25 * p["particleDiameter"]}),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Facet_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()], [law],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -9.81)),
]
O.dt = {p["demStep"]}
"""


def write_lammps_data(hopper: Hopper, folder: Path) -> None:
    """The packing, read by LIGGGHTS, as a data file of LAMMPS."""
    p = hopper.parameters
    set_up = script(hopper, 0).split("thermo")[0]
    (folder / "in.dump").write_text(set_up + "dump particles all custom 1 particles.dump id x y z\nrun 0\n")
    subprocess.run(liggghts("dump"), cwd=folder, check=True, stdout=subprocess.DEVNULL)
    lines = (folder / "particles.dump").read_text().splitlines()
    particles = [
        line.split()
        for line in lines[lines.index(next(line for line in lines if line.startswith("ITEM: ATOMS"))) + 1 :]
    ]
    half, top = 0.51 * p["tankDiameter"], 1.02 * (p["hopperHeight"] + p["waterAboveRim"])
    (folder / "particles.data").write_text(
        f"particles\n\n{len(particles)} atoms\n1 atom types\n\n{-half} {half} xlo xhi\n{-half} {half} ylo yhi\n"
        f"{-1.02 * p['tankDepth']} {top} zlo zhi\n\nAtoms # sphere\n\n"
        + "".join(
            f"{particle[0]} 1 {p['particleDiameter']} {p['particleDensity']} {' '.join(particle[1:])}\n"
            for particle in particles
        )
    )


def lammps_script(p: dict[str, Any], steps: Any) -> str:
    law = (
        f"hertz/material {p['youngsModulus']} {p['restitution']} {p['poissonRatio']} "
        f"tangential mindlin NULL 1.0 {p['friction']} damping tsuji"
    )
    return f"""units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
read_data particles.data
neighbor {0.5 * p["particleDiameter"]} bin
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


def liggghts_script(hopper: Hopper) -> str:
    p = hopper.parameters
    set_up = script(hopper, 0).split("fix cylinder")[0].replace(f"timestep {STOCK_STEP}", f"timestep {p['demStep']}")
    return (
        set_up
        + f"""neighbor {0.5 * p["particleDiameter"]} bin
neigh_modify delay 0 every {STEPS_PER_LIST} check no binsize {1.5 * p["particleDiameter"]}
fix barrel all wall/gran model hertz tangential history primitive type 2 zcylinder {p["hopperDiameter"] / 2} 0 0
fix bottom all wall/gran model hertz tangential history primitive type 3 zplane 0
fix motion all nve/sphere
"""
    )
