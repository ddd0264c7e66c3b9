"""Particles at the orifice: what of their dense output is kept in results/exit.zip, and what follows from it."""

import csv
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import paper
import series
from repository import RESULTS

from clepsydra import parameter_file, parameter_study_results, particle_files, whole_files

FOLDER = RESULTS / "exit"
RUNS = f"fill100-{paper.MATCHING_FRICTION['dry']}.*"
HEIGHTS = np.linspace(-1e-3, 12e-3, 27)  # from the lower edge of the orifice's land
STEADY = (0.4, 3.0)  # s after opening: particles further up move, and the hopper is more than half full
PICTURE_AT = 1.0  # s: of the picture
BLOCKS = 8  # of consecutive times, for the standard error
SLAB_COLUMNS = ("x [m]", "y [m]", "z [m]", "u [m/s]", "v [m/s]", "w [m/s]", "radius [m]")


def keep(folder: Path) -> None:
    """Writes <run>.slab.csv (particles cut by the mid-plane at one time) and <run>.profile.csv (shares at all
    times)."""
    step = folder.name.rsplit(".", 1)[1]
    case = folder / "steps" / step
    radius = parameter_file.parameters(folder / "parameters")["orificeDiameter"] / 2
    times = particle_files.written_times(case)
    FOLDER.mkdir(parents=True, exist_ok=True)
    with whole_files.replacing(FOLDER / f"{folder.name}.profile.csv") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["time [s]", "height [m]", "solid fraction [-]", "downward solid flux [m/s]"])
        for time, drawn in sorted(times.items()):
            if STEADY[0] <= time <= STEADY[1]:
                for row in zip(HEIGHTS, *cross_sections(*particle_files.read_particles(drawn), radius)):
                    table.writerow([f"{time:.6g}", *(f"{value:.5g}" for value in row)])
    position, size, velocity = particle_files.read_particles(times[min(times, key=lambda time: abs(time - PICTURE_AT))])
    cut = np.abs(position[:, 1]) < size
    with whole_files.replacing(FOLDER / f"{folder.name}.slab.csv") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(SLAB_COLUMNS)
        for row in np.column_stack([position, velocity, size])[cut]:
            table.writerow([f"{value:.5g}" for value in row])


def cross_sections(position: np.ndarray, size: Any, velocity: np.ndarray, radius: Any) -> tuple[Any, Any]:
    """Of the circle above and below the orifice, at each height: share inside particles, and share times their speed
    down."""
    distance = np.hypot(position[:, 0], position[:, 1])
    shares, fluxes = [], []
    for height in HEIGHTS:
        section = size**2 - (position[:, 2] - height) ** 2
        cut = (section > 0) & (distance < radius + size)
        area = overlap(np.sqrt(section[cut]), radius, distance[cut]) / (pi * radius**2)
        shares.append(area.sum())
        fluxes.append((area * -velocity[cut, 2]).sum())
    return shares, fluxes


def overlap(a: Any, b: Any, distance: Any) -> Any:
    """Area that circles of radius a have in common with one of radius b."""
    small = np.minimum(a, b)
    inside = distance <= np.abs(a - b)
    apart = distance >= a + b
    d = np.where(inside | apart, a + b, distance)  # harmless values where the formula does not hold
    alpha = np.arccos(np.clip((d**2 + a**2 - b**2) / (2 * d * a), -1, 1))
    beta = np.arccos(np.clip((d**2 + b**2 - a**2) / (2 * d * b), -1, 1))
    lens = a**2 * (alpha - np.sin(2 * alpha) / 2) + b**2 * (beta - np.sin(2 * beta) / 2)
    return np.where(inside, pi * small**2, np.where(apart, 0, lens))


@dataclass(frozen=True)
class Profile:
    height: np.ndarray
    share: np.ndarray  # a row per time
    flux: np.ndarray

    @staticmethod
    def mean(values: Any) -> tuple[Any, Any]:
        """Over times, with its standard error from the scatter of blocks of consecutive times."""
        blocks = np.array([block.mean(axis=0) for block in np.array_split(values, BLOCKS)])
        return blocks.mean(axis=0), blocks.std(axis=0, ddof=1) / np.sqrt(BLOCKS)

    def share_at(self, height: Any) -> Any:
        at = np.argmin(np.abs(self.height - height))
        mean, error = self.mean(self.share)
        return series.Value(float(mean[at]), float(error[at]))


def run_of(step: Any) -> str:
    """The name of the run that the particles at the exit are from."""
    return kept(step, "profile").name.removesuffix(".profile.csv")


def kept(step: Any, kind: Any) -> Any:
    """The file of the first run, in the archive or, if it has just been written, in the folder beside it."""
    for path in parameter_study_results.files(FOLDER, f".{step}.{kind}.csv").values():
        return path
    raise series.MissingRuns(
        f"no particles at the exit, {step}: entry fill100, then scripts/reproduce/figure1.py --from WORK"
    )


def read(step: Any, kind: Any) -> Any:
    rows = list(csv.reader(kept(step, kind).read_text().splitlines()))[1:]
    return np.array([[float(value) for value in row] for row in rows])


def profile(step: Any) -> Any:
    rows = read(step, "profile")
    shape = (-1, len(HEIGHTS))
    return Profile(HEIGHTS, rows[:, 2].reshape(shape), rows[:, 3].reshape(shape))


def slab(step: Any) -> tuple[Any, Any, Any]:
    """Positions, velocities, radii of the particles that the mid-plane cuts."""
    rows = read(step, "slab")
    return rows[:, :3], rows[:, 3:6], rows[:, 6]


def keep_all(work: Any) -> None:
    """Of the parameter study's work folder the runs whose particles were written often."""
    for step in paper.STEPS:
        for folder in sorted(Path(work).glob(f"runs/{RUNS}.{step}")):
            keep(folder)
    parameter_study_results.archive(FOLDER)
