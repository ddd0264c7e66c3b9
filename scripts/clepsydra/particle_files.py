"""Particles that a case has written for ParaView (VTK/particles.pvd)."""

from pathlib import Path
from typing import Any, Mapping
from xml.etree import ElementTree

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy


def written_times(case: Path) -> dict[float, Path]:
    """{time: file} of the case's particles."""
    collection = case / "VTK" / "particles.pvd"
    if not collection.exists():
        raise SystemExit(f"{collection}: there is no such file: was the run made with drawParticles off?")
    return {
        float(item.attrib["timestep"]): collection.parent / item.attrib["file"]
        for item in ElementTree.parse(collection).iter("DataSet")
    }


def time_nearest(times: Mapping[float, Any], wanted: float | None) -> float:
    """The written time nearest to the wanted one; the last, where that is None."""
    if wanted is None:
        return max(times)
    return min((abs(written - wanted), written) for written in times)[1]


def read_particles(file: Path) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions, radii and velocities; of a run on several ranks the particles of one rank after those of the other."""
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    particles = reader.GetOutput()
    data = particles.GetPointData()
    return (
        vtk_to_numpy(particles.GetPoints().GetData()),
        vtk_to_numpy(data.GetArray("radius")),
        vtk_to_numpy(data.GetArray("velocity")),
    )
