#!/usr/bin/python3
"""First rebound of the sphere: speeds, height and duration, against the measured trajectory."""

import json
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, equation_of_motion, parameter_file, validation
from clepsydra.picture_style import pyplot

SOURCE = "Gondret, Lance & Petit 2002, St = 152"
DATA = Path("../../../../shared/data/gondret2002_rebound/gondret_St152.csv")
# What is computed from DATA, which is not ours to keep here
TABLE = Path("measured.json")
# What drag laws scatter by; the height goes with the square of the speed
TOLERANCE = {"impact speed": 5, "rebound speed": 5, "rebound height": 10, "time between impacts": 5}
# The flight against its own equation: the sphere meets the wake that it left on the way down
OF_THE_EQUATION = 5
# What may depend on numbers that are not known (roughness) or not real (softened contacts)
OF_VARIED = 5
UNIT = {"impact speed": "m/s", "rebound speed": "m/s", "rebound height": "m", "time between impacts": "s"}

FORCES = {
    "neither": "no lubrication, no added mass",
    "addedMass": "added mass, no lubrication",
    "lubrication": "lubrication, no added mass",
    "both": "lubrication and added mass",
    "MeiAdrian": "lubrication, added mass, history after Mei & Adrian",
    "Basset": "lubrication, added mass, history after Basset",
}
KERNELS = {"MeiAdrian": equation_of_motion.mei_adrian, "Basset": equation_of_motion.basset}
LACKING = "the run has no history force, see those that have it"
REMAINING = (
    "the sphere turns round into its own wake, for which neither kernel was made: Basset's is of creeping flow and "
    "holds it back too long, Mei & Adrian's is of a steady direction and forgets the wake too soon"
)
VARIED = {"softer": "contacts ten times softer", "rougher": "ten times the roughness"}


def main() -> None:
    points = measured_points()
    measured = json.loads(TABLE.read_text())
    found = {run.name: trajectory(run) for run in sorted(Path("runs").iterdir())}
    bounces = {name: bounce(*one) for name, one in found.items()}
    validation.write([row for name in bounces for row in rows(name, bounces, measured)])
    plot(found, points, measured)


def measured_points() -> Any:
    if not DATA.exists():
        print(f"{DATA} is not here: using {TABLE}, which was computed from it")
        return None
    points = np.loadtxt(DATA, delimiter=",", skiprows=1).T
    found = bounce(*points)
    # another machine's last digits are no reason to write it again
    if not np.allclose(list(found.values()), list(json.loads(TABLE.read_text()).values()), rtol=1e-9, atol=0):
        TABLE.write_text(json.dumps(found, indent=2) + "\n")
    return points


def trajectory(run: Any) -> tuple[Any, Any]:
    """Time from the first impact [s], gap below the sphere [m]."""
    time, height, _ = case_files.columns(run, "particleHeight")
    gap = height - 0.5 * parameter_file.parameters(run / "parameters")["particleDiameter"]
    return time - impacts(time, gap)[0], gap


def impacts(time: np.ndarray, gap: np.ndarray) -> list[Any]:
    """When the gap closes for the first and the second time: the last 1.2 to 4.5 mm before, extended by a parabola."""
    turns = [i for i in range(1, len(gap) - 1) if gap[i] <= gap[i - 1] and gap[i] < gap[i + 1] and gap[i] < 0.6e-3]
    first = turns[0]
    second = next(i for i in turns if time[i] > time[first] + 0.02)
    return [closing(time[: i + 1], gap[: i + 1]) for i in (first, second)]


def closing(time: np.ndarray, gap: np.ndarray) -> float:
    start = np.nonzero(gap > 4.5e-3)[0][-1]
    part = slice(start + 1, None)
    near = gap[part] > 0.9e-3
    roots = np.roots(np.polyfit(time[part][near], gap[part][near], 2)).real
    return float(roots[np.argmin(abs(roots - time[-1]))])


def bounce(time: np.ndarray, gap: np.ndarray) -> dict[str, Any]:
    """The four numbers compared, and a standard error of each from the scatter of the points about their fits."""
    first, second = impacts(time, gap)
    approach = (time < first) & (gap > 0.9e-3) & (gap < 10e-3) & (time > first - 0.02)
    rise = (time > first) & (time < first + 0.012) & (gap > 0.9e-3)
    rebound = (time > first + 0.02) & (time < first + 0.05)
    # speeds by parabolas, extended to the impact; the top by a cubic
    down, down_error = slope_at(time[approach] - first, gap[approach])
    up, up_error = slope_at(time[rise] - first, gap[rise])
    top = np.polyfit(time[rebound] - first, gap[rebound], 3)
    fine = np.linspace(0.02, 0.05, 2000)
    scatter = np.std(np.polyval(top, time[rebound] - first) - gap[rebound])
    return {
        "impact speed": (-down, down_error),
        "rebound speed": (up, up_error),
        "rebound height": (float(np.polyval(top, fine).max()), float(scatter)),
        "time between impacts": (second - first, 5e-4),
    }


