"""The hopper of cases/tutorials/hopperQuick, dry and submerged."""

import json
import math
import os
import subprocess
from pathlib import Path

from clepsydra import environment
from clepsydra import seeds
from rules import Rule, length, number, oneOf, whole

REPOSITORY = Path(__file__).resolve().parents[2]
MESHERS = ("hopperInTank", "hopperBySnappy", "hopperFromSurface")
SWITCH = oneOf("on", "off")
GRAVITY = 9.81                          # m/s2
RAYLEIGH_FRACTION = 0.4                 # of the DEM step, at most: as pimpleDemFoam has it
DENSEST_PACKING = 0.74
FASTEST_IN_CELLS = 10                   # cells that a falling particle may pass in a coupling step; from 2 on a warning
RANKS_PER_CORE = 4                      # more ranks than cores are slow, but may be wanted for a test
# scripts/developers/benchmarks/README.md
BYTES_PER_PARTICLE, BYTES_PER_CELL, BYTES_OF_PROGRAM = 2700, 2590, 87e6


def isSeed(value):
    """Those from 10007 on are the particle templates'."""
    return isinstance(value, float) and value.is_integer() and 11000 < value < 2**31 and seeds.is_seed(int(value))


RULES = {
    "particleDiameter": length(1e-5, 0.1), "particleDensity": number(10, 3e4, "kg/m3"), "particleCount": whole(1, 10**9),
    "youngsModulus": number(1e5, 1e12, "Pa"), "poissonRatio": number(0, 0.5), "restitution": number(0.05, 1),
    "friction": number(0, 10), "frictionWall": number(0, 10), "frictionBottom": number(0, 10),
    "rollingFriction": number(0, 10), "cohesionEnergyDensity": number(0, 1e9, "J/m3"), "diameterDeviation": number(0, 0.4),
    "addedMassCoefficient": number(0, 5), "lift": SWITCH, "lubrication": SWITCH, "roughness": length(1e-12, 1e-2),
    "seed": Rule("a prime from 11003 to 2147483647", isSeed),
    "fluidDensity": number(0.1, 3e4, "kg/m3"), "fluidViscosity": number(1e-9, 10, "m2/s"),
    "dragLaw": Rule("a word", lambda value: isinstance(value, str)), "dragFactor": number(0, 100),
    "hopperDiameter": length(1e-4, 10), "orificeDiameter": length(1e-4, 10), "hopperHeight": length(1e-4, 10),
    "tankDiameter": length(1e-4, 10), "tankDepth": length(1e-4, 10), "waterAboveRim": length(1e-5, 10),
    "landHeight": length(0, 1), "bevelHeight": length(0, 1), "wallThickness": length(0, 1), "lid": SWITCH,
    "mesher": oneOf(*MESHERS), "meshLevel": oneOf("quick", "coarse", "medium", "paper"), "cellSize": length(1e-5, 1),
    "demStep": number(1e-12, 1e-2, "s"), "couplingTimeStep": number(1e-9, 1, "s"), "smoothingBandwidth": length(1e-5, 10),
    "selfInducedVelocityCorrection": oneOf("off", "Oseen"), "dilation": SWITCH, "dilationTime": number(0, 10, "s"),
    "pressureTolerance": number(1e-16, 1), "velocityTolerance": number(1e-16, 1), "outerCorrectors": whole(1, 100),
    "pressureCorrectors": whole(1, 100), "nonOrthogonalCorrectors": whole(0, 100),
    "hopperLeftBelow": length(-10, 0), "heapBelow": length(-10, 0), "heapSpeed": number(0, 100, "m/s"),
    "heapRestTime": number(0, 100, "s"), "fillingDuration": number(1e-6, 1e5, "s"), "fillingTime": number(1e-6, 1e5, "s"),
    "dryTime": number(1e-6, 1e5, "s"), "submergedTime": number(1e-6, 1e5, "s"), "fieldInterval": number(1e-9, 1e5, "s"),
    "drawParticles": SWITCH, "ranks": whole(1, 10**6),
}


def findings(text, p, ranks, part, found):
    """Adds to `found`. p: the entries of the text, each of them as RULES says. Mesh and filling may be shared by runs that
    differ otherwise: of them only what concerns them is looked at."""
    if part != "mesh":
        checkParticles(p, found)
        checkDemStep(p, found)
    if part not in ("mesh", "filling"):
        checkResolution(p, found)
        checkDragLaw(p, found)
    checkMachine(p, cells(text, p, found), ranks, found)


