"""The equation of motion of an isolated particle in still liquid: what the solver should give (one-way).

    (m + m_a) dv/dt = (m - rho V) g - Sp(|v|) v - 3 pi mu d int K(t - s) dv,      v downwards, jumps of v included
"""

from dataclasses import dataclass
from typing import Any, Callable

import numpy as np

from clepsydra import closures


@dataclass
class Particle:
    particle_diameter: float
    particle_density: float
    fluid_density: float
    fluid_viscosity: float
    drag_law: str

    @classmethod
    def of(cls, parameters: dict[str, Any]) -> "Particle":
        """The particle of a case's parameters."""
        return cls(
            particle_diameter=parameters["particleDiameter"],
            particle_density=parameters["particleDensity"],
            fluid_density=parameters["fluidDensity"],
            fluid_viscosity=parameters["fluidViscosity"],
            drag_law=parameters["dragLaw"],
        )

    def drag(self, fastest: float) -> Callable[[float], Any]:
        """Sp(|v|) [kg/s], a table of the law's values."""
        speeds = np.linspace(0, fastest, 801)
        coefficients = closures.values(
            "drag",
            dragLaw=self.drag_law,
            particleDiameter=self.particle_diameter,
            fluidDensity=self.fluid_density,
            fluidViscosity=self.fluid_viscosity,
            slipSpeed=speeds,
        )
        return lambda speed: np.interp(speed, speeds, coefficients)


# K(lag, speed, particle)
Kernel = Callable[[Any, float, Particle], Any]


def basset(lag: np.ndarray | float, speed: float, particle: Particle) -> Any:
    """K of creeping flow, and of any flow for short lags: Basset (1888)."""
    return 0.5 * particle.particle_diameter / np.sqrt(np.pi * particle.fluid_viscosity * lag)


def mei_adrian(lag: np.ndarray | float, speed: float, particle: Particle) -> Any:
    """K for finite Re, which forgets faster: R. Mei & R. J. Adrian, J. Fluid Mech. 237, 323 (1992)."""
    radius, viscosity = 0.5 * particle.particle_diameter, particle.fluid_viscosity
    f = 0.75 + 0.105 * 2 * radius * speed / viscosity
    short = (np.pi * lag * viscosity / radius**2) ** 0.25
    long = np.sqrt(np.pi / 2 * speed**3 / (radius * viscosity * f**3)) * lag
    return (short + long) ** -2


def motion(
    particle: Particle,
    end_time: float,
    start: float = 0.0,
    jump: float = 0.0,
    added_mass: bool = True,
    history: Kernel | None = None,
    fastest: float = 1.0,
    steps: int = 1500,
) -> tuple[np.ndarray, np.ndarray]:
    """t and v of a particle that moves with v = start at t = 0, just after its velocity has jumped by `jump`."""
    volume = np.pi / 6 * particle.particle_diameter**3
    drag = particle.drag(fastest)
    load = (particle.particle_density - particle.fluid_density) * volume * 9.81
    per_kernel = 3 * np.pi * particle.fluid_density * particle.fluid_viscosity * particle.particle_diameter
    step = end_time / steps
    inertia = volume * (particle.particle_density + 0.5 * particle.fluid_density * added_mass)
    if history:
        # the kernel's singular end, integrated over one step: implicit in the acceleration
        inertia += per_kernel * 2 * step * basset(step, 0, particle)
    v = np.full(steps + 1, float(start))
    acceleration = np.zeros(steps)
    for n in range(steps):
        past = 0
        if history:
            lag = (n - np.arange(n) + 0.5) * step
            past = per_kernel * (
                step * np.dot(history(lag, abs(v[n]), particle), acceleration[:n])
                + jump * history((n + 0.5) * step, abs(v[n]), particle)
            )
        acceleration[n] = (load - drag(abs(v[n])) * v[n] - past) / inertia
        v[n + 1] = v[n] + step * acceleration[n]
    return step * np.arange(steps + 1), v
