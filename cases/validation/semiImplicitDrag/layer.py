#!/usr/bin/python3
"""The layer of cells with a particle in the middle of each, as the run's parameters have it. As a program, in a run, it
writes what its water does at first, where the particles are, and their drag."""

import argparse
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra.column import Column

# Small enough for convection to be nothing, and for free particles to stay in their cells.
SPEED = {"wave": 1e-3, "vortex": 1e-3, "uniform": 0.05}
HEADER = "FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n"
# Takes the place of the column's
DRAG = """
forceModels             ( StokesDrag noPressureGradient noViscousStress noBuoyancy );

StokesDragProps
{
    #include "drag"
}
"""


class Layer(Column):
    @property
    def cell_width(self) -> Any:
        return self["width"] / self["cellsAcross"]

    def centres(self) -> list[tuple[Any, Any, Any]]:
        """Of the cells, x fastest [m]."""
        up, across = int(self["cellsUp"]), int(self["cellsAcross"])
        return [
            ((i + 0.5) * self.cell_width, 0.5 * self.cell_width, (k + 0.5) * self["height"] / up)
            for k in range(up)
            for i in range(across)
        ]

    def velocity(self, start: Any) -> Any:
        x, _, z = np.array(self.centres()).T
        zero, x, z = 0 * x, np.pi * x / self["width"], np.pi * z / self["height"]
        return SPEED[start] * np.column_stack(
            {
                "wave": (zero, zero, np.cos(x)),
                "vortex": (np.sin(x) * np.cos(z), zero, -np.cos(x) * np.sin(z)),
                "uniform": (zero, zero, zero + 1),
            }[start]
        )

    @property
    def water_mass(self) -> Any:
        """In a cell [kg]."""
        return self["fluidDensity"] * (self.cell_width**2 * self["height"] / self["cellsUp"] - self.particle_volume)

    @property
    def particle_mass(self) -> Any:
        return self["particleDensity"] * self.particle_volume

    def drag_factor(self, drag_time: Any) -> Any:
        """By which Stokes' drag is K couplingTimeStep/waterMass = dragTime."""
        stokes = 3 * np.pi * self["fluidDensity"] * self["fluidViscosity"] * self["particleDiameter"]
        return drag_time * self.water_mass / self["couplingTimeStep"] / stokes

    def left_by_smoothing(self) -> Any:
        """Of the wave's amplitude: it is an eigenvector of the cells' Laplacian."""
        eigenvalue = 2 * (1 - np.cos(np.pi / self["cellsAcross"])) / self.cell_width**2
        return np.exp(-self["smoothingBandwidth"] ** 2 / 4 * eigenvalue)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "start",
        choices=("wave", "vortex", "uniform"),
        help="wave: up and down, a cosine across, through open ends; vortex: closed; uniform: up, through open ends",
    )
    parser.add_argument("motion", choices=("held", "free"))
    parser.add_argument("drag_time", type=float, help="K couplingTimeStep over the water's mass")
    given = parser.parse_args()
    start, motion, drag_time = given.start, given.motion, given.drag_time
    layer = Layer(".")
    closed = start == "vortex"
    write_field(
        "U", "volVectorField", "[0 1 -1 0 0 0 0]", layer.velocity(start), "slip" if closed else "zeroGradient", "slip"
    )
    write_field(
        "p", "volScalarField", "[0 2 -2 0 0 0 0]", None, "zeroGradient" if closed else "fixedValue", "zeroGradient"
    )
    Path("DEM/in.particles").write_text(
        "".join(f"create_atoms 1 single {x:.15g} {y:.15g} {z:.15g} units box\n" for x, y, z in layer.centres())
        + ("fix motion all nve/sphere\n" if motion == "free" else "")
    )
    Path("constant/drag").write_text(f"factor {layer.drag_factor(drag_time):.15g};\n")
    with open("constant/couplingProperties", "a") as properties:
        properties.write(DRAG)


def write_field(name: str, kind: Any, dimensions: Any, values: Any, ends: Any, sides: Any) -> None:
    inside = (
        "uniform 0"
        if values is None
        else (
            f"nonuniform List<vector>\n{len(values)}\n(\n"
            + "\n".join("({:.15g} {:.15g} {:.15g})".format(*value) for value in values)
            + "\n)\n"
        )
    )
    Path("0", name).write_text(
        HEADER.format(kind=kind, name=name)
        + f"dimensions {dimensions};\ninternalField {inside};\nboundaryField\n{{\n"
        + f'    "bottom|top" {{ type {ends}; value $internalField; }}\n'.replace(
            " value $internalField;", " value uniform 0;" if ends == "fixedValue" else ""
        )
        + f"    sides {{ type {sides}; }}\n}}\n"
    )


if __name__ == "__main__":
    main()
