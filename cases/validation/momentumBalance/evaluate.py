#!/usr/bin/python3
"""The conservation check's momentum error, the momentum balance of the whole column from what was written, and the
faults found."""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, validation
from clepsydra.column import Column

# Sums of some thousand numbers over twenty intervals
ROUNDING_PERCENT = 1e-10
# The pressure is corrected twice in an interval, not until nothing changes: what that leaves of the momentum equation.
PRESSURE_CORRECTION_PERCENT = 0.2
BALANCES = {
    "MomentumBalance": "momentum",
    "SolidVolumeBalance": "solid volume",
    "PressureForceBalance": "pressure force",
    "ClosedTank": "continuity",
}


def main() -> None:
    runs = sorted(Path("runs").iterdir())
    validation.write([row for run in runs for row in of_run(run)] + of_faults(Path("results/faults.json")))


def of_run(run: Any) -> list[Any]:
    name = run.name
    summary = json.loads((run / "postProcessing/conservation/0/summary.json").read_text())
    force, gained = balance(run)
    print(
        f"{name}: momentum error {summary['momentumError']:.1e}, pressure force error "
        f"{summary['pressureForceError']:.1e}; momentum gained / impulse of weight, buoyancy and pressure "
        f"{gained / force:.5f}"
    )
    one = [
        (
            f"{what}, {name}",
            "-",
            1,
            "the conservation check",
            "computed",
            1 + summary[entry],
            ROUNDING_PERCENT / 100,
            ROUNDING_PERCENT,
        )
        for what, entry in (
            ("momentum that the fluid lost over what the particles received", "momentumError"),
            ("pressure force on the particles over its reaction", "pressureForceError"),
        )
    ]
    return [validation.row(*found) for found in one] + [
        validation.row(
            f"momentum of water and particles, {name}",
            "N s",
            force,
            "weight, buoyancy, pressure at the ends",
            "computed",
            gained,
            abs(force) * PRESSURE_CORRECTION_PERCENT / 100,
            PRESSURE_CORRECTION_PERCENT,
        )
    ]


def balance(run: Any) -> tuple[Any, Any]:
    """From the start to the end, along z [N s]: the impulse of all that acts on the column from outside, and what water
    and particles gained, what is on its way between them included. No particle touches a wall, the sides slip, and the
    water rests at the ends."""
    column = Column(run)
    time, bottom = case_files.surface_values(run, "bottomPressure")
    _, top = case_files.surface_values(run, "topPressure")
    intervals = np.diff(np.concatenate([[0], time]))
    pressure = column["fluidDensity"] * column.area * ((bottom - top)[:, 0] * intervals).sum()
    buoyant_weight = -column.load * column.area * time[-1]

    end = column.times()[-1]
    cell = column.area * column["height"] / (column["cellsAcross"] ** 2 * column["cellsUp"])
    water = (
        column["fluidDensity"]
        * cell
        * (case_files.field(run, end, "voidFraction")[:, 0] * case_files.field(run, end, "U")[:, 2]).sum()
    )
    _, _, velocity = column.particles()
    particles = column["particleDensity"] * column.particle_volume * (velocity[-1] - velocity[0])[:, 2].sum()
    return buoyant_weight + pressure, water + particles + semi_implicit_momentum(run) + pressure_on_its_way(column, end)


def pressure_on_its_way(column: Any, end: Any) -> Any:
    """The pressure force on the particles is that of the interval before, its reaction on the water in model A is
    not."""
    if column["modelType"] != "A":
        return 0
    p, void_fraction = (
        case_files.field(column.run, end, name).reshape(int(column["cellsUp"]), -1) for name in ("p", "voidFraction")
    )
    layer = column["height"] / column["cellsUp"]
    gradient = np.gradient(column["fluidDensity"] * p, layer, axis=0)
    return -column["couplingTimeStep"] * ((1 - void_fraction) * gradient).mean(axis=1).sum() * column.area * layer


def semi_implicit_momentum(run: Any) -> float:
    """At the end, along z [N s]."""
    log = run / ("log.mpirun" if run.name.endswith("-2") else "log.pimpleDemFoam")
    return float(re.findall(r"of which semi-implicit \(\S+ \S+ (\S+)\)", log.read_text())[-1])


def of_faults(file: Path) -> Any:
    rows = []
    for suite in json.loads(file.read_text())["testsuites"]:
        conservation = BALANCES.get(suite["name"].split("/")[-1])
        for test in suite["testsuite"] if conservation else []:
            name, _, model = test["name"].partition("/")
            if re.match("Finds|Stops", name):
                words = re.sub("(?=[A-Z])", " ", name).lower().strip()
                found = test["result"] == "COMPLETED" and "failures" not in test
                rows.append(
                    validation.row(
                        f"{conservation}: {words}{model and ', ' + model}",
                        "-",
                        1,
                        "a deliberate fault",
                        "computed",
                        int(found),
                        0,
                        0,
                    )
                )
    if {row["quantity"].split(":")[0] for row in rows} != set(BALANCES.values()):
        raise SystemExit(f"{file} has no deliberate fault for one of: {', '.join(BALANCES.values())}")
    return rows


if __name__ == "__main__":
    main()
