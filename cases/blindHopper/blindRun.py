"""One measurement: a run of the real solver with something undeclared in it, weighed by a scale with noise."""

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import yaml

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "scripts"))
import caseFiles
from undeclared import BY_NAME

CASE = ROOT / "cases/hopperQuick"
NUMERICS = {"demStep": 2.5e-5, "smoothingLength": 5e-3}     # not those of the study
SCALE_NOISE = 1e-5                                          # [kg], standard deviation of every reading
SAMPLING = 5e-3                                             # [s] between readings


class RunFailed(Exception):
    pass


def conditions():
    """The declared experiment, from study.yaml: {condition: (stage, entries, repeats)}."""
    study = yaml.safe_load((HERE / "study.yaml").read_text())
    found = {}
    for condition in study["conditions"]:
        stage = condition.get("command", study["rig"]["command"]).split()[-1]
        entries = {**study["rig"]["set"], **condition["set"]}
        found[condition["name"]] = (stage, entries, len(condition["measured"]["files"]))
    return found


def acts(effect, stage):
    return effect.medium == "both" or effect.medium == {"dry": "air", "submerged": "water"}[stage]


def measure(folder, condition, friction, effects, seed, random):
    """(time [s], mass [kg]) as the scale shows it. effects: [(name, amplitude)]; random for the scale and for pauses."""
    stage, entries, _ = conditions()[condition]
    acting = [(BY_NAME[name], a) for name, a in effects if acts(BY_NAME[name], stage)]
    makeCase(folder, {**entries, **NUMERICS, "friction": friction, "seed": seed}, acting)
    allrun(folder, "mesh")
    for effect, a in acting:
        if effect.mesh:
            effect.mesh(folder, a)
    allrun(folder, "pour", stage)
    time, mass = caseFiles.columns(folder / "stages" / stage, "massInHopper")[:2]
    # a run ends early where the flow has stopped
    end = float(entries[{"dry": "dryTime", "submerged": "submergedTime"}[stage]])
    if time[-1] < end:
        time, mass = np.append(time, end), np.append(mass, mass[-1])
    for effect, a in acting:
        if effect.record:
            time, mass = effect.record(time, mass, a, random)
    readings = np.arange(0, end + SAMPLING / 2, SAMPLING)
    return readings, np.interp(readings, time, mass) + random.normal(0, SCALE_NOISE, len(readings))


def makeCase(folder, entries, acting):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for part in ("0", "constant", "system", "DEM", "parameters", *(path.name for path in CASE.glob("stage.*"))):
        copy = shutil.copytree if (CASE / part).is_dir() else shutil.copy
        copy(CASE / part, folder / part)
    for rest in (folder / "constant/polyMesh", folder / "DEM/meshes"):
        shutil.rmtree(rest, ignore_errors=True)
    (folder / "Allrun").symlink_to(CASE / "Allrun")         # which finds the repository through the link
    (folder / "summarise").symlink_to(CASE / "summarise")
    path = folder / "parameters"
    for changes in [lambda p: entries] + [lambda p, e=e, a=a: e.entries(p, a) for e, a in acting if e.entries]:
        changed = {name: text(value) for name, value in changes(caseFiles.parameters(path)).items()}
        path.write_text(caseFiles.withParameters(path.read_text(), changed))
    for effect, a in acting:
        if effect.files:
            effect.files(folder, a)


def text(value):
    return value if isinstance(value, str) else f"{value:.9g}"


def allrun(folder, *parts):
    with open(folder / "log", "a") as log:
        if subprocess.run(["./Allrun", *parts], cwd=folder, stdin=subprocess.DEVNULL, stdout=log, stderr=log).returncode:
            raise RunFailed(folder)


def writeCsv(path, time, mass):
    """Whole or not at all, with nothing in it but readings."""
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(path.name + ".unfinished")
    rows = "".join(f"{t:.3f},{1e3 * m:.3f}\n" for t, m in zip(time, mass))
    unfinished.write_text("t_s,m_g\n" + rows)
    unfinished.rename(path)
