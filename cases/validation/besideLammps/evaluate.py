#!/usr/bin/python3
"""Puts the particles of LIGGGHTS and of LAMMPS side by side: places while they can be compared, then the flow."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, flow, parameter_file, validation
from clepsydra.picture_style import pyplot

SOURCE = "LAMMPS 29 Sep 2021"
WINDOW = (0.95, 0.55)  # of the fill
PACKING_SCATTER = 0.035  # of the rate, from one packing to the next (README)
# Steps in the box, after the first contacts and before chaos, and what may differ [%]
COMPARED = {"boxFrictionless": (2500, 1e-4), "box": (1500, 0.1)}


class Pair:
    """One run in both codes: steps and places (step, particle, axis) of each."""

    def __init__(self, run: Any) -> None:
        self.run = run
        self.parameters = parameter_file.parameters(run / "parameters")
        self.step, self.ours = places(run, "DEM/particles.dump")
        their_steps, self.theirs = places(run, "DEM/lammps.dump")
        if list(self.step) != list(their_steps):
            raise SystemExit(f"{run}: the two dumps have other steps")

    def apart(self) -> Any:
        """Distance between a particle's two places in diameters: (step, particle)."""
        return np.linalg.norm(self.ours - self.theirs, axis=2) / self.parameters["particleDiameter"]

    def time(self) -> Any:
        return self.step * self.parameters["demStep"]

    def cpu_seconds(self) -> list[float]:
        return [float((self.run / f"cpuSeconds.{program}").read_text()) for program in ("pimpleDemFoam", "lmp")]


def places(run: Any, dump: Any) -> tuple[Any, Any]:
    entries = case_files.dumped_particles(run, dump)
    return np.array([step for step, _ in entries]), np.array([particles[:, 1:4] for _, particles in entries])


def box_row(pair: Any) -> Any:
    step, tolerance = COMPARED[pair.run.name]
    at = list(pair.step).index(step)

    def moved(found: Any) -> Any:
        return np.sqrt(((found[at] - found[0]) ** 2).sum(axis=1).mean())

    apart = pair.apart()
    print(
        f"{pair.run.name}: largest distance between the codes [d] after "
        + ", ".join(f"{pair.step[i]} steps {apart[i].max():.1e}" for i in range(2, len(apart), 4))
    )
    return validation.row(
        f"rms path after {step} steps, {pair.run.name}",
        "m",
        moved(pair.theirs),
        SOURCE,
        "otherCode",
        moved(pair.ours),
        apart[at].max() * pair.parameters["particleDiameter"],
        tolerance,
    )


def particles_left(found: Any) -> Any:
    return (found[:, :, 2] > 0).sum(axis=1)


def rate(pair: Any, found: Any) -> Any:
    """Particles per second while WINDOW of the fill remains."""
    return flow.mean_rate(pair.time(), particles_left(found).astype(float), *WINDOW)


def hopper_rows(pairs: Any) -> list[Any]:
    ours, theirs = (np.array([rate(pair, getattr(pair, name)) for pair in pairs]) for name in ("ours", "theirs"))
    differences = ours - theirs
    error = (
        differences.std(ddof=1) / np.sqrt(len(pairs))
        if len(pairs) > 1
        else np.sqrt(2) * PACKING_SCATTER * theirs.mean()
    )
    for pair, a, b in zip(pairs, ours, theirs):
        print(
            f"{pair.run.name}: {a:.0f} particles/s, LAMMPS {b:.0f}; left at the end {particles_left(pair.ours)[-1]},"
            f" LAMMPS {particles_left(pair.theirs)[-1]}; core-seconds {pair.cpu_seconds()[0]}, LAMMPS"
            f" {pair.cpu_seconds()[1]}"
        )
    title = f"{len(pairs)} packing" + ("s" if len(pairs) > 1 else "")
    # a sum of two packings' scatter: the paths part after some 1000 steps. Three standard errors of that are allowed,
    # so
    # that one run in 400 is refused for its scatter alone
    allowed = 300 * PACKING_SCATTER * np.sqrt(2 / len(pairs))
    return [validation.row(f"rate, {title}", "1/s", theirs.mean(), SOURCE, "otherCode", ours.mean(), error, allowed)]


def plot(boxes: Any, hoppers: Any) -> None:
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4.5))
    for pair in boxes:
        left.semilogy(pair.step, pair.apart().max(axis=1) + 1e-17, label=pair.run.name)
    left.set_xlabel("DEM steps")
    left.set_ylabel("largest distance of a particle between the codes [d]")
    left.legend()
    for index, pair in enumerate(hoppers):
        right.plot(pair.time(), particles_left(pair.ours), f"C{index}-", label=f"{pair.run.name}, LIGGGHTS")
        right.plot(pair.time(), particles_left(pair.theirs), f"C{index}--", label="LAMMPS")
    right.set_xlabel("time [s]")
    right.set_ylabel("particles in the hopper")
    right.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig("results/besideLammps.png", dpi=120)


pairs = [Pair(run) for run in sorted(Path("runs").iterdir())]
boxes = [pair for pair in pairs if pair.run.name in COMPARED]
small = [pair for pair in pairs if pair.run.name[len("hopper") :].isdigit()]
whole = [pair for pair in pairs if pair.run.name == "hopperWhole"]
rows = [box_row(pair) for pair in boxes] + hopper_rows(small)
if whole:
    rows += [found | {"quantity": "rate, the whole quick hopper"} for found in hopper_rows(whole)]
validation.write(rows)
plot(boxes, small + whole)
