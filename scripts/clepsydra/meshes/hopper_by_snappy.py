#!/usr/bin/python3
"""A flat-bottomed cylindrical hopper inside a square tank of water, meshed by snappyHexMesh.

Reads the dimensions and the level (meshLevel) from the dictionary PARAMETERS and writes, into CASE,
  constant/triSurface/hopper.stl, exit.stl                          surfaces of the hopper (hopper_walls.py)
  system/blockMeshDict, surfaceFeatureExtractDict, snappyHexMeshDict, meshQualityDict
                                                                    the fluid's mesh
  system/meshSteps                                                  the programs that make it
  DEM/meshes/hopperWall.stl, hopperPlate.stl, plug.stl              the particles' walls

The background is of nearly cubic cells; the planes of the plate and of the rim are planes of its faces. It is refined
in the hopper, near its walls and round the orifice. The tank is as wide as tankDiameter; the particles' tank is the
cylinder in it.

Patches: hopper (inside of cylinder and plate), exit (land, bevel and, of walls that are thick, the outside), tankFloor,
tankSide, tankTop. """

import sys
from math import pi
from typing import Any

from clepsydra import parameter_file
from clepsydra.meshes import hopper_walls
from clepsydra.meshes.generator import read_options
from clepsydra.meshes.hopper_walls import Triangle

# Size of the background's cells [m], and how often they are halved: in the hopper, near its walls, round the orifice
LEVELS = {
    "quick": (0.014, 1, 2, 2),
    "coarse": (0.010, 2, 2, 3),
    "medium": (0.0058, 2, 2, 3),
    "paper": (0.0037, 2, 3, 3),
}

HEADER = """// Written by meshes/hopperBySnappy: change the case's parameters instead.
FoamFile {{ version 2.0; format ascii; class dictionary; object {0}; }}

"""


def block_mesh_dict(p: dict[str, Any], size: float) -> str:
    half = p["tankDiameter"] / 2
    heights = [-p["tankDepth"], 0, p["hopperHeight"], p["hopperHeight"] + p["waterAboveRim"]]
    across = 2 * max(1, round(half / size))
    layers = [max(1, round((high - low) / size)) for low, high in zip(heights, heights[1:])]
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    vertices = "\n".join(f"    ({x * half:.9g} {y * half:.9g} {z:.9g})" for z in heights for x, y in corners)
    blocks = "\n".join(
        f"    hex ({' '.join(str(4 * layer + index) for index in range(8))}) ({across} {across} {count}) "
        "simpleGrading (1 1 1)"
        for layer, count in enumerate(layers)
    )
    sides = "\n".join(
        f"            ({4 * layer + corner} {4 * layer + (corner + 1) % 4} "
        f"{4 * layer + 4 + (corner + 1) % 4} {4 * layer + 4 + corner})"
        for layer in range(len(layers))
        for corner in range(4)
    )
    return (
        HEADER.format("blockMeshDict")
        + f"""vertices
(
{vertices}
);

blocks
(
{blocks}
);

boundary
(
    tankFloor {{ type wall; faces ((0 3 2 1)); }}
    tankTop   {{ type wall; faces ((12 13 14 15)); }}
    tankSide
    {{
        type wall;
        faces
        (
{sides}
        );
    }}
);
"""
    )


def surface_feature_extract_dict(surfaces: dict[str, list[Triangle]]) -> str:
    return HEADER.format("surfaceFeatureExtractDict") + "\n".join(
        f"""{name}.stl
{{
    extractionMethod    extractFromSurface;
    includedAngle       150;
    subsetFeatures
    {{
        nonManifoldEdges    yes;
        openEdges           yes;
    }}
}}
"""
        for name in surfaces
    )


