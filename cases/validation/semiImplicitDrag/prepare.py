#!/usr/bin/python3
"""In a run: what its water does at first, where the particles are, and their drag."""

import argparse
from pathlib import Path
from typing import Any

from layer import Layer

HEADER = "FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n"


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
        properties.write(Path("constant/more").read_text())


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
