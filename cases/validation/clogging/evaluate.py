#!/usr/bin/python3
"""Mean and distribution of the number of particles between two clogs, against measurements.

A clog ends an event by chance, with the same probability for each particle that leaves: the numbers have an exponential
(geometric) distribution. Where the hopper was low before it clogged, the event is cut off: the estimate of the mean is
all particles that left over the number of clogs, whose relative error is one over the root of the number of clogs.

The first event of a filling may end by an arch of the start (arches.py), so that means are taken without it, too. """

from __future__ import annotations

import csv
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path
from typing import Any

import arches
import numpy as np
import yaml

from clepsydra import validation
from clepsydra.picture_style import pyplot

ZURIGUEL = (
    "Zuriguel, Garcimartin, Maza, Pugnaloni & Pastor, Phys. Rev. E 71, 051303 (2005): 9900/(4.94 - D/d)^6.9, constants "
    "as recalled; of the paper only the abstract could be read"
)
KOIVISTO = "Koivisto & Durian, Phys. Rev. E 95, 032904 (2017): water reduces the mean mass only slightly"
EXPONENTIAL = "clogging as a Poisson process, as in both measurements"
# %. The exponent of the formula, 6.9 +- 0.2, and its pole, 4.94 +- 0.03, alone leave 17 % at D/d = 3; means of 50 clogs
# have errors of 14 %, and the hopper is narrower than the measured one.
TOLERANCE_OF_MEAN = 50
TOLERANCE_OF_RATIO = 30
TOLERANCE_OF_SPREAD = 35  # %, of the standard deviation over the mean of 50 events
LEAST_CLOGS = 20  # for a row
DRAWS = 10000
MEDIAN = 0.5  # of p, where the distribution is exponential
TOLERANCE_OF_MEDIAN = 90  # %: from 0.05 to 0.95
LATER = {1: "without the first event of each filling", 100: "once 100 particles have left"}
CLOGGED, BLOCKED = "clogged", "blocked"
MEAN_FINDING = (
    "hopper and arch-breaking differ from those of the experiments, and so may the particles' friction, although "
    "Zuriguel et al. found no influence of the material"
)
RATIO_FINDING = "in the simulation water changes the number between clogs more than was measured"
SPREAD_FINDING = "the distribution is not exponential: an arch that was broken leaves the bed above it as it was"
PROBABILITY_FINDING = (
    "not exponential: events are short while little of a filling has left and grow as it empties; with a hole of 3 "
    "diameters the first event of 14 of 15 fillings ends after 5 to 16 particles"
)


@dataclass(frozen=True)
class Event:
    """What a row of ./discharge.py says."""

    condition: str
    start: int  # particles in the hopper
    left: int
    end: str
    cpu_seconds: float


def read(path: str) -> list[Event]:
    if not Path(path).exists():
        return []
    with open(path, newline="") as file:
        return [
            Event(row["condition"], int(row["start"]), int(row["left"]), row["end"], float(row["cpuSeconds"]))
            for row in csv.DictReader(file)
        ]


@dataclass(frozen=True)
class Condition:
    name: str
    hole: float
    fluid: str
    friction: float
    left: np.ndarray  # particles of each event
    clogged: np.ndarray  # whether it ended by a clog
    most: np.ndarray  # particles of each event at which it would have been cut off
    before: np.ndarray  # particles that had left before each event, since the filling

    @property
    def clogs(self) -> int:
        return int(self.clogged.sum())

    @property
    def mean(self) -> float:
        return float(self.left.sum() / self.clogs)

    @property
    def error(self) -> float:
        return self.mean / np.sqrt(self.clogs)

    def after(self, particles: int) -> "Condition":
        """The events that began when so many particles of the filling had left."""
        later = self.before >= particles
        return replace(
            self,
            name=f"{self.name}, {LATER[particles]}",
            left=self.left[later],
            clogged=self.clogged[later],
            most=self.most[later],
            before=self.before[later],
        )


