"""Profiles of the particles' mean speed, from the table of the function object particleMeans, with the standard errors
that parts of the time give."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files

FEWEST_BLOCKS = 3
X, Z, SAMPLED_TIMES, PARTICLES, SPEED = 1, 3, 4, 5, 6  # columns of the table


@dataclass(frozen=True)
class Profile:
    """Mean speed of the particles [m/s] and its standard error, which is not a number where there are fewer than three
    blocks of time with particles, at places along x [m]. A speed is not a number where no particle has been."""

    x: np.ndarray
    speed: np.ndarray
    error: np.ndarray
    blocks: np.ndarray  # speeds in each block of time, a row each


class ParticleMeans:
    """The table of a run."""

    def __init__(self, case: Path | str, name: str = "particleMeans") -> None:
        self.columns = case_files.columns(case, name)
        self.times = np.unique(self.columns[0])

    def profile(self, height: float, reach: float, first: float, last: float, step: float, block: float) -> Profile:
        """At first, first + step, ..., last along x: means over the bins whose centres lie within reach of that place
        and of the height. Blocks of time of at least the given length [s] give the errors."""
        x = np.arange(first, last + 0.5 * step, step)
        ends = self.ends_of_blocks(block)
        sums = np.array([self.sums(time, x, height, reach) for time in ends])
        count, speed_sum = sums[-1]
        parts = np.diff(sums, axis=0, prepend=np.zeros((1, 2, len(x))))
        with np.errstate(invalid="ignore", divide="ignore"):
            speed = speed_sum / count
            blocks = parts[:, 1] / parts[:, 0]
        return Profile(x, speed, error_of_ratio(parts[:, 1], parts[:, 0], speed), blocks)

    def sums(self, time: float, x: np.ndarray, height: float, reach: float) -> np.ndarray:
        """Number of particles and sum of their speeds from the first sample to a time, at each place."""
        rows = self.columns[:, self.columns[0] == time]
        rows = rows[:, np.abs(rows[Z] - height) < reach]
        near = np.abs(rows[X] - x[:, None]) < reach
        return np.array([near @ rows[PARTICLES], near @ (rows[PARTICLES] * rows[SPEED])])

    def ends_of_blocks(self, block: float) -> list[Any]:
        """Times of the table that are at least a block apart; a shorter rest at the end belongs to the last block."""
        ends: list[Any] = []
        begun = self.beginning()
        for time in self.times:
            if time - begun > block * (1 - 1e-6):
                ends.append(time)
                begun = time
        return [*ends[:-1], self.times[-1]]

    def beginning(self) -> Any:
        """One step between samples before the first sample."""
        if len(self.times) == 1:
            return self.times[0]
        samples = [self.columns[SAMPLED_TIMES, self.columns[0] == time][0] for time in self.times]
        step = (self.times[-1] - self.times[0]) / (samples[-1] - samples[0])
        return self.times[0] - samples[0] * step


def error_of_ratio(sums: np.ndarray, counts: np.ndarray, ratio: np.ndarray) -> np.ndarray:
    """Standard error of sum over count, from that of each block (a row): blocks with more particles weigh more."""
    blocks = len(sums)
    if blocks < FEWEST_BLOCKS:
        return np.full(sums.shape[1:], np.nan)
    with np.errstate(invalid="ignore", divide="ignore"):
        residuals = sums - ratio * counts
        error = np.sqrt(blocks / (blocks - 1) * (residuals**2).sum(axis=0)) / counts.sum(axis=0)
    return np.where((counts > 0).sum(axis=0) < FEWEST_BLOCKS, np.nan, error)


def width_at_half(x: np.ndarray, speed: np.ndarray) -> float:
    """Width of the peak around the largest value, between the places to its left and right at which a straight line
    between the points falls to half of it. Not a number where one side has none."""
    peak = int(np.nanargmax(speed))
    half = speed[peak] / 2

    def place(step: int) -> float:
        inner = peak
        while 0 <= inner + step < len(speed):
            outer = inner + step
            if speed[outer] <= half:
                part = (speed[inner] - half) / (speed[inner] - speed[outer])
                return float(x[inner] + part * (x[outer] - x[inner]))
            inner = outer
        return float("nan")

    return place(1) - place(-1)


def mean_across(x: np.ndarray, speed: np.ndarray) -> float:
    """Mean between the first and the last point, linear between the points."""
    return float(np.trapz(speed, x) / (x[-1] - x[0]))
