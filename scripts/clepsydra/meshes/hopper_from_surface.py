#!/usr/bin/python3
"""A hopper of any shape, the STL file hopper.stl of the case, inside a square tank of water, meshed by snappyHexMesh.

Usage: hopperFromSurface PARAMETERS CASE
       hopperFromSurface --cells PARAMETERS   makes nothing, prints about how many cells the mesh will have
       hopperFromSurface --check PARAMETERS SURFACE   makes nothing, exit status 1 where the STL file is refused

CASE/hopper.stl (text or binary, metres, z upwards) is one surface without thickness, open at two places only: at the
orifice, an edge in the plane z = 0 round the origin, and at the rim, z = hopperHeight. Its upper part is a cylinder of
hopperDiameter, where particles are filled in; below, it is of any shape within that cylinder. A surface with another
hole is refused.

Particles and water get their walls from the same triangles: DEM/meshes/hopperWall.stl (those of the cylinder),
hopperPlate.stl
(all others), plug.stl (closes the orifice) and constant/triSurface/hopper.stl. All else is as hopperBySnappy writes it.
"""

import struct
import subprocess
import sys
from collections import Counter
from math import hypot, pi, sqrt
from pathlib import Path
from typing import Any

from clepsydra import environment, parameter_file
from clepsydra.meshes import hopper_walls
from clepsydra.meshes.generator import read_options
from clepsydra.meshes.hopper_walls import Point, Triangle

SNAPPY = environment.REPOSITORY / "meshes" / "hopperBySnappy"
SAME_POINT = 1e-4  # of the hopper's diameter: points nearer than this are one
ROUNDNESS = 0.01  # by which the corners of a polygon may miss the circle


def triangles(file: Path) -> list[Triangle]:
    data = file.read_bytes()
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= 84 else 0
    if len(data) == 84 + 50 * count:
        found = [struct.unpack_from("<12x9f", data, 84 + 50 * index) for index in range(count)]
        return [(corners[:3], corners[3:6], corners[6:]) for corners in found]
    try:
        points = [
            tuple(map(float, line.split()[1:4]))
            for line in data.decode().splitlines()
            if line.split()[:1] == ["vertex"]
        ]
    except ValueError as error:
        raise ValueError(f"is no STL file ({error})") from error
    if not points or len(points) % 3 or any(len(point) != 3 for point in points):
        raise ValueError("is no STL file: no triangles, or not three corners for each")
    return list(zip(points[::3], points[1::3], points[2::3]))


def merged(found: list[Triangle], tolerance: float) -> list[Triangle]:
    """With one point for all that are nearer than the tolerance, and without triangles that have become lines."""
    seen: dict[Any, Any] = {}

    def point(corner: Point) -> Point:
        place = tuple(int(part // tolerance) for part in corner)
        near = (
            seen.get((place[0] + i, place[1] + j, place[2] + k))
            for i in (0, -1, 1)
            for j in (0, -1, 1)
            for k in (0, -1, 1)
        )
        for other in near:
            if other and all(abs(a - b) < tolerance for a, b in zip(other, corner)):
                return other
        return seen.setdefault(place, corner)

    moved = ((point(a), point(b), point(c)) for a, b, c in found)
    return [triangle for triangle in moved if len(set(triangle)) == 3]


def open_edges(surface: list[Triangle]) -> list[tuple[Point, Point]]:
    edges = Counter(frozenset((triangle[i - 1], triangle[i])) for triangle in surface for i in range(3))
    for edge, count in edges.items():
        if count > 2:
            raise ValueError(
                f"has an edge of {count} triangles, at {place(next(iter(edge)))}; allowed: a surface that does not"
                " branch"
            )
    # in no order; of two points, for a triangle with two corners at one place has been left out
    return [(one, other) for (one, other), count in edges.items() if count == 1]


def place(point: Point) -> str:
    return "({:.4g} {:.4g} {:.4g}) m".format(*point)


def loop(edges: list[tuple[Point, Point]], name: str) -> list[Point]:
    """The points of the one closed line that the edges are."""
    after: dict[Any, Any] = {}
    for a, b in edges:
        after.setdefault(a, []).append(b)
        after.setdefault(b, []).append(a)
    if not after:
        raise ValueError(f"has no open edge at the {name}")
    line = [next(iter(after))]
    while len(line) < 2 or line[-1] != line[0]:
        ahead = [point for point in after[line[-1]] if len(line) < 2 or point != line[-2]]
        if len(after[line[-1]]) != 2:
            raise ValueError(f"has open edges that branch at the {name}, {place(line[-1])}")
        line.append(ahead[0])
    if len(line) - 1 != len(after):
        raise ValueError(f"has more than one opening at the {name}")
    return line[:-1]


def checked(surface: list[Triangle], p: dict[str, Any]) -> list[Point]:
    """The orifice's edge; ValueError says what is wrong with the surface."""
    radius, height = p["hopperDiameter"] / 2, p["hopperHeight"]
    near = ROUNDNESS * radius
    for triangle in surface:
        if hypot(*hopper_walls.normal(*triangle)) < (SAME_POINT * p["hopperDiameter"]) ** 2:
            raise ValueError(f"has a triangle of three points in line, at {place(triangle[0])}")
    for point in {point for triangle in surface for point in triangle}:
        if not (-near < point[2] < height + near and hypot(*point[:2]) < radius + near):
            raise ValueError(
                f"has the point {place(point)}; allowed: from z = 0 to hopperHeight {height:g} m, within hopperDiameter"
                f" {p['hopperDiameter']:g} m. Are its lengths in metres?"
            )
    edges: Any = {"orifice": [], "rim": []}
    for edge in open_edges(surface):
        ends = [end for end, z in (("orifice", 0), ("rim", height)) if all(abs(point[2] - z) < near for point in edge)]
        if not ends:
            raise ValueError(f"has a hole at {place(edge[0])}; allowed: openings at z = 0 and at z = hopperHeight only")
        edges[ends[0]].append(edge)
    rim, orifice = loop(edges["rim"], "rim"), loop(edges["orifice"], "orifice")
    for point in rim:
        if abs(hypot(*point[:2]) - radius) > near:
            raise ValueError(
                f"has the point {place(point)} on its rim; allowed: a circle of hopperDiameter"
                f" {p['hopperDiameter']:g} m"
            )
    area = abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(orifice, orifice[1:] + orifice[:1]))) / 2
    wide = 2 * sqrt(area / pi)
    if abs(wide / p["orificeDiameter"] - 1) > 2 * ROUNDNESS:
        raise ValueError(
            f"has an orifice of the area of a circle of {wide:.4g} m; allowed: orificeDiameter"
            f" {p['orificeDiameter']:g} m"
        )
    return orifice


