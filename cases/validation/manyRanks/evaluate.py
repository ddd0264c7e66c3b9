#!/usr/bin/python3
"""Compares each run on many ranks with the one on a single rank: every particle, and the cells' solid volume."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, parameter_file, validation

# What the solvers' residuals and the order of sums become through the first contacts, in parts of what is compared
OF_CONTACTS = 1e-6
# The cells' and the particles' volume are the same but for the twelve digits of the files
OF_DIGITS = 1e-10


def main() -> None:
    one = Path("runs/one")
    runs = sorted(run for run in Path("runs").iterdir() if run != one)
    between = [particles_on_three_ranks(run) for run in runs]
    if not any(between):
        raise SystemExit("no particle visits three ranks, so the runs show nothing")
    for run, count in zip(runs, between):
        print(f"{run.name}: {count} particles on three ranks or more")
    validation.write([row for run in runs for row in rows(run, one)])


def rows(run: Any, one: Any) -> list[Any]:
    p = parameter_file.parameters(run / "parameters")
    here, there = particles(run), particles(one)
    apart = np.linalg.norm(here[-1] - there[-1], axis=1)
    worst = apart.argmax()
    fallen = [positions[0][worst, 2] - positions[-1][worst, 2] for positions in (here, there)]
    cells = cell_volumes(p)
    solid, solid_on_one = (
        1 - case_files.field(case, case_files.times(case)[-1], "voidFraction")[:, 0] for case in (run, one)
    )
    volume = solid.sum() * cells
    print(
        f"{run.name}: apart from one rank by at most {apart.max() / p['particleDiameter']:.1e} d; "
        f"solid volume {volume / particle_volume(p) - 1:+.1e}"
    )

    def row(quantity: str, unit: str, reference: Any, source: Any, ours: Any, tolerance: float) -> Any:
        return validation.row(
            f"{quantity}, {run.name}",
            unit,
            reference,
            source,
            "computed",
            ours,
            abs(reference) * tolerance,
            100 * tolerance,
        )

    return [
        row("way of the particle that differs most", "m", fallen[1], "the same on one rank", fallen[0], OF_CONTACTS),
        row(
            "void fraction, mean over the solid",
            "-",
            1 - (solid_on_one**2).sum() / solid_on_one.sum(),
            "the same on one rank",
            1 - (solid**2).sum() / solid.sum(),
            OF_CONTACTS,
        ),
        row("solid volume in the cells", "m3", particle_volume(p), "the particles' own", volume, OF_DIGITS),
    ]


def particles(run: Any) -> list[Any]:
    """Positions by time, particles by their numbers."""
    return [entry[:, 1:4] for _, entry in case_files.dumped_particles(run)]


def particle_volume(p: dict[str, Any]) -> Any:
    return p["particleCount"] * np.pi / 6 * p["particleDiameter"] ** 3


def cell_volumes(p: dict[str, Any]) -> Any:
    return p["width"] ** 2 * p["height"] / (p["cellsAcross"] ** 2 * p["cellsUp"])


def particles_on_three_ranks(run: Any) -> int:
    """How many particles touch cells of three ranks or more at one of the times."""
    p = parameter_file.parameters(run / "parameters")
    across, up = int(p["cellsAcross"]), int(p["cellsUp"])
    rank_of = case_files.field(run, "0", "cellDist")[:, 0]
    index = np.array([(i, j, k) for k in range(up) for j in range(across) for i in range(across)])
    size = np.array([p["width"] / across, p["width"] / across, p["height"] / up])
    low = index * size
    found = set()
    for centres in particles(run):
        for particle, centre in enumerate(centres):
            nearest = np.clip(centre, low, low + size)
            touched = np.linalg.norm(nearest - centre, axis=1) < 0.999 * p["particleDiameter"] / 2
            if len(set(rank_of[touched])) >= 3:
                found.add(particle)
    return len(found)


if __name__ == "__main__":
    main()
