#!/usr/bin/python3
"""Compares how water and particles come to rest with exact solutions, and with the linear analysis in
coupling/interval/semiImplicitSource.h."""

from math import exp, expm1, log2
from pathlib import Path
from typing import Any

import numpy as np
from layer import SPEED, Layer

from clepsydra import case_files, validation
from clepsydra.picture_style import pyplot

# The smoothing's cut at 1e-5, of a wave of which it leaves nine tenths
ANALYSIS_PERCENT = 0.1
# What remains of first order at a drag time of .01
FIRST_ORDER_PERCENT = 1.5
ORDER_PERCENT = 10
# The solver of U, and the files' twelve digits
SOLVER_PERCENT = 1e-6
# The particles' own steps, hundreds in an interval
DEM_STEP_PERCENT = 1


def main() -> None:
    runs = {path.name: Run(path) for path in Path("runs").iterdir()}
    waves = sorted(
        (run for name, run in runs.items() if run.start == "wave" and not run.of_order), key=lambda run: run.drag_time
    )
    vortices = sorted((run for run in runs.values() if run.start == "vortex"), key=lambda run: run.drag_time)
    found = [of_wave(run) for run in waves] + [of_weak_drag(waves[0])]
    found += [of_energy(run) for run in waves + vortices]
    for start, exact in (("wave", wave_left), ("uniform", slip_left)):
        found.append(
            of_order(
                start,
                sorted(
                    (run for run in runs.values() if run.of_order and run.start == start),
                    key=lambda run: -run.drag_time,
                ),
                exact,
            )
        )
    found += of_free_particles(runs["uniform-free-1"])
    validation.write(found)
    plot(waves, vortices)


class Run:
    def __init__(self, path: Path) -> None:
        self.path = path
        self.start, self.motion, drag_time, *rest = path.name.split("-")
        self.drag_time = float(drag_time)
        self.of_order = bool(rest)
        self.layer = Layer(path)

    def speed(self) -> Any:
        """Of the water in the first cell, of what it had at first, after each interval."""
        lines = (
            (self.path / "postProcessing/firstCell/0/U").read_text().replace("(", " ").replace(")", " ").splitlines()
        )
        first = self.layer.velocity(self.start)[0, 2]
        return np.array([float(line.split()[3]) for line in lines if not line.startswith("#")]) / first

    def energy(self) -> Any:
        """After each interval, of what it was at first."""
        lines = (self.path / "postProcessing/energy/0/volFieldValue.dat").read_text().splitlines()
        first = (self.layer.velocity(self.start) ** 2).sum(axis=1).mean()
        return np.array([float(line.split()[1]) for line in lines if not line.startswith("#")]) / first

    def particle_speed(self) -> Any:
        """Upwards, mean over the particles, of what the water had at first, after each interval."""
        return (
            np.array([particles[:, 6].mean() for _, particles in case_files.dumped_particles(self.path)][1:])
            / SPEED[self.start]
        )

    def slip(self) -> Any:
        return self.speed() - self.particle_speed()


def computed(quantity: str, unit: str, reference: Any, source: Any, ours: Any, tolerance: float) -> Any:
    return validation.row(
        quantity, unit, reference, source, "computed", ours, abs(reference) * tolerance / 100, tolerance
    )


def of_wave(run: Any) -> Any:
    left, k = run.layer.left_by_smoothing(), run.drag_time
    speed = run.speed()
    ratio = (speed[4] / speed[0]) ** (1 / 4)
    print(f"{run.path.name}: falls by {ratio:.6f} per interval, smoothing leaves {left:.4f}")
    return computed(
        f"wave between fixed particles, one interval after the other, k = {k:g}",
        "-",
        (1 + (1 - left) * k) / (1 + k),
        "linear analysis",
        ratio,
        ANALYSIS_PERCENT,
    )


def wave_left(run: Any) -> tuple[Any, Any]:
    """Exact, at the end; and what the run has."""
    speed = run.speed()
    return exp(-run.layer.left_by_smoothing() * run.drag_time * len(speed)), speed[-1]


def slip_left(run: Any) -> tuple[Any, Any]:
    slip = run.slip()
    mass_ratio = run.layer.particle_mass / run.layer.water_mass
    return exp(-(1 + mass_ratio) * run.drag_time / mass_ratio * len(slip)), slip[-1]


def of_weak_drag(run: Any) -> Any:
    exact, ours = wave_left(run)
    return computed(
        f"wave after ten intervals, k = {run.drag_time:g}",
        "of its amplitude",
        exact,
        "exact solution of dU/dt = -r K U",
        ours,
        FIRST_ORDER_PERCENT,
    )


def of_energy(run: Any) -> Any:
    energy = np.concatenate([[1], run.energy()])
    falls = int((energy[1:] < energy[:-1]).sum())
    return validation.row(
        f"intervals in which the energy of the {run.start} falls, k = {run.drag_time:g}",
        "-",
        len(energy) - 1,
        "drag takes energy",
        "computed",
        falls,
        0,
        0,
    )


def of_order(start: Any, runs: Any, exact: Any) -> Any:
    errors = [abs(ours - right) for right, ours in map(exact, runs)]
    what = {"wave": "wave between fixed particles", "uniform": "free particles' slip"}[start]
    print(f"{what}: errors {', '.join(f'{error:.2e}' for error in errors)} of the start at intervals halved")
    return computed(
        f"order in the interval, {what}",
        "-",
        1,
        "splitting of first order",
        log2(errors[-2] / errors[-1]),
        ORDER_PERCENT,
    )


def of_free_particles(run: Any) -> list[Any]:
    layer, slip = run.layer, run.slip()
    mass_ratio = layer.particle_mass / layer.water_mass
    taken = -expm1(-run.drag_time / mass_ratio)
    momentum = layer.water_mass * run.speed()[-1] + layer.particle_mass * run.particle_speed()[-1]
    # With the force that they feel at the start the particles begin their first step; no interval has recorded it.
    first_half_step = 0.5 * layer["demStep"] / layer["couplingTimeStep"] * run.drag_time / (1 + run.drag_time)
    print(
        f"{run.path.name}: slip {slip[0]:.3e} ... {slip[-1]:.1e}, momentum"
        f" {momentum / layer.water_mass - 1 - first_half_step:+.1e}"
    )
    return [
        # From the second interval on: what the contacts held is known from the interval before.
        computed(
            f"slip of free particles, one interval after the other, k = {run.drag_time:g}",
            "-",
            (1 - taken) / (1 + mass_ratio * taken),
            "linear analysis",
            (slip[5] / slip[1]) ** (1 / 4),
            DEM_STEP_PERCENT,
        ),
        computed(
            "momentum of water and particles when there is no slip left",
            "kg m/s",
            SPEED[run.start] * layer.water_mass * (1 + first_half_step),
            "the water's at first, first half step",
            SPEED[run.start] * momentum,
            SOLVER_PERCENT,
        ),
    ]


def plot(waves: Any, vortices: Any) -> None:
    figure, axes = pyplot.subplots(1, 2, sharey=True, figsize=(8, 4))
    for panel, runs in zip(axes, (waves, vortices)):
        for run in runs:
            panel.semilogy(np.concatenate([[1], run.energy()]), "o-", markersize=3, label=f"k = {run.drag_time:g}")
        panel.set_title(f"{runs[0].start} between fixed particles")
        panel.set_xlabel("intervals")
        panel.legend()
    axes[0].set_ylabel("kinetic energy of the water")
    figure.tight_layout()
    figure.savefig("results/energy.png", dpi=120)


if __name__ == "__main__":
    main()
