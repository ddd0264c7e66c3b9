"""Surfaces of a flat-bottomed hopper with a round orifice, made of triangles.

The orifice's edge lies in the plane z = 0. Below it the orifice may go on as a vertical land of landHeight and then
widen by 45 degrees over bevelHeight (both 0: a plate without thickness). Walls have no thickness, unless wallThickness
> 0.

Circles become polygons. Their corners lie a little outside the circle, so that the polygon has the circle's area: the
orifice is not made smaller by its corners. """

from math import cos, hypot, log, pi, sin, sqrt
from pathlib import Path
from typing import Any

Point = tuple[float, ...]  # x, y, z [m]
Triangle = tuple[Point, Point, Point]

PARTICLE_CORNERS = 48  # of the particles' walls: each triangle costs time at every step
WATER_CORNERS = 192  # of the surfaces that the fluid's mesh is fitted to


def equal_area_radius(radius: float, corners: int) -> float:
    """Distance of the corners of the regular polygon with the circle's area."""
    return radius * sqrt((2 * pi / corners) / sin(2 * pi / corners))


def particle_walls(p: dict[str, Any]) -> dict[str, list[Triangle]]:
    """Triangles of the cylinder, of the plate with its orifice, and of the plug, by name."""
    orifice, hopper, height = p["orificeDiameter"] / 2, p["hopperDiameter"] / 2, p["hopperHeight"]
    rows = max(1, round(height / (2 * p["cellSize"])))
    # rings wider apart as they grow, so that triangles stay compact
    count = max(1, round(log(hopper / orifice) / 0.25))
    rings = [(orifice * (hopper / orifice) ** (ring / count), 0.0) for ring in range(count + 1)]
    return {
        "hopperWall": revolved([(hopper, height * row / rows) for row in range(rows + 1)], PARTICLE_CORNERS),
        "hopperPlate": revolved(exit_profile(p)[:0:-1] + rings, PARTICLE_CORNERS),
        "plug": fan(circle(orifice, 0, PARTICLE_CORNERS), (0, 0, 0)),
    }


def water_walls(p: dict[str, Any]) -> dict[str, list[Triangle]]:
    """Triangles of the hopper's inside, and of the rest of its surface if there is any, by name."""
    orifice, hopper, height = p["orificeDiameter"] / 2, p["hopperDiameter"] / 2, p["hopperHeight"]
    rest = exit_profile(p)
    if p["wallThickness"] > 0:
        outer = hopper + p["wallThickness"]
        rest += [(outer, rest[-1][1]), (outer, height), (hopper, height)]
    walls = {"hopper": revolved([(orifice, 0), (hopper, 0), (hopper, height)], WATER_CORNERS)}
    if len(rest) > 1:
        walls["exit"] = revolved(rest, WATER_CORNERS)
    return walls


def exit_profile(p: dict[str, Any]) -> list[tuple[float, float]]:
    """(radius, height) from the orifice's edge downwards."""
    orifice, land, bevel = p["orificeDiameter"] / 2, p["landHeight"], p["bevelHeight"]
    profile = [(orifice, 0.0)]
    if land > 0:
        profile.append((orifice, -land))
    if bevel > 0:
        profile.append((orifice + bevel, -land - bevel))
    return profile


def check(p: dict[str, Any]) -> str | None:
    """What is wrong with the dimensions, in words; empty if nothing."""
    for name in (
        "orificeDiameter",
        "hopperDiameter",
        "hopperHeight",
        "tankDiameter",
        "tankDepth",
        "waterAboveRim",
        "cellSize",
    ):
        if not (isinstance(p.get(name), float) and p[name] > 0):
            return f"{name} is {p.get(name, 'missing')}; allowed: a length > 0 [m]"
    for name in ("landHeight", "bevelHeight", "wallThickness"):
        if not (isinstance(p.get(name), float) and p[name] >= 0):
            return f"{name} is {p.get(name, 'missing')}; allowed: a length [m], or 0"
    if not p["orificeDiameter"] < p["hopperDiameter"] < p["tankDiameter"]:
        return "orificeDiameter < hopperDiameter < tankDiameter must hold"
    if p["orificeDiameter"] / 2 + p["bevelHeight"] >= p["hopperDiameter"] / 2:
        return "the bevel must end within the hopper's radius: make bevelHeight smaller"
    if p["landHeight"] + p["bevelHeight"] >= p["tankDepth"]:
        return "landHeight + bevelHeight < tankDepth must hold: the exit ends above the tank's floor"
    if p["wallThickness"] > 0 and not p["landHeight"] + p["bevelHeight"] > 0:
        return "walls of a thickness need a plate of a thickness, landHeight + bevelHeight > 0"
    return ""


def revolved(profile: list[tuple[float, float]], corners: int) -> list[Triangle]:
    """Triangles of a surface of revolution; the profile is a list of (radius, height)."""
    rings = [circle(radius, height, corners) for radius, height in profile]
    return [triangle for first, second in zip(rings, rings[1:]) for triangle in band(first, second)]


def circle(radius: float, height: float, corners: int) -> list[Point]:
    outer = equal_area_radius(radius, corners)
    angles = [2 * pi * index / corners for index in range(corners)]
    return [(outer * cos(angle), outer * sin(angle), height) for angle in angles]


def band(first: list[Point], second: list[Point]) -> list[Triangle]:
    """Triangles between two rings of equally many points."""
    triangles = []
    for index in range(len(first)):
        after = (index + 1) % len(first)
        triangles.append((first[index], first[after], second[index]))
        triangles.append((first[after], second[after], second[index]))
    return triangles


def fan(ring: list[Point], centre: Point) -> list[Triangle]:
    return [(centre, point, after) for point, after in zip(ring, ring[1:] + ring[:1])]


def write(walls: dict[str, list[Triangle]], folder: Path) -> None:
    """One STL file for each surface."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, triangles in walls.items():
        (folder / f"{name}.stl").write_text(stl(name, triangles))


def stl(name: str, triangles: list[Triangle]) -> str:
    lines = [f"solid {name}"]
    for a, b, c in triangles:
        lines.append("facet normal {:.8g} {:.8g} {:.8g}".format(*unit_normal(a, b, c)))
        lines += ["outer loop"] + ["vertex {:.8g} {:.8g} {:.8g}".format(*point) for point in (a, b, c)]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + [f"endsolid {name}"]) + "\n"


def normal(a: Point, b: Point, c: Point) -> Point:
    """As long as twice the triangle's area."""
    u, v = ([end - start for start, end in zip(a, other)] for other in (b, c))
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def unit_normal(a: Point, b: Point, c: Point) -> Point:
    along = normal(a, b, c)
    length = hypot(*along)
    return tuple(part / length for part in along)