def measured_mean(hole: float) -> float:
    return 9900 / (4.94 - hole) ** 6.9


def conditions(events: list[Event]) -> list[Condition]:
    settings = yaml.safe_load(Path("conditions.yaml").read_text())
    found = []
    for name, about in settings["conditions"].items():
        own = [row for row in events if row.condition == name and row.end != BLOCKED]
        if any(row.end == CLOGGED for row in own):
            found.append(
                Condition(
                    name,
                    about["hole"],
                    about["fluid"],
                    about["friction"],
                    np.array([row.left for row in own], dtype=float),
                    np.array([row.end == CLOGGED for row in own]),
                    np.array([row.start - settings["countedAbove"] for row in own], dtype=float),
                    np.array([settings["parameters"]["particleCount"] - row.start for row in own]),
                )
            )
    return found


def places(left: np.ndarray, most: np.ndarray, mean: float) -> np.ndarray:
    """Where events of 1, 2, ... particles lie in their distribution, which is cut off at `most`: evenly from 0 to 1, if
    it is geometric. Half a particle less: the middle of a whole number's step."""
    decay = np.log1p(-1 / mean)
    return np.expm1(decay * (left - 0.5)) / np.expm1(decay * most)


def distance(values: np.ndarray) -> float:
    """Kolmogorov and Smirnov's, from an even distribution."""
    ordered = np.sort(values)
    steps = np.arange(len(ordered) + 1) / len(ordered)
    return float(max((steps[1:] - ordered).max(), (ordered - steps[:-1]).max()))


def probability_of_exponential(condition: Condition) -> float:
    """Part of drawn sets of such events, with their own fitted mean, that are as far from exponential as these."""
    random = np.random.default_rng(20261126)
    own = distance(places(condition.left, condition.most, condition.mean)[condition.clogged])
    farther = 0
    for _ in range(DRAWS):
        drawn = random.geometric(1 / condition.mean, len(condition.left)).astype(float)
        clogged = drawn <= condition.most
        if not clogged.any():
            continue
        left = np.minimum(drawn, condition.most)
        mean = left.sum() / clogged.sum()
        farther += distance(places(left, condition.most, mean)[clogged]) >= own
    return (farther + 1) / (DRAWS + 1)


def spread(condition: Condition) -> float:
    """Standard deviation over mean of what would be without the cut: from the events that ended by a clog, where few
    were cut off."""
    own = condition.left[condition.clogged]
    return float(own.std(ddof=1) / own.mean())


def rows_of(found: list[Condition]) -> list[Any]:
    rows = []
    for one in found:
        for events in (one, one.after(1)):
            if events.clogs >= LEAST_CLOGS:
                rows += [mean_row(events), probability_row(events)]
        if one.clogs >= LEAST_CLOGS and (~one.clogged).sum() < 0.1 * len(one.clogged):
            rows.append(
                validation.row(
                    f"standard deviation over mean of the events, {one.name}",
                    "-",
                    1,
                    EXPONENTIAL,
                    "measured",
                    spread(one),
                    1 / np.sqrt(one.clogs),
                    TOLERANCE_OF_SPREAD,
                    SPREAD_FINDING,
                    0,
                )
            )
    for wet, dry in pairs(found):
        if min(wet.clogs, dry.clogs) >= LEAST_CLOGS:
            ratio = wet.mean / dry.mean
            rows.append(
                validation.row(
                    f"particles between clogs, submerged over dry, D/d {wet.hole:g}, friction {wet.friction:g}",
                    "-",
                    1,
                    KOIVISTO,
                    "measured",
                    ratio,
                    ratio * np.hypot(wet.error / wet.mean, dry.error / dry.mean),
                    TOLERANCE_OF_RATIO,
                    RATIO_FINDING,
                    0,
                )
            )
    return rows


