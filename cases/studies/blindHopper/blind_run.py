"""One measurement: a run of the real solver with something undeclared in it, weighed by a scale with noise."""

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from undeclared import BY_NAME

from clepsydra import case_files, parameter_file

HERE = Path(__file__).resolve().parent
ROOT = next(folder for folder in HERE.parents if (folder / "scripts/environment").exists())

CASE = (HERE / yaml.safe_load((HERE / "study.yaml").read_text())["simulator"]["case"]).resolve()
NUMERICS = {"demStep": 2.5e-5, "smoothingBandwidth": 5e-3}  # not those of the study
SCALE_NOISE = 1e-5  # [kg], standard deviation of every reading
SAMPLING = 5e-3  # [s] between readings
ATTEMPTS = 3  # of each measurement, with seeds of their own
CANDIDATE_REPEATS = 8


class RunFailed(Exception):
    pass


def conditions(*roles: Any) -> Any:
    """The declared experiment, from study.yaml: {condition: (step, entries, repeats)}; of these roles or all."""
    return experiments("study.yaml", lambda one: len(one["measured"]["files"]), roles)


def candidates() -> Any:
    """The same of what could be measured beside it, from candidates.yaml."""
    return experiments("candidates.yaml", lambda one: CANDIDATE_REPEATS)


def experiments(file: str, repeats_of: Any, roles: Any = ()) -> dict[Any, Any]:
    simulator = yaml.safe_load((HERE / "study.yaml").read_text())["simulator"]
    return {
        one["name"]: (
            one.get("command", simulator["command"]).split()[-1],
            {**simulator["set"], **one["set"]},
            repeats_of(one),
        )
        for one in yaml.safe_load((HERE / file).read_text())["conditions"]
        if not roles or one["role"] in roles
    }


def acts(effect: Any, step: Any) -> bool:
    return effect.medium == "both" or effect.medium == {"dry": "air", "submerged": "water"}[step]


def measure_to(target: Any, folder: Path, truth: Any, label: str, run: Any) -> bool:
    """One file of a set; run: CONDITION_REPEAT. False where all attempts have failed."""
    effects = [(e["name"], e["amplitude"]) for e in truth["effects"]]
    for attempt, seed in enumerate(truth["seeds"][run]):
        random = np.random.default_rng([truth["noise"], seed])
        try:
            time, mass = measure(
                folder, run.rsplit("_", 1)[0], truth["friction"], effects, seed, random, truth.get("numerics", NUMERICS)
            )
        except RunFailed:
            print(f"{label}: attempt {attempt + 1} failed", flush=True)
            continue
        write_csv(target, time, mass)
        shutil.rmtree(folder)
        print(label, flush=True)
        return True
    return False


def measure_missing(truth: Any, data: Any, work: Any, label: str = "") -> None:
    """All files of a set that are not there. SystemExit where one has failed in all attempts."""
    for run in truth["seeds"]:
        if not (data / f"{run}.csv").exists() and not measure_to(
            data / f"{run}.csv", work / run, truth, label + run, run
        ):
            sys.exit(f"{label}{run} has failed {ATTEMPTS} times")


def seeds_of(conditions: Any, random: Any) -> dict[str, Any]:
    """{CONDITION_REPEAT: seeds of its attempts}; random: of the standard library"""
    return {
        f"{condition}_{repeat}": [prime(random) for _ in range(ATTEMPTS)]
        for condition, (_, _, repeats) in conditions.items()
        for repeat in range(1, repeats + 1)
    }


def prime(random: Any) -> Any:
    """LIGGGHTS asks for primes above 10000 as seeds."""
    number = random.randrange(10007, 10**8) | 1
    while any(number % divisor == 0 for divisor in range(3, int(number**0.5) + 1, 2)):
        number += 2
    return number


def measure(
    folder: Path, condition: Any, friction: float, effects: Any, seed: Any, random: Any, numerics: Any = NUMERICS
) -> tuple[Any, Any]:
    """(time [s], mass [kg]) as the scale shows it. effects: [(name, amplitude)]; random for the scale and for
    pauses."""
    step, entries, _ = (conditions() | candidates())[condition]
    acting = [(BY_NAME[name], a) for name, a in effects if acts(BY_NAME[name], step)]
    make_case(folder, {**entries, **numerics, "friction": friction, "seed": seed}, acting)
    allrun(folder, "mesh")
    for effect, a in acting:
        if effect.mesh:
            effect.mesh(folder, a)
    allrun(folder, "filling", step)
    time, mass = case_files.columns(folder / "steps" / step, "massInHopper")[:2]
    # a run ends early where the flow has stopped
    end = float(entries[{"dry": "dryTime", "submerged": "submergedTime"}[step]])
    if time[-1] < end:
        time, mass = np.append(time, end), np.append(mass, mass[-1])
    for effect, a in acting:
        if effect.record:
            time, mass = effect.record(time, mass, a, random)
    readings = np.arange(0, end + SAMPLING / 2, SAMPLING)
    return readings, np.interp(readings, time, mass) + random.normal(0, SCALE_NOISE, len(readings))


def make_case(folder: Path, entries: Any, acting: Any) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    steps = [path.name for path in CASE.glob("step.*")]
    for part in ("0", "constant", "system", "DEM", "parameters", "parameters.rules", "template.yaml", *steps):
        if (CASE / part).is_dir():
            shutil.copytree(CASE / part, folder / part)
        else:
            shutil.copy(CASE / part, folder / part)
    for rest in (folder / "constant/polyMesh", folder / "DEM/meshes"):
        shutil.rmtree(rest, ignore_errors=True)
    (folder / "Allrun").symlink_to(CASE / "Allrun")  # which finds the repository through the link
    (folder / "summarise").symlink_to(CASE / "summarise")
    path = folder / "parameters"
    for changes in [lambda p: entries] + [lambda p, e=e, a=a: e.entries(p, a) for e, a in acting if e.entries]:
        changed = {name: text(value) for name, value in changes(parameter_file.parameters(path)).items()}
        path.write_text(parameter_file.with_parameters(path.read_text(), changed))
    for effect, a in acting:
        if effect.files:
            effect.files(folder, a)


def text(value: Any) -> Any:
    return value if isinstance(value, str) else f"{value:.9g}"


def allrun(folder: Path, *parts: Any) -> None:
    with open(folder / "log", "a") as log:
        if subprocess.run(
            ["./Allrun", *parts], cwd=folder, stdin=subprocess.DEVNULL, stdout=log, stderr=log
        ).returncode:
            raise RunFailed(folder)


def write_csv(path: Path, time: np.ndarray, mass: np.ndarray) -> None:
    """Whole or not at all, with nothing in it but readings."""
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(path.name + ".unfinished")
    rows = "".join(f"{t:.3f},{1e3 * m:.3f}\n" for t, m in zip(time, mass))
    unfinished.write_text("t_s,m_g\n" + rows)
    unfinished.rename(path)
