"""The equation of motion of a lone bead in still liquid: what the solver should give (one-way).

    (m + m_a) dv/dt = (m - rho V) g - Sp(|v|) v - 3 pi mu d int K(t - s) dv,      v downwards, jumps of v included
"""

from dataclasses import dataclass

import numpy as np

import closures


@dataclass
class Bead:
    beadDiameter: float
    beadDensity: float
    fluidDensity: float
    fluidViscosity: float
    dragLaw: str

    @classmethod
    def of(cls, parameters):
        return cls(**{name: parameters[name] for name in cls.__annotations__})

    def drag(self, fastest):
        """Sp(|v|) [kg/s], a table of the law's values."""
        speeds = np.linspace(0, fastest, 801)
        coefficients = closures.values("drag", dragLaw=self.dragLaw, beadDiameter=self.beadDiameter,
                                       fluidDensity=self.fluidDensity, fluidViscosity=self.fluidViscosity,
                                       slipSpeed=speeds)
        return lambda speed: np.interp(speed, speeds, coefficients)


def basset(lag, speed, bead):
    """K of creeping flow, and of any flow for short lags: Basset (1888)."""
    return 0.5 * bead.beadDiameter / np.sqrt(np.pi * bead.fluidViscosity * lag)


def meiAdrian(lag, speed, bead):
    """K for finite Re, which forgets faster: R. Mei & R. J. Adrian, J. Fluid Mech. 237, 323 (1992)."""
    radius, viscosity = 0.5 * bead.beadDiameter, bead.fluidViscosity
    f = 0.75 + 0.105 * 2 * radius * speed / viscosity
    short = (np.pi * lag * viscosity / radius**2) ** 0.25
    long = np.sqrt(np.pi / 2 * speed**3 / (radius * viscosity * f**3)) * lag
    return (short + long) ** -2


def motion(bead, endTime, start=0.0, jump=0.0, addedMass=True, history=None, fastest=1.0, steps=1500):
    """t and v of a bead that moves with v = start at t = 0, just after its velocity has jumped by `jump`."""
    volume = np.pi / 6 * bead.beadDiameter**3
    drag = bead.drag(fastest)
    load = (bead.beadDensity - bead.fluidDensity) * volume * 9.81
    perKernel = 3 * np.pi * bead.fluidDensity * bead.fluidViscosity * bead.beadDiameter
    step = endTime / steps
    inertia = volume * (bead.beadDensity + 0.5 * bead.fluidDensity * addedMass)
    if history:
        # the kernel's singular end, integrated over one step: implicit in the acceleration
        inertia += perKernel * 2 * step * basset(step, 0, bead)
    v = np.full(steps + 1, float(start))
    acceleration = np.zeros(steps)
    for n in range(steps):
        past = 0
        if history:
            lag = (n - np.arange(n) + 0.5) * step
            past = perKernel * (step * np.dot(history(lag, abs(v[n]), bead), acceleration[:n])
                                + jump * history((n + 0.5) * step, abs(v[n]), bead))
        acceleration[n] = (load - drag(abs(v[n])) * v[n] - past) / inertia
        v[n + 1] = v[n] + step * acceleration[n]
    return step * np.arange(steps + 1), v
