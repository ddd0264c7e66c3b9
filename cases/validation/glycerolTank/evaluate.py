#!/usr/bin/python3
"""Velocities of the particles against the measured ones, and what spreading the force does to them."""

from pathlib import Path
from typing import Any

import measure
import numpy as np

from clepsydra import case_files, closures, parameter_file, validation
from clepsydra.picture_style import pyplot

SOURCE = "kyleyhw/PHY324_motion_in_fluids, 1f0af8ed: Teflon particles in glycerol, 2023"
# The program against the closures that it was reported to use
OF_THE_CLOSURES = 2
# Measured velocities: 2 sigma of the diameter (.02 mm, squared), of the repeats and of the fit to particle 3
OF_A_PARTICLE = 5
# The gap to the wall was not measured: half a diameter more or less than the one assumed changes the ratio by 5 %
OF_THE_EDGE = 5
# Two-way, the wall comes from the fluid's equations; and a particle's own disturbance should not be there
OF_TWO_WAY = 3
STEEPER = (
    "the measured velocities grow more with the particle's size than a tube of 94 mm allows: particles 1 to 5 need"
    " viscosities of {} Pa s with Di Felice's wall, {} Pa s without any wall. The runs follow the closures, which agree"
    " with Faxen's series to 1 %; but that is for creeping flow. In the liquid's own equations (two-way, the particle's"
    " own wake taken out) the tank slows particles 1 to 5 by 3.1, 4.6, 4.9, 5.4, 4.9 % only, for inertia hides the wall"
    " from the larger ones"
)
OWN_WAKE = (
    "b = {:g} d, {}: two-way, the particle moves {:+.1f} % against the one-way velocity. Spread over a Gaussian of "
    "bandwidth b its force drags it along, by d/(sqrt(pi) b) = {:.1f} % in creeping flow without walls. So it is "
    "one-way with wallCorrection that is meant, or two-way without it once the particle's own wake is left out"
)


def main() -> None:
    measured = parameter_file.parameters("measured")
    runs = {run.name: terminal(run) for run in sorted(Path("runs").iterdir())}
    validation.write([row for name in runs for row in rows(name, runs, measured)])
    plot(runs, measured)


def terminal(run: Any) -> tuple[float, float]:
    """Mean and standard deviation of the velocity over the last fifth of the run."""
    time, _, velocity = case_files.columns(run, "particleHeight")
    last = -velocity[time > 0.8 * time[-1]]
    return float(last.mean()), float(last.std())


def rows(name: str, runs: Any, measured: Any) -> list[Any]:
    ours, scatter = runs[name]
    p = parameter_file.parameters(Path("runs") / name / "parameters")
    diameter, viscosity = p["particleDiameter"], p["fluidViscosity"]
    axis = measure.axis_velocity(diameter, viscosity)

    if name.startswith("particle"):
        number = int(name.removeprefix("particle"))
        velocity = measured[f"velocity{number}"]
        # the diameter's .02 mm, the repeats, and the fit's own
        error = float(np.hypot(2 * 0.02e-3 / diameter * velocity, measured[f"velocityError{number}"]))
        fit = ", the particle fitted" if number == measure.FITTED else ""
        return [
            validation.row(
                f"particle {number}, {1e3 * diameter:g} mm, on the axis{fit}",
                "m/s",
                velocity,
                SOURCE,
                "measured",
                ours,
                error,
                OF_A_PARTICLE,
                STEEPER.format(*needed_viscosities(measured)),
                scatter,
            ),
            validation.row(
                f"particle {number}, on the axis, against the closures",
                "m/s",
                axis,
                "closures",
                "computed",
                ours,
                scatter,
                OF_THE_CLOSURES,
            ),
        ]
    if name == "edge":
        centre = runs["particle3"][0]
        ratio = measured["edgeOverCentre"]
        return [
            validation.row(
                "particle 3, edge over centre, one diameter from the wall",
                "-",
                ratio,
                SOURCE,
                "measured",
                ours / centre,
                measured["edgeOverCentreError"],
                OF_THE_EDGE,
            ),
            validation.row(
                "particle 3, at the edge, against the closures",
                "m/s",
                edge_velocity(p),
                "closures",
                "computed",
                ours,
                scatter,
                OF_THE_CLOSURES,
            ),
        ]
    # two-way
    smoothing = float(name.split("-")[1])
    where, reference = ("at the edge", edge_velocity(p)) if name.endswith("edge") else ("on the axis", axis)
    if name.endswith("Oseen"):
        where += ", own wake left out (Oseen)"
    if name.endswith("corrected"):
        where += ", the wall counted twice (wallCorrection)"
    finding = OWN_WAKE.format(smoothing, where, 100 * (ours / reference - 1), 100 / (np.sqrt(np.pi) * smoothing))
    return [
        validation.row(
            f"particle 3 two-way, b = {smoothing:g} d, {where}, against one-way with wall",
            "m/s",
            reference,
            "closures",
            "computed",
            ours,
            scatter,
            OF_TWO_WAY,
            finding,
        )
    ]


