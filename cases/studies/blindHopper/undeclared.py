"""What a blind hopper may have in it that its description does not say. Of the model's own effects (inLibrary) and
others.

Every effect is one function of its amplitude a, with 1 (or -1) the end of what is plausible:
  entries     {entry: value} from the case's other entries
  files       changes files of the case before its mesh is made
  mesh        changes files that the mesher has written
  record      changes the curve that the scale shows: (time [s], mass [kg], a, random) -> (time, mass)
"""

import re
from dataclasses import dataclass
from math import cos, radians, sin, tan
from pathlib import Path
from typing import Any, Callable, Optional

import numpy as np


@dataclass(frozen=True)
class Undeclared:
    name: str  # of the study's library, where it is in there
    in_library: bool
    meaning: str
    signed: bool = False
    switch: bool = False  # no amplitude: on
    medium: str = "both"  # air, water: where it acts
    entries: Optional[Callable] = None
    files: Optional[Callable] = None
    mesh: Optional[Callable] = None
    record: Optional[Callable] = None


# --- Records ----------------------------------------------------------------------------------------------------------


def lag(time: np.ndarray, mass: np.ndarray, a: Any, random: Any) -> tuple[Any, Any]:
    """First-order, tau y' = m - y, in steps of the exact solution for a mass held over a step."""
    shown = mass.copy()
    for i in range(1, len(mass)):
        step = time[i] - time[i - 1]
        shown[i] = mass[i] + (shown[i - 1] - mass[i]) * np.exp(-step / (0.1 * a))
    return time, shown


def trigger(time: np.ndarray, mass: np.ndarray, a: Any, random: Any) -> tuple[Any, Any]:
    """The record's zero is 0.03 a seconds after the opening; before the opening nothing moves."""
    return time, np.interp(time + 0.03 * a, time, mass)


def momentum(time: np.ndarray, mass: np.ndarray, a: Any, random: Any) -> tuple[Any, Any]:
    return time, mass + 0.03 * a * np.gradient(mass, time)


def under_water(time: np.ndarray, mass: np.ndarray, a: Any, random: Any) -> tuple[Any, Any]:
    return time, mass * (1 - 1000 / 2540)


def bent_scale(time: np.ndarray, mass: np.ndarray, a: Any, random: Any) -> tuple[Any, Any]:
    """Right when empty and when full, up to 5 % of the fill off half-way."""
    full = mass[0]
    return time, mass + 0.05 * a * 4 * mass * (full - mass) / full


def pause(time: np.ndarray, mass: np.ndarray, a: Any, random: Any) -> tuple[Any, Any]:
    """Something blocks the orifice for up to 0.1 s, at a random time between 90 and 50 % of the fill."""
    level = random.uniform(0.5, 0.9) * mass[0]
    begin = time[np.argmax(mass <= level)]
    later = np.where(time <= begin, time, np.maximum(begin, time - 0.1 * a))
    return time, np.interp(later, time, mass)


# --- Cases ------------------------------------------------------------------------------------------------------------


def tilt(case: Any, a: Any) -> None:
    """The whole apparatus leans by up to 15 degrees."""
    angle = radians(15 * a)
    replace(
        case / "DEM/in.hopper",
        "gravity 9.81 vector 0 0 -1",
        f"gravity 9.81 vector {sin(angle):.9g} 0 {-cos(angle):.9g}",
    )
    replace(case / "constant/g", "(0 0 -9.81)", f"({9.81 * sin(angle):.9g} 0 {-9.81 * cos(angle):.9g})")


def rod(case: Any, a: Any) -> None:
    """A horizontal rod of up to 6 mm across the hopper, its axis 8 mm above the orifice. The water does not feel it."""
    with open(case / "DEM/in.hopper", "a") as script:
        script.write(
            "\nfix rod all wall/gran model hertz tangential history cohesion ${cohesion} "
            f"rolling_friction ${{rolling}} primitive type 2 xcylinder {3e-3 * a:.6g} 0 8e-3\n"
        )


