"""The flow rates of the programs that the benchmark compares: dry particles from one packing through the same
hopper."""

import functools
import statistics
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import flow  # of scripts/, which .hopper puts on the path
from clepsydra import case_files, parameter_file

from . import timing
from .hopper import Hopper, forget_results, solver
from .other_programs import require, yade_engines

DUMP_EVERY = 250
# Parts of the fill; the rate is that of the whole window, its error that of the parts.
WINDOW = (0.95, 0.85, 0.75, 0.65, 0.55)
# A third of the particles, as cases/validation/besideLammps has it; otherwise the quick hopper.
QUICK = "particleCount=900 hopperDiameter=0.02 hopperHeight=0.05 tankDiameter=0.05 fillingTime=0.8 dryTime=0.5"
WHOLE = "dryTime=1.2"


@functools.cache
def runs(hopper: Hopper, repetitions: int) -> tuple[Path, dict[str, Any], dict[str, list[timing.Time]]]:
    """Folder, parameters and times of the three programs, whose last results lie in the folder."""
    require("lmp")
    require("yade")
    folder = hopper.validation_case("besideLammps")
    Hopper.in_folder(
        folder,
        (
            ". ./Allrun; rm -rf runs; caseTemplate=../../tutorials/hopperQuick; "
            f"makeRun hopper {QUICK if hopper.quick else WHOLE}; inEachRun solveInBoth"
        ),
    )
    run = folder / "runs" / "hopper"
    p = parameter_file.parameters(run / "parameters")
    (run / "hopper.py").write_text(yade_script(p))
    programs = {
        "ours": timing.Run(solver(), run, prepare=lambda: forget_results(run)),
        "LAMMPS": timing.Run(["lmp", "-in", "DEM/in.lammps", "-screen", "none", "-log", "log.lammps"], run),
        "Yade": timing.Run(["yade", "-n", "-x", "-j1", "hopper.py"], run),
    }
    return run, p, timing.interleaved(programs, repetitions)


def over_lammps_flow(hopper: Hopper, repetitions: int) -> timing.Figure:
    _, p, times = runs(hopper, repetitions)
    return timing.processor_ratio(
        times,
        "LAMMPS",
        "ours",
        ">= 1.5",
        f"processor time of LAMMPS over pimpleDemFoam's; {p['particleCount']:.0f} dry particles that leave the hopper,"
        f" first {p['dryTime']:g} s",
    )


def rates(hopper: Hopper, repetitions: int) -> timing.Figure:
    """Of one packing: its own scatter, 3.5 % from one to the next, is larger than what a repetition shows."""
    run, p, times = runs(hopper, repetitions)
    steps = round(p["dryTime"] / p["demStep"])
    found = {
        "ours": dumped(run, p, "DEM/particles.dump"),
        "LAMMPS": dumped(run, p, "DEM/lammps.dump"),
        "Yade": tuple(np.loadtxt(run / "yade.dat").T),
    }
    details = {}
    for name, (time, inside) in found.items():
        rate, error = mean_rate(time, inside, p)
        processor = statistics.median(took.processor for took in times[name])
        details[name] = {
            "gramsPerSecond": rate,
            "standardError": error,
            "processorSeconds": processor,
            "particleStepsPerSecond": p["particleCount"] * steps / processor,
        }
    return timing.Figure(
        [details["ours"]["gramsPerSecond"]],
        details=details,
        meaning=(
            f"g/s, {p['particleCount']:.0f} dry particles, while {100 * WINDOW[0]:.0f} to {100 * WINDOW[-1]:.0f} %"
            " remain; "
        )
        + ", ".join(f"{name} {of['gramsPerSecond']:.2f} +- {of['standardError']:.2f}" for name, of in details.items())
        + "; one packing, they scatter by 3.5 %",
    )


def dumped(run: Any, p: dict[str, Any], dump: Any) -> tuple[Any, Any]:
    """Times, and the particles above the orifice."""
    entries = case_files.dumped_particles(run, dump)
    return (
        np.array([step * p["demStep"] for step, _ in entries]),
        np.array([(particles[:, 3] > 0).sum() for _, particles in entries]),
    )


def mean_rate(time: np.ndarray, inside: Any, p: dict[str, Any]) -> tuple[Any, Any]:
    """While WINDOW of the fill remains, with its standard error [g/s]."""
    mass = 1e3 * inside * p["particleDensity"] * np.pi / 6 * p["particleDiameter"] ** 3
    parts = [flow.mean_rate(time, mass, *part) for part in zip(WINDOW, WINDOW[1:])]
    return flow.mean_rate(time, mass, WINDOW[0], WINDOW[-1]), np.std(np.array(parts, dtype=float), ddof=1) / np.sqrt(
        len(parts)
    )


def yade_script(p: dict[str, Any]) -> str:
    """DEM/particles.data, at rest, and the hopper's own surfaces of triangles."""
    return f"""from yade import geom, ymport
glass = O.materials.append(FrictMat(young={p["youngsModulus"]}, poisson={p["poissonRatio"]},
                                    density={p["particleDensity"]}, frictionAngle=atan({p["friction"]})))
particles = []
for line in open("DEM/particles.data").read().split("Atoms\\n\\n")[1].splitlines():
    centre = [float(x) for x in line.split()[-3:]]
    particles.append(O.bodies.append(sphere(centre, {p["particleDiameter"] / 2}, material=glass)))
for name in ("hopperWall", "hopperPlate"):
    O.bodies.append(ymport.stl(f"DEM/meshes/{{name}}.stl", material=glass))
O.bodies.append(geom.facetCylinder((0, 0, {(p["hopperHeight"] + p["waterAboveRim"] - p["tankDepth"]) / 2}),
                                   {p["tankDiameter"] / 2},
                                   {p["hopperHeight"] + p["waterAboveRim"] + p["tankDepth"]},
                                   segmentsNumber=40, wallMask=4, material=glass))
O.bodies.append(wall({-p["tankDepth"]}, axis=2, material=glass))
{yade_engines(p)}with open("yade.dat", "w") as out:
    for part in range({round(p["dryTime"] / p["demStep"] / DUMP_EVERY)} + 1):
        inside = sum(O.bodies[particle].state.pos[2] > 0 for particle in particles)
        out.write(f"{{part * {DUMP_EVERY * p['demStep']}}} {{inside}}\\n")
        O.run({DUMP_EVERY}, True)
"""
