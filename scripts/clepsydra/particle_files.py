"""Particles that a case has written for ParaView (VTK/particles.pvd)."""

from xml.etree import ElementTree

import vtk
from vtk.util.numpy_support import vtk_to_numpy


def written_times(case):
    """{time: file} of the case's particles."""
    collection = case / "VTK" / "particles.pvd"
    if not collection.exists():
        raise SystemExit(f"{collection}: there is no such file: was the run made with drawParticles off?")
    return {
        float(item.get("timestep")): collection.parent / item.get("file")
        for item in ElementTree.parse(collection).iter("DataSet")
    }


def time_nearest(times, wanted):
    """The written time nearest to the wanted one; the last, where that is None."""
    return max(times) if wanted is None else min(times, key=lambda written: abs(written - wanted))


def read_particles(file):
    """Positions, radii and velocities; of a run on several ranks the particles of one rank after those of the other."""
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    particles = reader.GetOutput()
    data = particles.GetPointData()
    return tuple(
        vtk_to_numpy(array)
        for array in (particles.GetPoints().GetData(), data.GetArray("radius"), data.GetArray("velocity"))
    )