def checkParticles(p, found):
    particle, orifice, hopper, height = p["particleDiameter"], p["orificeDiameter"], p["hopperDiameter"], p["hopperHeight"]
    largest = particle * (1 + 2 * p["diameterDeviation"])
    if not orifice < hopper < p["tankDiameter"]:
        found.problems.append(f"orificeDiameter {orifice:g} m, hopperDiameter {hopper:g} m and tankDiameter "
                              f"{p['tankDiameter']:g} m; allowed: each smaller than the next")
    if largest >= orifice:
        found.problems.append(f"the largest particles ({largest:g} m) cannot pass orificeDiameter {orifice:g} m; "
                              "allowed: an orifice wider than a particle")
    elif orifice < 4 * particle:
        found.warnings.append(f"orificeDiameter is {orifice / particle:.1f} particle diameters: below some 4 it is likely to clog")
    if height <= 4 * particle:
        found.problems.append(f"hopperHeight {height:g} m is not even four particles; allowed: a hopper higher than its fill")
    solid = p["particleCount"] * math.pi / 6 * particle**3
    fill = solid / (math.pi / 4 * hopper**2)
    if fill / DENSEST_PACKING > height:
        found.problems.append(f"particleCount {p['particleCount']:.0f} particles lie at least {fill / DENSEST_PACKING:.3g} m high, hopperHeight "
                              f"is {height:g} m; allowed: particles that fit")
    found.facts.append(f"particles: {p['particleCount']:.0f} of {1e3 * particle:g} mm, {1e3 * solid * p['particleDensity']:.3g} g, some "
                       f"{1e3 * fill / 0.6:.3g} mm high in a hopper of {1e3 * height:g} mm; orifice {orifice / particle:.3g} particles wide")


def checkDemStep(p, found):
    step, interval = p["demStep"], p["couplingTimeStep"]
    shear = 0.5 * p["youngsModulus"] / (1 + p["poissonRatio"])
    smallest = p["particleDiameter"] * (1 - 2 * p["diameterDeviation"])
    rayleigh = math.pi * smallest / 2 * math.sqrt(p["particleDensity"] / shear) / (0.1631 * p["poissonRatio"] + 0.8766)
    if step > RAYLEIGH_FRACTION * rayleigh:
        found.problems.append(f"demStep {step:g} s is {step / rayleigh:.2f} of the Rayleigh time of the smallest particles; allowed: at "
                              f"most {RAYLEIGH_FRACTION:g} of it, {RAYLEIGH_FRACTION * rayleigh:.3g} s")
    steps = interval / step
    if round(steps) < 1 or abs(steps - round(steps)) > 1e-6 * steps:
        found.problems.append(f"couplingTimeStep {interval:g} s is {steps:.6g} demSteps of {step:g} s; allowed: a whole number of them")
    if p["fillingDuration"] > p["fillingTime"]:
        found.problems.append(f"fillingDuration {p['fillingDuration']:g} s; allowed: at most fillingTime {p['fillingTime']:g} s")
    if p["fieldInterval"] < interval:
        found.problems.append(f"fieldInterval {p['fieldInterval']:g} s; allowed: at least couplingTimeStep {interval:g} s")
    found.facts.append(f"DEM step: {step / rayleigh:.2f} of the Rayleigh time, of which {RAYLEIGH_FRACTION:g} are allowed; "
                       f"{steps:.0f} in a coupling step")


