"""Our way to run the particles against stock LIGGGHTS: mesh walls, every particle integrated, half the step."""

from typing import Any

from developers.benchmarks.hopper import Hopper

from . import timing

STOCK_STEP = 2e-5


def dem_over_stock_liggghts(hopper: Hopper, repetitions: int) -> timing.Figure:
    duration = 0.3
    ours = hopper.run("dry", "ours", duration)
    folder = ours.folder
    (folder / "in.stock").write_text(script(hopper, duration))
    times = timing.interleaved(
        {
            "stock": timing.Run(liggghts("stock"), folder),
            "ours": ours,
        },
        repetitions,
    )
    return timing.processor_ratio(
        times,
        "stock",
        "ours",
        ">= 2.5",
        f"processor time of stock LIGGGHTS, mesh walls, dt 2e-5 s, over ours; first {duration} s of the discharge",
    )


def liggghts(name: str) -> list[str]:
    """The command that runs in.<name> and logs in log.<name>."""
    return ["liggghts", "-in", f"in.{name}", "-screen", "/dev/null", "-log", f"log.{name}"]


def script(hopper: Hopper, duration: Any) -> str:
    """A LIGGGHTS script as its tutorials write it, for the packing that the case filled."""
    p = hopper.parameters

    def per_material(name: str, count: int) -> str:
        return " ".join([str(p[name])] * count)

    return f"""atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
neighbor {0.3 * p["particleDiameter"]} bin
neigh_modify delay 0
read_restart {hopper.packing}
fix youngs all property/global youngsModulus peratomtype {per_material("youngsModulus", 3)}
fix poisson all property/global poissonsRatio peratomtype {per_material("poissonRatio", 3)}
fix restitution all property/global coefficientRestitution peratomtypepair 3 {per_material("restitution", 9)}
fix friction all property/global coefficientFriction peratomtypepair 3 {per_material("friction", 9)}
pair_style gran model hertz tangential history
pair_coeff * *
timestep {STOCK_STEP}
fix gravity all gravity 9.81 vector 0 0 -1
fix cylinder all mesh/surface file DEM/meshes/hopperWall.stl type 2
fix plate all mesh/surface file DEM/meshes/hopperPlate.stl type 3
fix hopper all wall/gran model hertz tangential history mesh n_meshes 2 meshes cylinder plate
fix tankFloor all wall/gran model hertz tangential history primitive type 2 zplane -{p["tankDepth"]}
fix tankSide all wall/gran model hertz tangential history primitive type 2 zcylinder {p["tankDiameter"] / 2} 0 0
fix motion all nve/sphere
thermo 10000
run {round(duration / STOCK_STEP)}
"""
