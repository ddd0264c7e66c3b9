#!/usr/bin/python3
"""Makes the measurements of docs/tutorials/hopperMeasurement.md again: the solver takes the place of a hopper in a
laboratory.

The case is cases/tutorials/hopperQuick. What the page does not say before its end are FRICTION and LAG. The seeds are
not those of traceResidual."""

import argparse
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np

from clepsydra import case_files, parameter_file

CASE = Path(__file__).resolve().parents[2] / "tutorials/hopperQuick"
FRICTION = 0.16
LAG = 0.15  # [s], with which the scale follows the mass: d(shown)/dt = (mass - shown)/LAG
APPARATUS = {"particleCount": "500", "fillingDuration": "0.15", "fillingTime": "0.4"}
RECORD = 0.6  # [s], one reading every SAMPLING
SAMPLING = 5e-3
SCALE_NOISE = 1e-5  # [kg], standard deviation of every reading
SEEDS = {10: (15485863, 15485867, 15485917), 12: (32452843, 32452867, 32452883), 14: (49979687, 49979693, 49979737)}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="files that are there already are kept")
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    for orifice, seeds in SEEDS.items():
        for repeat, seed in enumerate(seeds, 1):
            target = folder / f"dry{orifice}mm_{repeat}.csv"
            if not target.exists():
                target.write_text(measured(target.with_suffix(".case"), orifice, seed))
                print(target, flush=True)


def measured(run: Path, orifice: int, seed: int) -> str:
    """A discharge in the folder `run`, which is removed afterwards, as the scale shows it: a text in CSV."""
    shutil.rmtree(run, ignore_errors=True)
    shutil.copytree(CASE, run, ignore=shutil.ignore_patterns("steps", "results", "polyMesh", "log.*"))
    entries = {"friction": str(FRICTION), "orificeDiameter": f"{orifice}e-3", "seed": str(seed), "dryTime": str(RECORD)}
    parameter_file.change(run / "parameters", {**APPARATUS, **entries, "drawParticles": "off"})
    environment = {**os.environ, "CLEPSYDRA": str(CASE.parents[2])}
    subprocess.run(
        ["./Allrun", "mesh", "filling", "dry"], cwd=run, env=environment, stdout=subprocess.DEVNULL, check=True
    )
    time, mass = case_files.columns(run / "steps/dry", "massInHopper")[:2]
    readings = np.arange(0, RECORD + SAMPLING / 2, SAMPLING)
    noise = np.random.default_rng(seed).normal(0, SCALE_NOISE, len(readings))
    shown = np.interp(readings, time, delayed(time, mass)) + noise
    shutil.rmtree(run)
    return "t_s,m_g\n" + "".join(f"{t:.3f},{1e3 * m:.3f}\n" for t, m in zip(readings, shown))


def delayed(time: np.ndarray, mass: np.ndarray) -> np.ndarray:
    """What a scale with LAG shows, if the mass is straight between two times."""
    shown = mass.copy()
    for i, step in enumerate(np.diff(time)):
        slope = (mass[i + 1] - mass[i]) / step
        shown[i + 1] = mass[i + 1] - LAG * slope + (shown[i] - mass[i] + LAG * slope) * np.exp(-step / LAG)
    return shown


main()
