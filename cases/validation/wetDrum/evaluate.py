#!/usr/bin/python3
"""The torque with which a turning drum carries its particles, against the torque of their weight, in water and dry."""

from pathlib import Path
from typing import Any

from clepsydra import validation
from clepsydra.drum import Drum
from clepsydra.periods import error_by_parts

BALANCE = "torque of the particles' weight less buoyancy"
BALANCE_DRY = "torque of the particles' weight"
# What the liquid takes up while it is still being accelerated, and the scatter of momentary forces
TOLERANCE = 4


def balance(drum: Drum, name: str, source: str) -> dict[str, Any]:
    torques, weights = drum.torques[drum.steady], drum.weights[drum.steady]
    angles = drum.angles[drum.steady]
    print(f"{name}: bed at {angles.mean():.2f} +- {error_by_parts(angles):.2f} degrees, {drum.count} particles")
    return validation.row(
        f"torque of the drum, {name}",
        "N m",
        float(weights.mean()),
        source,
        "computed",
        float(torques.mean()),
        error_by_parts(torques - weights),
        TOLERANCE,
    )


def main() -> None:
    wet, dry = Drum(Path("runs/wet")), Drum(Path("runs/dry"))
    validation.write([balance(wet, "in water", BALANCE), balance(dry, "dry", BALANCE_DRY)])


if __name__ == "__main__":
    main()