def checkResolution(p, found):
    particle, orifice, hopper, interval = p["particleDiameter"], p["orificeDiameter"], p["hopperDiameter"], p["couplingTimeStep"]
    if not p["cellSize"] < hopper:
        found.problems.append(f"cellSize {p['cellSize']:g} m; allowed: smaller than hopperDiameter {hopper:g} m")
    elif p["cellSize"] > 0.5 * orifice and p["mesher"] == "hopperInTank":
        found.warnings.append(f"cellSize {p['cellSize']:g} m is more than half of the orifice, {orifice:g} m")
    if p["smoothingBandwidth"] > hopper:
        found.problems.append(f"smoothingBandwidth {p['smoothingBandwidth']:g} m; allowed: at most hopperDiameter {hopper:g} m, over "
                              "which nothing is left to resolve")
    elif not 2 <= p["smoothingBandwidth"] / particle * (1 + 1e-9) <= 6:
        found.warnings.append(f"smoothingBandwidth is {p['smoothingBandwidth'] / particle:.2g} particle diameters; 2 to 4 have been tried "
                              "(cases/validation/README.md, independence)")
    if p["mesher"] == "hopperInTank" and p["smoothingBandwidth"] < p["cellSize"]:
        found.warnings.append(f"smoothingBandwidth {p['smoothingBandwidth']:g} m is less than a cell, {p['cellSize']:g} m: it does nothing")
    if p["heapBelow"] > p["hopperLeftBelow"]:
        found.warnings.append("heapBelow is above hopperLeftBelow: particles may be held before they have left the hopper")
    if p["mesher"] == "hopperInTank":
        passed = math.sqrt(2 * GRAVITY * p["hopperHeight"]) * interval / p["cellSize"]
        if passed > FASTEST_IN_CELLS:
            found.problems.append(f"couplingTimeStep {interval:g} s: a particle that falls from the rim passes {passed:.3g} cells in it; "
                                  f"allowed: {FASTEST_IN_CELLS}, that is {interval * FASTEST_IN_CELLS / passed:.2g} s")
        elif passed > 2:
            found.warnings.append(f"couplingTimeStep {interval:g} s: a particle that falls from the rim passes {passed:.2g} cells in it")


def checkDragLaw(p, found):
    """The known laws are the program's own."""
    try:
        asked = subprocess.run([environment.program("closures"), "terminalVelocity", *(f"--{name}={p[name]}" for name in (
            "dragLaw", "particleDiameter", "particleDensity", "fluidDensity", "fluidViscosity"))], capture_output=True, text=True)
    except OSError:
        return          # not built yet: the program itself will say
    if asked.returncode != 0 and "not in {" in asked.stderr + asked.stdout:
        known = (asked.stderr + asked.stdout).split("{")[1].split("}")[0]
        found.problems.append(f"entry 'dragLaw' is {p['dragLaw']}; allowed: {known.replace(',', ', ')}")
    elif asked.returncode == 0:
        found.facts.append(f"an isolated particle falls at {float(asked.stdout):.3g} m/s")


def cells(text, p, found):
    """About how many the mesh will have: its generator knows. A problem where it refuses the dimensions."""
    asked = subprocess.run([REPOSITORY / "meshes" / p["mesher"], "--cells", "/dev/stdin"], input=text, capture_output=True,
                           text=True)
    if asked.returncode != 0:
        found.problems.append(asked.stderr.strip().replace("/dev/stdin: ", ""))
        return 0
    return float(asked.stdout)


def checkMachine(p, cells, ranks, found):
    needed = BYTES_OF_PROGRAM + cells * BYTES_PER_CELL + p["particleCount"] * BYTES_PER_PARTICLE
    if ranks is not None:
        checkHere(p, cells, ranks, needed, found)
    found.facts.append(f"mesh: some {cells:.3g} cells ({p['mesher']}); memory: some {needed / 1e6:.3g} MB")
    for step, of in (("dry", 0), ("submerged", cells)):
        found.facts.append(f"{step}: at most some {seconds(p, of, p[step + 'Time']):.2g} s of computing on one core")


def checkHere(p, cells, ranks, needed, found):
    cores = len(os.sched_getaffinity(0))
    most = max(cores * RANKS_PER_CORE, int(os.environ.get("SLURM_NTASKS", 1)))
    if ranks > most:
        found.problems.append(f"{ranks} ranks; allowed: 1 to {most} ({cores} cores here)")
    elif ranks > max(cores, int(os.environ.get("SLURM_NTASKS", 1))):
        found.warnings.append(f"{ranks} ranks on {cores} cores are slower than {cores}")
    here = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    if needed > here:
        found.problems.append(f"the mesh would have some {cells:.3g} cells, which need {needed / 1e9:.3g} GB with "
                              f"{p['particleCount']:.3g} particles; allowed: what fits into the {here / 1e9:.3g} GB of this machine. "
                              "Are all lengths in metres?")


def seconds(p, cells, simulated):
    """By the speeds of another machine, scripts/clepsydra/costModel.json: a run that has begun knows its own."""
    costs = json.loads((REPOSITORY / "scripts" / "clepsydra" / "costModel.json").read_text())
    perInterval = costs["perParticle"] * p["particleCount"] + costs["perCell"] * cells + costs["perCell43"] * cells**(4 / 3)
    return simulated * (costs["perParticleStep"] * p["particleCount"] / p["demStep"] + perInterval * (cells > 0) / p["couplingTimeStep"])
