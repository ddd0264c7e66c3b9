"""A packed bed that a fluid heats: T. E. W. Schumann's solution, J. Franklin Inst. 208, 405 (1929), for plug flow
without conduction along the bed, beside what a run of the tutorial heatedBed left."""

from pathlib import Path
from typing import Any

import numpy as np
from scipy import integrate, special

from clepsydra import case_files, closures, parameter_file


def fluid_temperature(length: float, time: float) -> float:
    """Of the fluid at the end of a bed, from 0 (initial) to 1 (inlet). `length` is h a z/(rho Cp U), the number of
    transfer units; `time` is h a t/((1 - eps) rho_p Cp_p), from the arrival of the fluid that entered first on."""
    if time <= 0:
        return 0.0

    def integrand(s: float) -> float:
        root = 2 * np.sqrt(time * s)
        return float(special.ive(0, root) * np.exp(root - s - time))

    middle = min(time, length)
    return 1 - sum(integrate.quad(integrand, *limits, limit=200)[0] for limits in ((0, middle), (middle, length)))


class HeatedBed:
    """A run of the tutorial, and Schumann's solution for its particles. The solution depends on the bed's height only
    by the volume of the fluid in the column, which it takes as plug flow."""

    def __init__(self, run: Path | str) -> None:
        self.run = Path(run)
        self.parameters = parameter_file.parameters(self.run / "parameters")
        balances = case_files.balances(self.run)
        if not balances:
            raise SystemExit(f"{run}: there is no postProcessing/conservation: has the solver come to its end?")
        self.balance = balances[-1]
        p = self.parameters
        self.area = p["width"] ** 2
        self.capacity_flux = p["fluidDensity"] * p["fluidCp"] * p["inletVelocity"]

    def void_fraction(self) -> float:
        """Mean over the particles."""
        eps = case_files.field(self.run, case_files.times(self.run)[-1], "voidFraction")[:, 0]
        return float(np.average(eps, weights=1 - eps))

    def heat_transfer_coefficient(self) -> float:
        """h [W/(m2 K)]."""
        p = self.parameters
        reynolds = p["inletVelocity"] * p["particleDiameter"] / p["fluidViscosity"]
        prandtl = p["fluidDensity"] * p["fluidViscosity"] * p["fluidCp"] / p["fluidConductivity"]
        eps = self.void_fraction()
        if p["heatTransferModel"] == "Gunn":
            nusselt = closures.value("gunnNusselt", reynolds=reynolds, prandtl=prandtl, voidFraction=eps)
        else:
            nusselt = closures.value("ranzMarshallNusselt", reynolds=reynolds / eps, prandtl=prandtl)
        return nusselt * p["fluidConductivity"] / p["particleDiameter"]

    def transfer_units(self) -> float:
        surface = self.balance["particlesEnd"] * np.pi * self.parameters["particleDiameter"] ** 2
        return float(self.heat_transfer_coefficient() * surface / (self.capacity_flux * self.area))

    def outlet(self) -> tuple[np.ndarray, np.ndarray]:
        """Time, and the temperature at the outlet from 0 (initial) to 1 (inlet)."""
        time, temperature = case_files.surface_values(self.run, "outletTemperature")
        p = self.parameters
        return time, (temperature[:, 0] - p["initialTemperature"]) / (p["inletTemperature"] - p["initialTemperature"])

    def schumann(self, times: np.ndarray) -> np.ndarray:
        """The same by Schumann's solution."""
        p = self.parameters
        solid_height = self.balance["solidVolume"] / self.area
        arrival = (p["height"] - solid_height) / p["inletVelocity"]
        per_second = (
            6 * self.heat_transfer_coefficient() / (p["particleDiameter"] * p["particleDensity"] * p["particleCp"])
        )
        length = self.transfer_units()
        return np.array([fluid_temperature(length, per_second * (time - arrival)) for time in times])


def time_at(time: np.ndarray, temperature: np.ndarray, value: float) -> float:
    """When a rising temperature passes a value."""
    if temperature[-1] < value:
        raise SystemExit(f"the temperature reaches {temperature[-1]:.3f} only, not {value:g}: increase endTime")
    after: Any = np.argmax(temperature >= value)
    return float(np.interp(value, temperature[after - 1 : after + 1], time[after - 1 : after + 1]))