def is_on_cylinder(triangle: Triangle, radius: float) -> bool:
    return abs(hopper_walls.unit_normal(*triangle)[2]) < ROUNDNESS and all(
        abs(hypot(*point[:2]) - radius) < ROUNDNESS * radius for point in triangle
    )


def main() -> None:
    if sys.argv[1:2] == ["--check"] and len(sys.argv) == 4:
        read_surface(Path(sys.argv[3]), parameter_file.parameters(sys.argv[2]))
        return
    only_count, source, case = read_options("hopperFromSurface", __doc__)
    text = parameter_file.read(source)  # once: it may be a pipe
    p = parameter_file.parameters_in(text)
    if any(p.get(name) != 0 for name in ("landHeight", "bevelHeight", "wallThickness")):
        sys.exit(
            "hopperFromSurface: landHeight, bevelHeight and wallThickness; allowed with this mesh: 0, the surface says"
            " it all"
        )
    made = subprocess.run(
        [SNAPPY, *(["--cells", "/dev/stdin"] if only_count else ["/dev/stdin", str(case)])], input=text, text=True
    )
    if made.returncode != 0 or only_count:
        sys.exit(made.returncode)

    surface, orifice, cylinder, rest = read_surface(case / "hopper.stl", p)
    centre = tuple(sum(parts) / len(orifice) for parts in zip(*orifice))
    hopper_walls.write({"hopper": surface}, case / "constant" / "triSurface")
    hopper_walls.write(
        {"hopperWall": cylinder, "hopperPlate": rest, "plug": hopper_walls.fan(orifice, centre)},
        case / "DEM" / "meshes",
    )


def read_surface(file: Path, p: dict[str, Any]) -> tuple[Any, Any, Any, Any]:
    """All triangles, the orifice's edge, the triangles of the cylinder, all others. Exits where it is refused."""
    radius = p["hopperDiameter"] / 2
    try:
        surface = merged(triangles(file), SAME_POINT * p["hopperDiameter"])
        orifice = checked(surface, p)
        cylinder: list[Triangle] = []
        rest: list[Triangle] = []
        for triangle in surface:
            (cylinder if is_on_cylinder(triangle, radius) else rest).append(triangle)
        if not cylinder or not rest:
            raise ValueError(
                "has no cylinder of hopperDiameter in its upper part" if rest else "is a cylinder without a bottom"
            )
    except OSError as error:
        sys.exit(
            f"hopperFromSurface: {file}: {error.strerror}. It is the surface of the hopper; meshes/coneSurface"
            " makes one"
        )
    except ValueError as error:
        sys.exit(f"hopperFromSurface: {file} {error}")
    return surface, orifice, cylinder, rest


if __name__ == "__main__":
    main()
