"""Beads that a case has written for ParaView (VTK/beads.pvd)."""

from xml.etree import ElementTree

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy


def writtenTimes(case):
    """{time: files} of the case's beads; a parallel run may write several files a time."""
    collection = case / "VTK" / "beads.pvd"
    times = {}
    for item in ElementTree.parse(collection).iter("DataSet"):
        files = times.setdefault(float(item.get("timestep")), [])
        files.append(collection.parent / item.get("file"))
    return times


def timeNearest(times, wanted):
    """The written time nearest to the wanted one; the last, where that is None."""
    return max(times) if wanted is None else min(times, key=lambda written: abs(written - wanted))


def readBeads(files):
    """Positions, radii and velocities."""
    parts = []
    for file in files:
        reader = (vtk.vtkXMLPPolyDataReader() if file.suffix == ".pvtp"
                  else vtk.vtkXMLPolyDataReader())
        reader.SetFileName(str(file))
        reader.Update()
        beads = reader.GetOutput()
        if beads.GetNumberOfPoints():
            data = beads.GetPointData()
            parts.append((vtk_to_numpy(beads.GetPoints().GetData()),
                          vtk_to_numpy(data.GetArray("radius")),
                          vtk_to_numpy(data.GetArray("velocity"))))
    return tuple(np.concatenate(column) for column in zip(*parts))
