"""The equation of motion of a lone bead in still fluid: what the solver should give (one-way), and, with the history
force that it does not have, how much of a deviation that force would explain.

R. Mei & R. J. Adrian, J. Fluid Mech. 237, 323 (1992), for finite Re: F = -3 pi mu d int K(t - s) dv/ds ds,

    K(t) = [ (pi t nu/R^2)^(1/4) + (pi/2 v^3/(R nu f^3) t^2)^(1/2) ]^-2,      f = .75 + .105 Re

Its short-time part is Basset's kernel, R/sqrt(pi nu t).
"""

import numpy as np


def fromRest(drag, diameter, beadDensity, fluidDensity, viscosity, endTime, addedMass=True, history=False, steps=1500):
    """t and v of a bead let go. drag(v): Sp [kg/s]."""
    volume = np.pi / 6 * diameter**3
    radius = diameter / 2
    perKernel = 3 * np.pi * fluidDensity * viscosity * diameter * history
    load = (beadDensity - fluidDensity) * volume * 9.81
    step = endTime / steps
    # the kernel's singular end, integrated over one step: implicit in the acceleration
    newest = 2 * np.sqrt(step) * radius / np.sqrt(np.pi * viscosity)
    inertia = volume * (beadDensity + 0.5 * fluidDensity * addedMass) + perKernel * newest
    v = np.zeros(steps + 1)
    acceleration = np.zeros(steps)
    for n in range(steps):
        past = 0
        if history:
            lag = (n - np.arange(n) + 0.5) * step
            past = perKernel * step * np.dot(kernel(lag, v[n], radius, viscosity), acceleration[:n])
        acceleration[n] = (load - drag(v[n]) * v[n] - past) / inertia
        v[n + 1] = v[n] + step * acceleration[n]
    return step * np.arange(steps + 1), v


def kernel(lag, speed, radius, viscosity):
    f = 0.75 + 0.105 * 2 * radius * speed / viscosity
    short = (np.pi * lag * viscosity / radius**2) ** 0.25
    long = np.sqrt(np.pi / 2 * speed**3 / (radius * viscosity * f**3)) * lag
    return (short + long) ** -2