def mean_row(one: Condition) -> dict[str, Any]:
    return validation.row(
        f"particles between clogs, {one.name}",
        "-",
        measured_mean(one.hole),
        ZURIGUEL,
        "measured",
        one.mean,
        one.error,
        TOLERANCE_OF_MEAN,
        MEAN_FINDING,
        0,  # the committed events give the same row each time; others are news
    )


def probability_row(one: Condition) -> dict[str, Any]:
    """Where the distribution is exponential, all values from 0 to 1 are alike probable."""
    probability = probability_of_exponential(one)
    return validation.row(
        f"p against an exponential distribution, {one.name}",
        "-",
        MEDIAN,
        EXPONENTIAL,
        "measured",
        probability,
        1 / np.sqrt(12),
        TOLERANCE_OF_MEDIAN,
        PROBABILITY_FINDING if probability < MEDIAN else None,
        np.sqrt(probability * (1 - probability) / DRAWS),
    )


def pairs(found: list[Condition]) -> list[tuple[Condition, Condition]]:
    return [
        (wet, dry)
        for wet in found
        for dry in found
        if (wet.fluid != "none" and dry.fluid == "none") and (wet.hole, wet.friction) == (dry.hole, dry.friction)
    ]


def quick_rows() -> list[Any]:
    """Of the fresh event of the short version, where it was made: some 20 particles leave between clogs; 500 could."""
    return [
        validation.row(
            "event of a hole of 2.5 particles that ended by a clog, short run",
            "-",
            1,
            ZURIGUEL,
            "measured",
            float(row.end == CLOGGED and row.left > 0),
            0,
            1,
        )
        for row in read("results/quick.csv")
    ]


def report(found: list[Condition], events: list[Event]) -> None:
    print(f"clogging: particles between two clogs; below each condition {', and '.join(LATER.values())}")
    print(
        "  condition               D/d  friction  clogs  cut off      mean +- error   measured  exponential: p  CPU s"
    )
    for one in found:
        cost = sum(row.cpu_seconds for row in events if row.condition == one.name)
        print(f"  {one.name:22}{one.hole:5g}{one.friction:10g}{counts(one)}{cost:11.0f}")
        for later in map(one.after, LATER):
            if later.clogs:
                print(f"  {'':37}{counts(later)}")
    for wet, dry in pairs(found):
        ratio = wet.mean / dry.mean
        error = ratio * np.hypot(wet.error / wet.mean, dry.error / dry.mean)
        print(f"  submerged over dry, D/d {wet.hole:g}, friction {wet.friction:g}: {ratio:.2f} +- {error:.2f}")


def counts(one: Condition) -> str:
    return (
        f"{one.clogs:7}{(~one.clogged).sum():9}{one.mean:10.1f} +- {one.error:.1f}{measured_mean(one.hole):11.0f}"
        f"{probability_of_exponential(one) if one.clogs > 4 else inf:12.4f}"
    )


def plot(found: list[Condition]) -> None:
    figure, axes = pyplot.subplots(figsize=(6, 4), constrained_layout=True)
    for one in found:
        own = np.sort(one.left[one.clogged]) / one.mean
        axes.step(own, 1 - np.arange(len(own)) / len(own), where="pre", label=f"{one.name}: {one.mean:.0f}")
    at = np.linspace(0, 5)
    axes.plot(at, np.exp(-at), "k--", label="exponential")
    axes.set(xlabel="particles of an event over their mean", ylabel="part of the events that are longer", yscale="log")
    axes.set(ylim=(0.01, 1.1))
    axes.legend(fontsize=8)
    figure.savefig("results/clogging.png", dpi=150)


def main() -> None:
    events = read("results/runs/events.csv")
    found = conditions(events)
    if found:
        report(found, events)
        plot(found)
    else:
        print("clogging: no clog has been counted yet")
    starts = arches.read()
    arches.report(starts)
    validation.write(quick_rows() + rows_of(found) + arches.rows_of(starts))


if __name__ == "__main__":
    main()
