#!/usr/bin/python3
"""Terminal velocities of the runs against the law that each used, and against what particles do."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, closures, parameter_file, validation
from clepsydra.picture_style import pyplot

YARDSTICK = "BrownLawlerDrag"
# The hopper paper, arXiv 1703.09584, Table I: Re = v d/nu, by its diameter [mm]
TABLE_I_REYNOLDS = {0.5: 37, 1: 151, 2: 530}
# What the solver owes to the law: it has no other model in it
OF_THE_LAW = 2
# What a law owes to particles: scatter of the measurements that the fits rest on
OF_THE_PARTICLES = 5
SLOW = (
    "Di Felice's law has Dallavalle's C_d of the isolated particle, 13 to 27 % above the measured at Re 37 to 530: "
    "the hopper paper's own drag law is 8 to 13 % slow on its own particles"
)


def main() -> None:
    found = sorted((fall(run) for run in Path("runs").iterdir()), key=lambda one: (one["diameter"], one["law"]))
    validation.write([row for one in found for row in rows(one)])
    plot(found)


def fall(run: Any) -> dict[str, Any]:
    """Mean velocity over the last eighth of the run, one relaxation time, and its standard deviation there."""
    p = parameter_file.parameters(run / "parameters")
    time, _, velocity = case_files.columns(run, "particleHeight")
    last = -velocity[time > 7 / 8 * time[-1]]
    particle = {name: p[name] for name in ("particleDiameter", "particleDensity", "fluidDensity", "fluidViscosity")}
    by_law = {law: closures.value("terminalVelocity", dragLaw=law, **particle) for law in (p["dragLaw"], YARDSTICK)}
    diameter = 1e3 * p["particleDiameter"]
    return {
        "law": p["dragLaw"].removesuffix("Drag"),
        "diameter": diameter,
        "ours": last.mean(),
        "scatter": last.std(),
        "own": by_law[p["dragLaw"]],
        "yardstick": by_law[YARDSTICK],
        "tableI": TABLE_I_REYNOLDS[diameter] * p["fluidViscosity"] / p["particleDiameter"],
    }


def rows(one: Any) -> Any:
    name = f"{one['law']}, d {one['diameter']:g} mm"
    slow = SLOW if one["law"] == "DiFelice" else None

    def row(
        reference: Any, against: Any, source: Any, kind: Any, error: Any, tolerance: float, finding: Any = None
    ) -> Any:
        return validation.row(
            f"{name}, against {against}",
            "m/s",
            reference,
            source,
            kind,
            one["ours"],
            float(np.hypot(one["scatter"], error)),
            tolerance,
            finding,
            one["scatter"],
        )

    found = [row(one["own"], "the law itself", "closures terminalVelocity", "computed", 0, OF_THE_LAW)]
    if one["law"] != "BrownLawler":
        found.append(
            row(
                one["yardstick"],
                "Brown-Lawler",
                "Brown & Lawler 2003, fit to 480 measured spheres",
                "computed",
                0.02 * one["yardstick"],
                OF_THE_PARTICLES,
                slow,
            )
        )
    # Re is printed with two to three digits: half a unit of the last one
    found.append(
        row(
            one["tableI"],
            "Table I",
            "arXiv 1703.09584, Table I, Re",
            "computed",
            0.5 / TABLE_I_REYNOLDS[one["diameter"]] * one["tableI"],
            OF_THE_PARTICLES,
            slow,
        )
    )
    return found


def plot(found: Any) -> None:
    diameters = np.geomspace(0.3, 3, 40)
    particle = {"particleDensity": 2540, "fluidDensity": 1000, "fluidViscosity": 1e-6}

    def fall(law: Any, diameter: Any) -> Any:
        return closures.value("terminalVelocity", dragLaw=law, particleDiameter=1e-3 * diameter, **particle)

    yardstick = np.array([fall(YARDSTICK, diameter) for diameter in diameters])
    for number, law in enumerate(sorted({one["law"] for one in found})):
        curve = [fall(f"{law}Drag", diameter) for diameter in diameters]
        pyplot.plot(diameters, curve / yardstick, f"C{number}-", label=f"{law}, the law")
        ours = [one for one in found if one["law"] == law]
        pyplot.plot(
            [one["diameter"] for one in ours],
            [one["ours"] / one["yardstick"] for one in ours],
            f"C{number}o",
            label=f"{law}, run",
        )
    pyplot.errorbar(
        list(TABLE_I_REYNOLDS),
        [re * 1e-3 / d / fall(YARDSTICK, d) for d, re in TABLE_I_REYNOLDS.items()],
        [0.5e-3 / d / fall(YARDSTICK, d) for d in TABLE_I_REYNOLDS],
        fmt="k+",
        ms=12,
        label="Table I",
    )
    pyplot.xscale("log")
    pyplot.xticks([0.3, 0.5, 1, 2, 3], ["0.3", "0.5", "1", "2", "3"])
    pyplot.xlabel("particle diameter [mm]")
    pyplot.ylabel("terminal velocity over Brown & Lawler's")
    pyplot.legend(fontsize=8)
    pyplot.savefig("results/terminalVelocity.png", dpi=150)


if __name__ == "__main__":
    main()
