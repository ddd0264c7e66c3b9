"""Particles and water of a case in its middle plane, and beside them the mass in the hopper against time: of
renderFlow and movie."""

import sys
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import vtk
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.figure import Figure
from vtk.util.numpy_support import vtk_to_numpy

from clepsydra import case_files, foam_mesh, parameter_file, particle_files, picture_style
from clepsydra.picture_style import pyplot

POINTS = 160  # of the grid on which the water is drawn, across
OBSERVABLES = {
    "massInHopper": ("mass in the hopper [g]", "what a scale reads"),
    "particleHeight": ("height of the particle [mm]", ""),
}


class View:
    """A part of the plane y = 0 in m, with the walls in it. Left alone, a hopper and the water below it, or the whole
    mesh."""

    def __init__(self, case: Path, extent: tuple[float, float, float, float] | list[float] | None = None) -> None:
        _, patches = foam_mesh.read(case)
        self.walls = [line for patch in patches.values() for line in walls_of(patch)]
        if not self.walls:
            sys.exit(f"{case}: the plane y = 0, which is drawn, does not cut its mesh")
        self.x0, self.x1, self.z0, self.z1 = extent or hoppers_extent(case) or whole_extent(self.walls)
        self.x = np.linspace(self.x0, self.x1, POINTS)
        self.z = np.linspace(self.z0, self.z1, max(2, int(POINTS * self.height / self.width)))

    @property
    def width(self) -> float:
        return self.x1 - self.x0

    @property
    def height(self) -> float:
        return self.z1 - self.z0

    def shows(self, position: np.ndarray) -> np.ndarray:
        return (
            (position[:, 0] > self.x0)
            & (position[:, 0] < self.x1)
            & (position[:, 2] > self.z0)
            & (position[:, 2] < self.z1)
        )


def walls_of(patch: vtk.vtkPolyData) -> list[list[list[float]]]:
    """The lines in which the plane y = 0 cuts a patch: pairs of (x, z) in m."""
    plane = vtk.vtkPlane()
    # not in the faces of a mesh that has some at y = 0
    plane.SetOrigin(0, 1e-7, 0)
    plane.SetNormal(0, 1, 0)
    lines = foam_mesh.cut(patch, plane)
    return [
        [[lines.GetCell(cell).GetPoints().GetPoint(end)[axis] for axis in (0, 2)] for end in (0, 1)]
        for cell in range(lines.GetNumberOfCells())
    ]


def hoppers_extent(case: Path) -> tuple[float, float, float, float] | None:
    """From well below its orifice to its rim."""
    if not (case / "parameters").exists():
        return None
    p = parameter_file.parameters(case / "parameters")
    if "hopperDiameter" not in p:
        return None
    half = 0.8 * p["hopperDiameter"]
    return -half, half, -half, p["hopperHeight"]


def whole_extent(walls: Any) -> tuple[float, float, float, float]:
    points = np.reshape(walls, (-1, 2))
    (x0, z0), (x1, z1) = points.min(axis=0), points.max(axis=0)
    edge = 0.02 * max(x1 - x0, z1 - z0)
    return x0 - edge, x1 + edge, z0 - edge, z1 + edge


class Moment:
    """What is drawn of one written time."""

    def __init__(self, case: Path, view: View, at: float, particles: Path, folder: str | None) -> None:
        """particles, folder: of writtenTimes()."""
        self.at = at
        self.position, self.radius, velocity = particle_files.read_particles(particles)
        self.speed = np.linalg.norm(velocity, axis=1)
        self.across, self.up = water(case, folder, view) if folder else (None, None)

    def fastest_particle(self, view: View) -> float:
        """The fastest few of a crowd do not count: one that bounces would take the colours from all others."""
        seen = self.speed[view.shows(self.position)]
        return np.percentile(seen, 99) if len(seen) else 0

    def fastest_water(self) -> float:
        return 0 if self.across is None or self.up is None else np.nanmax(np.hypot(self.across, self.up))


def field_times(case: Path) -> dict[float, str]:
    """Folders with U by their times; none in a run without water. What it began with is no field of the solver's."""
    times = {float(name): name for name in case_files.times(case) if (case / name / "U").exists()}
    if not times and case_files.is_divided(case, "U"):
        sys.exit(f"there is no U in {case}; after a run on several ranks: reconstructPar")
    return times


def written_times(case: Path) -> dict[float, tuple[Path, str | None]]:
    """{time: (file of particles, folder with U or None)}: in a run with water the times of which both are there."""
    fields, particles = field_times(case), particle_files.written_times(case)
    # a folder's name has fewer digits than the particles' time
    named = {at: next((name for time, name in fields.items() if abs(time - at) <= 1e-6 * at), None) for at in particles}
    return {at: (file, named[at]) for at, file in particles.items() if named[at] or not fields}


def water(case: Path, time: str, view: View) -> tuple[np.ndarray, np.ndarray]:
    """Velocity in x and z at the points of the view's grid; NaN outside of the mesh. Arrays of rows at one height."""
    cells, _ = foam_mesh.read(case, time)
    grid = vtk.vtkStructuredGrid()
    points = vtk.vtkPoints()
    for height in view.z:
        for across in view.x:
            points.InsertNextPoint(across, 0, height)
    grid.SetDimensions(len(view.x), len(view.z), 1)
    grid.SetPoints(points)
    probe = vtk.vtkProbeFilter()
    probe.SetInputData(grid)
    probe.SetSourceData(cells)
    probe.Update()
    data = probe.GetOutput().GetPointData()
    velocity = vtk_to_numpy(data.GetArray("U")).astype(float).reshape(len(view.z), len(view.x), 3)
    velocity[vtk_to_numpy(data.GetArray("vtkValidPointMask")).reshape(len(view.z), len(view.x)) == 0] = np.nan
    return velocity[:, :, 0], velocity[:, :, 2]


