#!/usr/bin/python3
"""A flat-bottomed cylindrical hopper inside a closed tank of water.

Reads the dimensions from the dictionary PARAMETERS and writes, into CASE,
  system/blockMeshDict, topoSetDict, createBafflesDict   the fluid's mesh
  system/meshSteps                                       the programs that make it
  DEM/meshes/hopperWall.stl, hopperPlate.stl, plug.stl   the particles' walls

The fluid's mesh is an O-grid: a square core, then rings that end at the orifice, at the hopper's wall and at the tank's
wall. The hopper's cylinder and plate are faces of that grid, turned into walls without thickness. With `lid on;` the
hopper's open top is such a wall too: no water comes in from above.

Circles become polygons of the same area, see hopper_walls.py. """

import sys
from math import ceil, cos, log, pi, sin
from typing import Any

from clepsydra import parameter_file
from clepsydra.meshes import hopper_walls
from clepsydra.meshes.generator import read_options
from clepsydra.meshes.hopper_walls import equal_area_radius


def cells(length: float, size: float) -> int:
    return max(1, round(length / size))


def cells_graded(length: float, size: float, expansion: float) -> int:
    """How many cells fill length when they grow from size to expansion * size."""
    growth = log(expansion)
    return max(1, round(length / size * growth / (expansion - 1)))


# --- the fluid's mesh ---------------------------------------------------------

HEADER = """// Written by meshes/hopperInTank: change the case's parameters instead.
FoamFile {{ version 2.0; format ascii; class dictionary; object {0}; }}

"""


class Grid:
    """Radii and heights of the O-grid's block corners, and its cell counts."""

    def __init__(self, p: dict[str, Any]) -> None:
        size = p["cellSize"]
        orifice, hopper, tank = (p[f"{name}Diameter"] / 2 for name in ("orifice", "hopper", "tank"))
        # as wide as asked half-way between the orifice's edge and the hopper's wall
        self.per_quarter = 2 * ceil(pi * (orifice + hopper) / size / 8)
        self.corners = 4 * self.per_quarter
        self.radii = [0.62 * orifice] + [equal_area_radius(radius, self.corners) for radius in (orifice, hopper, tank)]
        self.heights = [-p["tankDepth"], 0, p["hopperHeight"], p["hopperHeight"] + p["waterAboveRim"]]
        widen, deepen = 2.5, 2
        self.ring_cells = [2, cells(hopper - orifice, size), cells_graded(tank - hopper, size, widen)]
        self.ring_expansion = [1, 1, widen]
        self.layer_cells = [
            cells_graded(p["tankDepth"], size, deepen),
            cells(p["hopperHeight"], size),
            cells(p["waterAboveRim"], size),
        ]
        self.layer_expansion = [1 / deepen, 1, 1]

    def cells(self) -> int:
        return (self.per_quarter**2 + 4 * self.per_quarter * sum(self.ring_cells)) * sum(self.layer_cells)

    def vertex(self, level: int, circle: int, corner: int) -> int:
        return (level * len(self.radii) + circle) * 4 + corner % 4

    def point(self, level: int, circle: int, degrees: float) -> str:
        radius, angle = self.radii[circle], degrees * pi / 180
        return f"({radius * cos(angle):.9g} {radius * sin(angle):.9g} {self.heights[level]:.9g})"


def block_mesh_dict(grid: Grid) -> str:
    levels, circles = range(len(grid.heights)), range(len(grid.radii))
    vertices = [
        grid.point(level, circle, 45 + 90 * corner) for level in levels for circle in circles for corner in range(4)
    ]
    # in the equal-area polygon a mesh point, not a chord, lies at 0, 90 ... degrees
    arcs = [
        f"arc {grid.vertex(level, circle, corner)} {grid.vertex(level, circle, corner + 1)} "
        f"{grid.point(level, circle, 90 + 90 * corner)}"
        for level in levels
        for circle in circles[1:]
        for corner in range(4)
    ]

    blocks: list[str] = []
    floor: list[list[int]] = []
    side: list[list[int]] = []
    top: list[list[int]] = []

    def block(corners: Any, counts: Any, expansions: Any) -> None:
        blocks.append(
            "hex ({}) ({}) simpleGrading ({})".format(
                *(" ".join(str(item) for item in items) for items in (corners, counts, expansions))
            )
        )

    def horizontal(level: int) -> Any:
        core = [grid.vertex(level, 0, corner) for corner in range(4)]
        rings = [
            [
                grid.vertex(level, circle, corner),
                grid.vertex(level, circle + 1, corner),
                grid.vertex(level, circle + 1, corner + 1),
                grid.vertex(level, circle, corner + 1),
            ]
            for circle in circles[:-1]
            for corner in range(4)
        ]
        return core, rings

    for level in levels[:-1]:
        below, above = horizontal(level), horizontal(level + 1)
        layer, stretch = grid.layer_cells[level], grid.layer_expansion[level]
        block(below[0] + above[0], (grid.per_quarter, grid.per_quarter, layer), (1, 1, stretch))
        for index, (low, high) in enumerate(zip(below[1], above[1])):
            ring = index // 4
            block(low + high, (grid.ring_cells[ring], grid.per_quarter, layer), (grid.ring_expansion[ring], 1, stretch))
        outer = circles[-1]
        side += [
            [
                grid.vertex(level, outer, corner),
                grid.vertex(level, outer, corner + 1),
                grid.vertex(level + 1, outer, corner + 1),
                grid.vertex(level + 1, outer, corner),
            ]
            for corner in range(4)
        ]
    for faces, level in ((floor, levels[0]), (top, levels[-1])):
        core, rings = horizontal(level)
        faces += [core] + rings

    def patch(name: str, faces: Any) -> str:
        listed = "\n".join("            (" + " ".join(map(str, face)) + ")" for face in faces)
        return f"    {name}\n    {{\n        type wall;\n        faces\n        (\n{listed}\n        );\n    }}"

    def section(name: str, lines: list[str]) -> str:
        return f"{name}\n(\n" + "\n".join("    " + line for line in lines) + "\n);\n\n"

    return (
        HEADER.format("blockMeshDict")
        + section("vertices", vertices)
        + section("blocks", blocks)
        + section("edges", arcs)
        + "boundary\n(\n"
        + "\n".join(patch(name, faces) for name, faces in (("tankFloor", floor), ("tankSide", side), ("tankTop", top)))
        + "\n);\n"
    )


