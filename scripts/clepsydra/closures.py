"""Values of the closed formulas in coupling/closures, from the program `closures`."""

import subprocess
from typing import Any, Mapping

import numpy as np

from clepsydra import environment

OF_BED = ("dragLaw", "particleDiameter", "fluidDensity", "fluidViscosity")


def value(formula: str, **options: Any) -> float:
    """One number: value("terminalVelocity", dragLaw="DiFeliceDrag", particleDiameter=2e-3, ...)."""
    return float(values(formula, **options)[0])


def values(formula: str, **options: Any) -> np.ndarray:
    """An array, for options that take several numbers: values("drag", ..., slipSpeed=[.1, .2])."""
    command = [str(environment.program("closures")), formula]
    for name, given in options.items():
        command += [f"--{name}"] + [str(one) for one in np.atleast_1d(given)]
    try:
        found = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    except OSError as problem:
        raise SystemExit(f"{command[0]}: {problem.strerror}; run scripts/setup") from None
    if found.returncode != 0:
        raise SystemExit(f"{' '.join(command)} failed")
    return np.array([float(line) for line in found.stdout.split()])


def bed_pressure_gradient(superficial_velocity: float, void_fraction: float, parameters: Mapping[str, Any]) -> float:
    """One of bed_pressure_gradients()."""
    return float(bed_pressure_gradients(np.array([superficial_velocity]), void_fraction, parameters)[0])


def bed_pressure_gradients(
    superficial_velocities: np.ndarray, void_fraction: float, parameters: Mapping[str, Any]
) -> np.ndarray:
    """Pressure gradients [Pa/m] of flow through a bed at rest in model A, where the void fraction times the gradient is
    the drag per volume. Of a case's parameters those named in OF_BED are used."""
    slips = superficial_velocities / void_fraction
    of_bed = {name: parameters[name] for name in OF_BED}
    coefficients = values("drag", **of_bed, voidFraction=void_fraction, slipSpeed=slips)
    particle_volume = np.pi / 6 * parameters["particleDiameter"] ** 3
    return (1 - void_fraction) / particle_volume * coefficients * slips / void_fraction