def observable(case: Path) -> tuple[str, str, np.ndarray, np.ndarray] | None:
    """What stands beside the particles: label, title, times, values. None where the case writes none of them."""
    for name, (label, title) in OBSERVABLES.items():
        if case_files.start_directories(case, name):
            time, value = case_files.columns(case, name)[:2]
            return label, title, time, 1e3 * value
    return None


def draw(
    case: Path, view: View, moment: Moment, fastest_particle: float, fastest_water: float, height: float = 6.2
) -> Figure:
    """A figure of this height in inches: the plane, and beside it what a scale reads."""
    beside = observable(case)
    wide = height * (view.width / view.height) + (1.4 if moment.across is None else 2.6)
    figure = pyplot.figure(figsize=(wide + (4.4 if beside else 0), height), constrained_layout=True)
    panels = figure.subplots(1, 2, gridspec_kw={"width_ratios": (wide, 4.4)}) if beside else (figure.subplots(),)
    draw_plane(figure, panels[0], case, view, moment, fastest_particle, fastest_water)
    if beside:
        label, title, time, value = beside
        until = time <= moment.at
        panels[1].plot(time, value, color="0.8")
        panels[1].plot(time[until], value[until], color=picture_style.LINE)
        panels[1].plot(moment.at, np.interp(moment.at, time, value), "o", color=picture_style.MARK)
        panels[1].set(xlabel="time [s]", ylabel=label, xlim=(0, None), ylim=(0, None), title=title)
        panels[1].grid(alpha=0.3)
    return figure


def draw_cases(cases: list[Path], views: list[View], moments: list[Moment], height: float = 6.2) -> Figure:
    """A figure with the planes of several cases side by side, all in the same colours."""
    fastest_particle = max(moment.fastest_particle(view) for moment, view in zip(moments, views))
    fastest_water = max(moment.fastest_water() for moment in moments)
    widths = [
        height * (view.width / view.height) + (1.4 if moment.across is None else 2.6)
        for moment, view in zip(moments, views)
    ]
    figure = pyplot.figure(figsize=(sum(widths), height), constrained_layout=True)
    panels = figure.subplots(1, len(cases), squeeze=False, gridspec_kw={"width_ratios": widths})[0]
    for axes, case, view, moment in zip(panels, cases, views, moments):
        draw_plane(figure, axes, case, view, moment, fastest_particle, fastest_water)
    return figure


def draw_plane(
    figure: Figure, axes: Axes, case: Path, view: View, moment: Moment, fastest_particle: float, fastest_water: float
) -> None:
    """Particles, water and walls, and the bars of their colours."""
    if moment.across is not None and moment.up is not None:
        x, z = 1e3 * view.x, 1e3 * view.z
        shown = axes.pcolormesh(
            x,
            z,
            np.hypot(moment.across, moment.up),
            cmap=picture_style.WATER,
            vmin=0,
            vmax=fastest_water or 1,
            shading="auto",
            rasterized=True,
        )
        if fastest_water:
            axes.streamplot(
                x,
                z,
                moment.across,
                moment.up,
                color=picture_style.STREAMLINES,
                linewidth=0.6,
                arrowsize=0.7,
                density=1.2,
                zorder=1,
            )
        figure.colorbar(shown, ax=axes, location="right", shrink=0.7, label="water [m/s]")
    circles = draw_particles(axes, view, moment, fastest_particle or 1)
    axes.add_collection(LineCollection(1e3 * np.array(view.walls), colors="black", linewidths=2, zorder=4))
    axes.set(
        xlim=(1e3 * view.x0, 1e3 * view.x1),
        ylim=(1e3 * view.z0, 1e3 * view.z1),
        aspect="equal",
        xlabel="x [mm]",
        ylabel="height [mm]",
        title=f"{case.resolve().name}, t = {moment.at:.2f} s",
    )
    figure.colorbar(circles, ax=axes, location="right", shrink=0.7, label="particles [m/s]", extend="max")


def draw_particles(axes: Axes, view: View, moment: Moment, fastest: float) -> Any:
    """Whole spheres, of the particles that the plane cuts, the farthest first. Returns what a colour bar is made of."""
    cut = np.flatnonzero((np.abs(moment.position[:, 1]) < moment.radius) & view.shows(moment.position))
    cut = cut[np.argsort(-moment.position[cut, 1])]
    colours = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(0, fastest), picture_style.PARTICLES)
    position, radius = 1e3 * moment.position[cut][:, [0, 2]], 1e3 * moment.radius[cut, None]
    # each sphere and its gleam, one after the other: a gleam must not shine through the particle before it
    offsets = np.stack([position, position + radius * (-0.3, 0.35)], axis=1).reshape(-1, 2)
    widths = (radius * (2, 0.6)).ravel()
    faces = np.stack([colours.to_rgba(moment.speed[cut]), np.tile((1, 1, 1, 0.55), (len(cut), 1))], axis=1).reshape(
        -1, 4
    )
    edges = np.tile([(0.25, 0.25, 0.25, 1), (0, 0, 0, 0)], (len(cut), 1))
    axes.add_collection(
        EllipseCollection(
            widths,
            widths,
            np.zeros(len(widths)),
            units="xy",
            offsets=offsets,
            transOffset=axes.transData,
            facecolors=faces,
            edgecolors=edges,
            linewidths=0.4,
            zorder=3,
        )
    )
    return colours