def topo_set_dict(grid: Grid, p: dict[str, Any]) -> str:
    """Faces of the plate and of the cylinder, gathered in one zone."""
    thin = 1e-3 * p["cellSize"]
    # mid-chords and corners of the polygon lie on either side of the circle
    chord = cos(pi / grid.corners)
    inner = grid.radii[1] * chord * 0.999
    hopper, height = grid.radii[2], p["hopperHeight"]
    return (
        HEADER.format("topoSetDict")
        + f"""
actions
(
    // face centres between the orifice and the wall, in the plane of the orifice
    {{
        name hopperFaces; type faceSet; action new;
        source cylinderAnnulusToFace;
        p1 (0 0 {-thin:.9g}); p2 (0 0 {thin:.9g});
        innerRadius {inner:.9g}; outerRadius {hopper:.9g};
    }}
    // face centres on the cylinder
    {{
        name hopperFaces; type faceSet; action add;
        source cylinderAnnulusToFace;
        p1 (0 0 0); p2 (0 0 {height:.9g});
        innerRadius {hopper * chord - thin:.9g}; outerRadius {hopper * chord + thin:.9g};
    }}
    // face centres inside the cylinder, in the plane of its rim
    {{
        name lidFaces; type faceSet; action new;
        source cylinderToFace;
        p1 (0 0 {height - thin:.9g}); p2 (0 0 {height + thin:.9g});
        radius {hopper * chord - thin:.9g};
    }}
"""
        + "".join(
            f"""    {{
        name {name}Faces; type faceZoneSet; action new;
        source setToFaceZone; faceSet {name}Faces;
    }}
"""
            for name in baffles(p)
        )
        + ");\n"
    )


def baffles(p: dict[str, Any]) -> list[str]:
    """Names of the walls without thickness: each a patch, and a zone <name>Faces."""
    return ["hopper"] + ["lid"] * (p["lid"] == "on")


def create_baffles_dict(p: dict[str, Any]) -> str:
    return (
        HEADER.format("createBafflesDict")
        + """internalFacesOnly true;
noFields true;

baffles
{
"""
        + "".join(
            f"""    {name}Faces
    {{
        type        faceZone;
        zoneName    {name}Faces;
        patches
        {{
            master {{ name {name}; type wall; }}
            slave  {{ name {name}; type wall; }}
        }}
    }}
"""
            for name in baffles(p)
        )
        + "}\n"
    )


def main() -> None:
    only_count, source, case = read_options("hopperInTank", __doc__)
    p = parameter_file.parameters(source)
    problem = hopper_walls.check(p)
    if not problem and p["landHeight"] + p["bevelHeight"] + p["wallThickness"] > 0:
        problem = "landHeight, bevelHeight and wallThickness must be 0 with this mesh; hopperBySnappy can do more"
    if not problem and p.get("lid") not in ("on", "off"):
        problem = f"lid is '{p.get('lid')}'; allowed: on, off"
    if problem:
        sys.exit(f"hopperInTank: {source}: {problem}")

    grid = Grid(p)
    if only_count:
        print(grid.cells())
        return
    for name, text in (
        ("blockMeshDict", block_mesh_dict(grid)),
        ("topoSetDict", topo_set_dict(grid, p)),
        ("createBafflesDict", create_baffles_dict(p)),
    ):
        (case / "system" / name).write_text(text)

    (case / "system" / "meshSteps").write_text("blockMesh\ntopoSet\ncreateBaffles -overwrite\n")
    hopper_walls.write(hopper_walls.particle_walls(p), case / "DEM" / "meshes")


if __name__ == "__main__":
    main()