def slope_at(time: np.ndarray, gap: np.ndarray) -> tuple[float, float]:
    fit, covariance = np.polyfit(time, gap, 2, cov=True)
    return float(fit[1]), float(np.sqrt(covariance[1, 1]))


def rows(name: str, bounces: Any, measured: Any) -> Any:
    if name not in FORCES:
        return [sensitivity(name, bounces)]
    ours = bounces[name]
    particle = equation_of_motion.Particle.of(parameter_file.parameters(Path("runs") / name / "parameters"))
    forces = {"added_mass": name not in ("neither", "lubrication"), "history": KERNELS.get(name)}
    down, up = ours["impact speed"][0], ours["rebound speed"][0]
    if name in KERNELS:
        # The history force slows the sphere most just after the bounce: what the first 12 ms extend to is less than
        # what
        # it left the wall with. That is what it has without this force.
        up = down * bounces["both"]["rebound speed"][0] / bounces["both"]["impact speed"][0]
    found = []
    for quantity, (value, error) in measured.items():
        found.append(
            validation.row(
                f"{FORCES[name]}: {quantity}",
                UNIT[quantity],
                value,
                SOURCE,
                "measured",
                ours[quantity][0],
                float(np.hypot(error, ours[quantity][1])),
                TOLERANCE[quantity],
                finding(name, quantity),
                ours[quantity][1],
            )
        )
    # so that a finding cannot hide a fault
    expected = flight(particle, down, up, **forces)
    for quantity, reference in zip(("rebound height", "time between impacts"), expected):
        found.append(
            validation.row(
                f"{FORCES[name]}: {quantity}, against its equation of motion",
                UNIT[quantity],
                reference,
                "equationOfMotion.py from this rebound speed, one-way",
                "computed",
                ours[quantity][0],
                ours[quantity][1],
                OF_THE_EQUATION,
            )
        )
    return found


def finding(name: str, quantity: str) -> Any:
    """Why a quantity may differ from the measured one; None where it may not."""
    why = None
    if quantity == "rebound speed" and "no lubrication" in FORCES[name]:
        why = "nothing but the dry restitution slows the bounce"
    elif name in KERNELS:
        why = REMAINING
    elif quantity in ("rebound height", "time between impacts"):
        why = LACKING
    return why and f"{FORCES[name]}: {why}"


def flight(particle: Any, down: Any, up: Any, **forces: Any) -> tuple[float, float]:
    """Height and duration of the flight after a bounce from speed `down` to speed `up`."""
    time, height = height_after(particle, down, up, **forces)
    return float(height.max()), float(time[np.nonzero(height > 0)[0][-1]])


def height_after(particle: Any, down: Any, up: Any, **forces: Any) -> tuple[Any, Any]:
    time, velocity = equation_of_motion.motion(particle, 0.15, start=-up, jump=-(up + down), **forces)
    return time, -np.concatenate([[0], np.cumsum(0.5 * (velocity[1:] + velocity[:-1]) * np.diff(time))])


def sensitivity(name: str, bounces: Any) -> Any:
    speed, error = bounces[name]["rebound speed"]
    reference, reference_error = bounces["both"]["rebound speed"]
    return validation.row(
        f"{VARIED[name]}: rebound speed, against the run as published",
        "m/s",
        reference,
        "this case",
        "computed",
        speed,
        float(np.hypot(error, reference_error)),
        OF_VARIED,
    )


def plot(found: Any, points: Any, measured: Any) -> None:
    if points is not None:
        pyplot.plot(1e3 * points[0], 1e3 * points[1], "k.", ms=4, label="measured, Gondret et al.")
    else:
        pyplot.axhline(1e3 * measured["rebound height"][0], color="k", label="measured height, Gondret et al.")
    for name, (time, gap) in found.items():
        pyplot.plot(1e3 * time, 1e3 * gap, label=(FORCES | VARIED)[name])
    pyplot.xlim(-20, 160)
    pyplot.ylim(-0.5, 22)
    pyplot.xlabel("time from the first impact [ms]")
    pyplot.ylabel("gap below the sphere [mm]")
    pyplot.legend(fontsize=8)
    pyplot.savefig("results/bounce.png", dpi=150)


if __name__ == "__main__":
    main()
