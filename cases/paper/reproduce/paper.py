"""What "Friction controls submerged granular flows" (Koivisto et al., arXiv 1703.09584) prints.

Steps are named as in the cases, masses in g, rates in g/s, times in s. """

from dataclasses import dataclass
from math import log
from typing import Any

STEPS = ("dry", "submerged")

# measured, both while 300 to 400 g are left
RATE = {"dry": 11.4, "submerged": 7.6}
RATE_ERROR = 0.05  # half of the last printed digit: no error is given

# of the simulations: the friction at which the rate is the measured one, and W_o of the fit W - W_o "exponential" in mu
MATCHING_FRICTION = {"dry": 0.15, "submerged": 0.13}
ASYMPTOTIC_RATE = {"dry": 9.5, "submerged": 6.1}

# of the simulations: time to empty
EMPTYING_MASS, EMPTYING_FRICTION = 500, 0.8
EMPTYING_TIME = {"dry": 52, "submerged": 90}

SMOOTH_FRICTION = 1e-6  # "like a Newtonian fluid"
# The slope of a parabola under Gaussian weights "in a 2 s window": read here as the full width at half maximum. The
# other
# readings, a standard deviation of .5 s or 1 s, are narrower and wider by less than a factor of two.
WINDOW_DEVIATION = 2 / 2.3548


@dataclass(frozen=True)
class Particle:
    """A row of Table I."""

    diameter: float  # m
    reynolds: float
    drag_coefficient: float
    inertial_number: float


# The printed I = eta D/(rho_e v_t) has a dimension; 4 eta/(rho_e v_t D) gives the printed numbers.
TABLE_1 = (Particle(0.5e-3, 37, 1.76, 34.0e-4), Particle(1e-3, 151, 0.86, 17.0e-4), Particle(2e-3, 530, 0.56, 9.8e-4))


def wilson_rate(upper: float, lower: float, surge: Any = 0.25, mass: Any = 187) -> Any:
    """Mean rate between two masses, of W = 1 + S/(1 + m/M): rises by up to S as the hopper empties, as Wilson et al.,
    Papers in Physics 6, 060009 (2014) measured under water in another hopper."""
    # the time that it takes, the integral of dm/W
    time = upper - lower - surge * mass * log((mass * (1 + surge) + upper) / (mass * (1 + surge) + lower))
    return (upper - lower) / time
