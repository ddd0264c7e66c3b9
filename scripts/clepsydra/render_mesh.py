#!/usr/bin/python3
"""Picture of a case's mesh: the cells behind the plane y = 0 and the walls in it, the whole on the left and the orifice
on the right."""

import argparse
from pathlib import Path
from typing import Any

import numpy as np
import vtk
from matplotlib.collections import LineCollection, PolyCollection
from vtk.util.numpy_support import vtk_to_numpy

from clepsydra import flow_drawing, foam_mesh, parameter_file, picture_style
from clepsydra.picture_style import pyplot

WALLS = ("hopper", "exit")


def faces_seen(cells: Any) -> list[np.ndarray]:
    """Corners of the faces that one sees from the front where only the cells behind the plane are there, the farthest
    first, in mm."""
    plane = vtk.vtkPlane()
    # before the cells' faces, which lie in y = 0
    plane.SetOrigin(0, -1e-4, 0)
    plane.SetNormal(0, 1, 0)
    behind = vtk.vtkExtractGeometry()
    behind.SetImplicitFunction(plane)
    behind.SetInputData(cells)
    behind.ExtractInsideOff()
    behind.ExtractBoundaryCellsOff()  # whole cells: cut ones of many faces are drawn wrongly
    surface = vtk.vtkGeometryFilter()
    surface.SetInputConnection(behind.GetOutputPort())
    surface.Update()
    faces = surface.GetOutput()
    points = 1e3 * vtk_to_numpy(faces.GetPoints().GetData()).astype(float)
    ends = vtk_to_numpy(faces.GetPolys().GetOffsetsArray())
    corners = np.split(points[vtk_to_numpy(faces.GetPolys().GetConnectivityArray())], ends[1:-1])
    front = [face for face in corners if abs(np.cross(face[2] - face[0], face[1] - face[0])[1]) > 0]
    return [face[:, [0, 2]] for face in sorted(front, key=lambda face: -face[:, 1].mean())]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", type=Path, metavar="CASE")
    parser.add_argument("picture", type=Path, metavar="PICTURE")
    given = parser.parse_args()
    case, picture = given.case, given.picture
    p = parameter_file.parameters(case / "parameters")
    cells, patches = foam_mesh.read(case, polyhedra="whole")
    faces = faces_seen(cells)
    walls = [line for name in WALLS if name in patches for line in flow_drawing.walls_of(patches[name])]
    top, bottom, half = (
        1e3 * (p["hopperHeight"] + p["waterAboveRim"]),
        -1e3 * p["tankDepth"],
        1.02 * max(np.abs(face[:, 0]).max() for face in faces),
    )
    near = 1.5e3 * p["orificeDiameter"]

    figure, panels = pyplot.subplots(1, 2, figsize=(11, 8), constrained_layout=True)
    for axes, (x, z), title, thick in zip(
        panels,
        (((-half, half), (bottom, top)), ((-near, near), (-near, near))),
        (f"{cells.GetNumberOfCells():,} cells", "the orifice"),
        (0.25, 0.6),
    ):
        seen = [face for face in faces if inside(face, x, z)]
        axes.add_collection(
            PolyCollection(seen, facecolors=picture_style.CELL, edgecolors=picture_style.CELL_EDGE, linewidths=thick)
        )
        axes.add_collection(LineCollection(1e3 * np.array(walls), colors=picture_style.MARK, linewidths=2))
        axes.set(xlim=x, ylim=z, aspect="equal", xlabel="x [mm]", ylabel="height [mm]", title=title)
    picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(picture, dpi=picture_style.DPI)
    print(f"{picture}: {cells.GetNumberOfCells()} cells")


def inside(face: np.ndarray, x: tuple[float, float], z: tuple[float, float]) -> bool:
    (x0, z0), (x1, z1) = face.min(axis=0), face.max(axis=0)
    return x1 > x[0] and x0 < x[1] and z1 > z[0] and z0 < z[1]


if __name__ == "__main__":
    main()