def snappy_hex_mesh_dict(
    p: dict[str, Any], surfaces: dict[str, list[Triangle]], size: float, inside: int, walls: int, orifice: int
) -> str:
    hopper, height, radius = p["hopperDiameter"] / 2, p["hopperHeight"], p["orificeDiameter"] / 2
    levels = {"hopper": walls, "exit": orifice}
    geometry = "\n".join(f"    {name}.stl {{ type triSurfaceMesh; name {name}; }}" for name in surfaces)
    features = "\n".join(f'        {{ file "{name}.eMesh"; level {levels[name]}; }}' for name in surfaces)
    refined = "\n".join(
        f"        {name} {{ level ({levels[name]} {levels[name]}); patchInfo {{ type wall; }} }}" for name in surfaces
    )
    # two of the finest cells on either side of the walls
    near = 2 * size / 2**walls
    return (
        HEADER.format("snappyHexMeshDict")
        + f"""#includeEtc "caseDicts/mesh/generation/snappyHexMeshDict.cfg"

addLayers       false;

geometry
{{
{geometry}
    insideHopper
    {{
        type    searchableCylinder;
        point1  (0 0 0);
        point2  (0 0 {height:.9g});
        radius  {hopper:.9g};
    }}
    roundOrifice
    {{
        type    searchableCylinder;
        point1  (0 0 {-3 * radius:.9g});
        point2  (0 0 {3 * radius:.9g});
        radius  {2 * radius:.9g};
    }}
}}

castellatedMeshControls
{{
    nCellsBetweenLevels     2;
    // off the cells' faces
    locationInMesh          ({0.1234 * hopper:.9g} {0.0987 * hopper:.9g} {height + 0.4321 * p["waterAboveRim"]:.9g});

    features
    (
{features}
    );
    refinementSurfaces
    {{
{refined}
    }}
    refinementRegions
    {{
        insideHopper    {{ mode inside; levels ((1e15 {inside})); }}
        roundOrifice    {{ mode inside; levels ((1e15 {orifice})); }}
        hopper          {{ mode distance; levels (({near:.9g} {walls})); }}
    }}
}}

snapControls
{{
    explicitFeatureSnap     true;
    implicitFeatureSnap     false;
}}

mergeTolerance  1e-6;
"""
    )


def mesh_quality_dict() -> str:
    return (
        HEADER.format("meshQualityDict")
        + """#includeEtc "caseDicts/mesh/generation/meshQualityDict.cfg"
"""
    )


def cells(p: dict[str, Any], size: float, inside: int, walls: int, orifice: int) -> float:
    """About how many: within 30 % of the four levels of the paper's hopper (README.md)."""
    radius, height, mouth = p["hopperDiameter"] / 2, p["hopperHeight"], p["orificeDiameter"] / 2
    tank = p["tankDiameter"] ** 2 * (p["tankDepth"] + height + p["waterAboveRim"])
    near_walls = (2 * pi * radius * height + pi * radius**2) * 2 * 2 * size / 2**walls
    round_orifice = pi * (2 * mouth) ** 2 * 6 * mouth
    return (
        tank + pi * radius**2 * height * 8**inside + near_walls * 8**walls + round_orifice * 8**orifice
    ) / size**3


def main() -> None:
    only_count, source, case = read_options("hopperBySnappy", __doc__)
    p = parameter_file.parameters(source)
    problem = hopper_walls.check(p)
    if not problem and p.get("meshLevel") not in LEVELS:
        problem = f"meshLevel is '{p.get('meshLevel')}'; allowed: {', '.join(LEVELS)}"
    if not problem and p.get("lid") != "off":
        problem = f"lid is '{p.get('lid')}'; allowed with this mesh: off"
    if problem:
        sys.exit(f"hopperBySnappy: {source}: {problem}")

    if only_count:
        print(round(cells(p, *LEVELS[p["meshLevel"]])))
        return
    surfaces, (size, *levels) = hopper_walls.water_walls(p), LEVELS[p["meshLevel"]]
    hopper_walls.write(surfaces, case / "constant" / "triSurface")
    hopper_walls.write(hopper_walls.particle_walls(p), case / "DEM" / "meshes")
    for name, text in (
        ("blockMeshDict", block_mesh_dict(p, size)),
        ("surfaceFeatureExtractDict", surface_feature_extract_dict(surfaces)),
        ("meshQualityDict", mesh_quality_dict()),
        ("snappyHexMeshDict", snappy_hex_mesh_dict(p, surfaces, size, *levels)),
    ):
        (case / "system" / name).write_text(text)
    (case / "system" / "meshSteps").write_text("blockMesh\nsurfaceFeatureExtract\nsnappyHexMesh -overwrite\n")


if __name__ == "__main__":
    main()
