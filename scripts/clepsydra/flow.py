"""Outflow of a hopper: rate and time to empty."""

import numpy as np

# of the Gaussian window [s]; the paper's window of 2 s is as long as a whole run of the
# quick hopper
DEVIATION = 0.08


def smoothed_rate(
    time: np.ndarray, mass: np.ndarray, deviation: float = DEVIATION, points: int = 400
) -> tuple[np.ndarray, np.ndarray]:
    """-dm/dt, as the paper takes it: slope of a parabola fitted under Gaussian weights.

    Times nearer than one deviation to an end are left out: the fit leans there."""
    at = np.linspace(time[0] + deviation, time[-1] - deviation, points)
    rate = np.empty(points)
    for index, centre in enumerate(at):
        near = np.abs(time - centre) < 4 * deviation
        shifted = time[near] - centre
        # numpy weighs the residual, not its square
        weight = np.exp(-0.25 * (shifted / deviation) ** 2)
        rate[index] = -np.polyfit(shifted, mass[near], 2, w=weight)[1]
    return at, rate


def time_at_mass(time: np.ndarray, mass: np.ndarray, level: float) -> float | None:
    """When the mass in the hopper first falls to level; None if it never does."""
    below = np.flatnonzero(mass <= level)
    if not len(below):
        return None
    after = below[0]
    if after == 0:
        return time[0]
    part = (mass[after - 1] - level) / (mass[after - 1] - mass[after])
    return time[after - 1] + part * (time[after] - time[after - 1])


def mean_rate(time: np.ndarray, mass: np.ndarray, upper: float, lower: float) -> float | None:
    """Mean outflow while the hopper holds between two fractions of its fill."""
    start, end = (time_at_mass(time, mass, fraction * mass[0]) for fraction in (upper, lower))
    return None if start is None or end is None else (upper - lower) * mass[0] / (end - start)


def required_mean_rate(time: np.ndarray, mass: np.ndarray, upper: float, lower: float) -> float:
    """The same of a discharge that must have come to the lower fraction; SystemExit where it has not."""
    rate = mean_rate(time, mass, upper, lower)
    if rate is None:
        raise SystemExit(f"a discharge ended before {100 * (1 - lower):g} % of the fill had left")
    return rate


def emptying_time(time: np.ndarray, mass: np.ndarray, level: float) -> float | None:
    """When the smoothed rate falls below level [kg/s] for good; None if it does not.

    Not "the last particle": single particles trickle off the heap on a flat bottom for seconds."""
    at, rate = smoothed_rate(time, mass)
    above = np.flatnonzero(rate >= level)
    if not len(above) or above[-1] == len(rate) - 1:
        return None
    return at[above[-1] + 1]
