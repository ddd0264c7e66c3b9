"""Meshes and velocities of a case, read by VTK."""

import tempfile
from pathlib import Path
from typing import Any

import vtk

CONTROL = (
    "FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }\n"
    "startFrom startTime; startTime 0; endTime 1; deltaT 1; writeFormat ascii; writeInterval 1;\n"
)


def read(case: Path, time: Any = None, polyhedra: str = "decomposed") -> tuple[Any, dict[str, Any]]:
    """The cells, with U where a time is given, and the patches by name.

    polyhedra "whole": as they are, which is quicker and is drawn rightly where no cell is cut."""
    with tempfile.TemporaryDirectory() as name:
        # the reader wants a plain controlDict, and would take the case's own times and macros for its own
        folder = Path(name)
        for part in ("system", "constant", "0", "1"):
            (folder / part).mkdir()
        (folder / "system/controlDict").write_text(CONTROL)
        (folder / "mesh.foam").touch()
        (folder / "constant/polyMesh").symlink_to((Path(case) / "constant/polyMesh").resolve())
        if time is not None:
            (folder / "1/U").symlink_to((Path(case) / time / "U").resolve())
        reader = vtk.vtkOpenFOAMReader()
        reader.SetFileName(str(folder / "mesh.foam"))
        if polyhedra == "whole":
            reader.DecomposePolyhedraOff()
        reader.UpdateInformation()
        reader.EnableAllPatchArrays()
        if time is not None:
            reader.SetTimeValue(1)
        reader.Update()
        blocks = reader.GetOutput()
    cells, patches = None, {}
    walk = blocks.NewIterator()
    while not walk.IsDoneWithTraversal():
        data = walk.GetCurrentDataObject()
        if data.IsA("vtkUnstructuredGrid"):
            cells = data
        else:
            patches[walk.GetCurrentMetaData().Get(vtk.vtkCompositeDataSet.NAME())] = data
        walk.GoToNextItem()
    return cells, patches


def cut(data: Any, plane: Any) -> Any:
    """What a plane cuts of a mesh's cells or of a patch."""
    cutter = vtk.vtkCutter()
    cutter.SetCutFunction(plane)
    cutter.SetInputData(data)
    cutter.Update()
    return cutter.GetOutput()
