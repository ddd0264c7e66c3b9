"""What a signal that swings tells: its mean, its swing and its main frequency, each with the standard error that its
periods give. The times need not be evenly spaced, as those of a digitised curve."""

from dataclasses import dataclass
from typing import Any

import numpy as np

FEWEST_PERIODS = 3


@dataclass(frozen=True)
class Estimate:
    """A value and its standard error."""

    value: float
    error: float


@dataclass(frozen=True)
class Swings:
    """Mean [unit of the signal], standard deviation [same], main frequency [1/s], and the number of whole periods."""

    mean: Estimate
    deviation: Estimate
    frequency: Estimate
    periods: int


def swings(time: np.ndarray, values: np.ndarray) -> Swings:
    """A period lasts from one rise through the mean to the next one that follows a fall below the mean by half of the
    standard deviation, so that noise at the mean begins none. ValueError where there are fewer than three."""
    mean = mean_of(time, values)
    deviation = mean_of(time, (values - mean) ** 2) ** 0.5
    starts = rises(time, values - mean, deviation / 2)
    if len(starts) <= FEWEST_PERIODS:
        raise ValueError(f"{max(0, len(starts) - 1)} periods; allowed: {FEWEST_PERIODS} and more")
    parts = [between(time, values, *ends) for ends in zip(starts, starts[1:])]
    means = np.array([mean_of(*part) for part in parts])
    variances = np.array([mean_of(part[0], (part[1] - mean) ** 2) for part in parts])
    lengths = np.diff(starts)
    return Swings(
        Estimate(mean, standard_error(means)),
        Estimate(deviation, standard_error(variances) / (2 * deviation)),
        Estimate(1 / lengths.mean(), standard_error(lengths) / lengths.mean() ** 2),
        len(parts),
    )


def mean_of(time: np.ndarray, values: np.ndarray) -> float:
    """Mean over time, linear between the points."""
    return float(np.sum(np.diff(time) * (values[1:] + values[:-1]) / 2) / (time[-1] - time[0]))


def standard_error(values: np.ndarray) -> float:
    return float(values.std(ddof=1) / len(values) ** 0.5)


def error_by_parts(values: np.ndarray, parts: int = 5) -> float:
    """Standard error of a mean over time, from the means over parts of it that are taken as independent."""
    return standard_error(np.array([part.mean() for part in np.array_split(values, parts)]))


def rises(time: np.ndarray, values: np.ndarray, depth: float) -> Any:
    """Times at which the values pass zero upwards from below -depth, reaching depth before they are below it again."""
    found: list[float] = []
    candidate, was_low = None, False
    for i in range(1, len(values)):
        if values[i] < -depth:
            was_low, candidate = True, None
        if was_low and values[i - 1] < 0 <= values[i]:
            step = time[i] - time[i - 1]
            candidate = time[i - 1] - values[i - 1] * step / (values[i] - values[i - 1])
        if candidate is not None and values[i] > depth:
            found.append(float(candidate))
            candidate, was_low = None, False
    return np.array(found)


def between(time: np.ndarray, values: np.ndarray, start: float, end: float) -> tuple[np.ndarray, np.ndarray]:
    """The part of a signal between two times, with its values there."""
    inside = (time > start) & (time < end)
    times = np.concatenate([[start], time[inside], [end]])
    return times, np.interp(times, time, values)