def funnel(case: Any, a: Any) -> None:
    """The bottom rises to the wall by up to 30 degrees. The water's walls stay as they are."""
    path = case / "DEM/meshes/hopperPlate.stl"
    slope = tan(radians(30 * a))
    points = [[float(x) for x in found] for found in re.findall(r"vertex (\S+) (\S+) (\S+)", path.read_text())]
    edge = min(np.hypot(x, y) for x, y, _ in points)

    def raised(found: Any) -> str:
        x, y, z = (float(part) for part in found.groups())
        return f"vertex {x:.8g} {y:.8g} {z + (np.hypot(x, y) - edge) * slope:.8g}"

    path.write_text(re.sub(r"vertex (\S+) (\S+) (\S+)", raised, path.read_text()))


def replace(path: Path, old: Any, new: Any) -> None:
    text = path.read_text()
    if old not in text:
        raise SystemExit(f"{path}: has no '{old}'")
    path.write_text(text.replace(old, new))


# --- All of them ------------------------------------------------------------------------------------------------------

# In the library: those that were expected, when the project began, to change a rate by 3 % or more.
EFFECTS = [
    Undeclared(
        "wallFriction",
        True,
        "the cylinder rubs more",
        entries=lambda p, a: {"frictionWall": p["frictionWall"] + 0.35 * a},
    ),
    Undeclared(
        "bottomFriction",
        True,
        "the bottom rubs more",
        entries=lambda p, a: {"frictionBottom": p["frictionBottom"] + 0.35 * a},
    ),
    Undeclared("rollingFriction", True, "particles resist rolling", entries=lambda p, a: {"rollingFriction": 0.05 * a}),
    Undeclared(
        "particleDiameter",
        True,
        "particles of another size",
        signed=True,
        entries=lambda p, a: {"particleDiameter": p["particleDiameter"] * (1 + 0.05 * a)},
    ),
    Undeclared(
        "orificeDiameter",
        True,
        "orifice of another width",
        signed=True,
        entries=lambda p, a: {"orificeDiameter": p["orificeDiameter"] * (1 + 0.02 * a)},
    ),
    Undeclared(
        "dragFactor",
        True,
        "larger or smaller drag",
        signed=True,
        medium="water",
        entries=lambda p, a: {"dragFactor": 1 + 0.25 * a},
    ),
    Undeclared(
        "dragLaw",
        True,
        "the drag law of Koch and Hill",
        switch=True,
        medium="water",
        entries=lambda p, a: {"dragLaw": "KochHillDrag"},
    ),
    Undeclared(
        "lubrication",
        True,
        "lubrication between particles",
        switch=True,
        medium="water",
        entries=lambda p, a: {"lubrication": "on"},
    ),
    Undeclared("addedMass", True, "added mass", medium="water", entries=lambda p, a: {"addedMassCoefficient": 0.5 * a}),
    Undeclared(
        "pumpingByDilation",
        True,
        "no pumping by dilation",
        switch=True,
        medium="water",
        entries=lambda p, a: {"dilation": "off"},
    ),
    Undeclared(
        "closedTop", True, "a lid on the hopper", switch=True, medium="water", entries=lambda p, a: {"lid": "on"}
    ),
    Undeclared("scaleLag", True, "the scale lags", record=lag),
    Undeclared(
        "weightUnderWater", True, "the weight under water is recorded", switch=True, medium="water", record=under_water
    ),
    Undeclared("triggerOffset", True, "the record begins early or late", signed=True, record=trigger),
    Undeclared(
        "momentumOfLeavingParticles", True, "the scale feels the particles that leave", signed=True, record=momentum
    ),
    Undeclared("tilt", False, "the hopper leans by up to 15 degrees", files=tilt),
    Undeclared(
        "saltWater",
        False,
        "water up to 20 % denser",
        medium="water",
        entries=lambda p, a: {"fluidDensity": p["fluidDensity"] * (1 + 0.2 * a)},
    ),
    Undeclared("rod", False, "a rod of up to 6 mm across the hopper above the orifice", files=rod),
    Undeclared("funnel", False, "a bottom that rises by up to 30 degrees to the wall", mesh=funnel),
    Undeclared("bentScale", False, "a scale up to 5 % of the fill off half-way", signed=True, record=bent_scale),
    Undeclared("pause", False, "the orifice is blocked for up to 0.1 s", record=pause),
]
BY_NAME = {effect.name: effect for effect in EFFECTS}
