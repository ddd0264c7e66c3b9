"""The equation of motion of an isolated particle in still liquid: what the solver should give (one-way).

    (m + m_a) dv/dt = (m - rho V) g - Sp(|v|) v - 3 pi mu d int K(t - s) dv,      v downwards, jumps of v included
"""

from dataclasses import dataclass

import numpy as np

import closures


@dataclass
class Particle:
    particleDiameter: float
    particleDensity: float
    fluidDensity: float
    fluidViscosity: float
    dragLaw: str

    @classmethod
    def of(cls, parameters):
        return cls(**{name: parameters[name] for name in cls.__annotations__})

    def drag(self, fastest):
        """Sp(|v|) [kg/s], a table of the law's values."""
        speeds = np.linspace(0, fastest, 801)
        coefficients = closures.values("drag", dragLaw=self.dragLaw, particleDiameter=self.particleDiameter,
                                       fluidDensity=self.fluidDensity, fluidViscosity=self.fluidViscosity,
                                       slipSpeed=speeds)
        return lambda speed: np.interp(speed, speeds, coefficients)


def basset(lag, speed, particle):
    """K of creeping flow, and of any flow for short lags: Basset (1888)."""
    return 0.5 * particle.particleDiameter / np.sqrt(np.pi * particle.fluidViscosity * lag)


def meiAdrian(lag, speed, particle):
    """K for finite Re, which forgets faster: R. Mei & R. J. Adrian, J. Fluid Mech. 237, 323 (1992)."""
    radius, viscosity = 0.5 * particle.particleDiameter, particle.fluidViscosity
    f = 0.75 + 0.105 * 2 * radius * speed / viscosity
    short = (np.pi * lag * viscosity / radius**2) ** 0.25
    long = np.sqrt(np.pi / 2 * speed**3 / (radius * viscosity * f**3)) * lag
    return (short + long) ** -2


def motion(particle, endTime, start=0.0, jump=0.0, addedMass=True, history=None, fastest=1.0, steps=1500):
    """t and v of a particle that moves with v = start at t = 0, just after its velocity has jumped by `jump`."""
    volume = np.pi / 6 * particle.particleDiameter**3
    drag = particle.drag(fastest)
    load = (particle.particleDensity - particle.fluidDensity) * volume * 9.81
    perKernel = 3 * np.pi * particle.fluidDensity * particle.fluidViscosity * particle.particleDiameter
    step = endTime / steps
    inertia = volume * (particle.particleDensity + 0.5 * particle.fluidDensity * addedMass)
    if history:
        # the kernel's singular end, integrated over one step: implicit in the acceleration
        inertia += perKernel * 2 * step * basset(step, 0, particle)
    v = np.full(steps + 1, float(start))
    acceleration = np.zeros(steps)
    for n in range(steps):
        past = 0
        if history:
            lag = (n - np.arange(n) + 0.5) * step
            past = perKernel * (step * np.dot(history(lag, abs(v[n]), particle), acceleration[:n])
                                + jump * history((n + 0.5) * step, abs(v[n]), particle))
        acceleration[n] = (load - drag(abs(v[n])) * v[n] - past) / inertia
        v[n + 1] = v[n] + step * acceleration[n]
    return step * np.arange(steps + 1), v