def edge_velocity(p: dict[str, Any]) -> float:
    """Beside a plane wall, creeping: at speed v the particle feels the drag of the free one at v, times Faxen's
    factor."""
    diameter = p["particleDiameter"]
    particle = {
        "dragLaw": p["dragLaw"],
        "particleDiameter": diameter,
        "fluidDensity": p["fluidDensity"],
        "fluidViscosity": p["fluidViscosity"],
    }
    factor = closures.value("faxenParallelFactor", **{"lambda": 1 / 3})
    weight = np.pi / 6 * diameter**3 * (p["particleDensity"] - p["fluidDensity"]) * 9.81
    speeds = np.linspace(0, 0.1, 2001)
    return float(np.interp(weight, factor * closures.values("drag", slipSpeed=speeds, **particle) * speeds, speeds))


def needed_viscosities(measured: Any) -> Any:
    """Of particles 1 to 5 [Pa s], as text: with Di Felice's wall, and without."""
    density = parameter_file.parameters("parameters")["fluidDensity"]
    grid = np.linspace(2.2e-4, 3.6e-4, 29)
    texts = []
    for wall in (True, False):
        needed = []
        for number, diameter in measure.DIAMETERS.items():
            velocities = [measure.axis_velocity(diameter, viscosity, wall) for viscosity in grid]
            needed.append(density * np.interp(-measured[f"velocity{number}"], -np.array(velocities), grid))
        texts.append(", ".join(f"{one:.3f}" for one in needed))
    return texts


def plot(runs: Any, measured: Any) -> None:
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4.5))
    viscosity = measured["fluidViscosity"]
    numbers = list(measure.DIAMETERS)
    diameters = np.array([measured[f"particleDiameter{number}"] for number in numbers])
    scale = diameters**2
    velocity = np.array([measured[f"velocity{number}"] for number in numbers])
    error = np.hypot(2 * 0.02e-3 / diameters * velocity, [measured[f"velocityError{number}"] for number in numbers])
    left.errorbar(1e3 * diameters, velocity / scale, error / scale, fmt="ko", label="measured")
    for wall, style in ((True, "-"), (False, "--")):
        curve = [measure.axis_velocity(d, viscosity, wall) for d in diameters]
        left.plot(1e3 * diameters, curve / scale, style, label=f"closures, {'Di Felice wall' if wall else 'no wall'}")
    ours = [number for number in numbers if f"particle{number}" in runs]
    left.plot(
        [1e3 * diameters[n - 1] for n in ours],
        [runs[f"particle{n}"][0] / scale[n - 1] for n in ours],
        "rx",
        ms=9,
        label="runs, one-way, Di Felice wall",
    )
    left.set(xlabel="particle diameter [mm]", ylabel="velocity / diameter$^2$ [1/(m s)]")
    left.legend()

    names = [name for name in runs if name in ("particle3", "edge") or name.startswith("twoWay")]
    right.bar(names, [runs[name][0] / measured["velocity3"] for name in names])
    right.axhline(1, color="k", label="measured, centre")
    right.axhline(measured["edgeOverCentre"], color="k", ls="--", label="measured, edge")
    right.set(ylabel="velocity of particle 3 over the measured one", ylim=(0.7, 1.3))
    right.tick_params(axis="x", rotation=30)
    right.legend()
    figure.tight_layout()
    figure.savefig("results/glycerolTank.png", dpi=150)


if __name__ == "__main__":
    main()
