"""The runs of cases/paper, and what figures and comparisons take from their m(t)."""

import json
from dataclasses import dataclass
from functools import cache, cached_property
from math import isclose, pi
from typing import Any, Iterable, Sequence

import numpy as np
import paper
from repository import RESULTS
from scipy import optimize, stats

from clepsydra import flow, parameter_study_results

START = (0.95, 0.75)  # of the fill: "the beginning", 380 to 300 g of 400 g
LINEAR = (0.95, 0.5)  # of the fill: 400 to 200 g of 400 g, where the paper fits its straight line
CURVED = (0.95, 0.35)  # of the fill: down to where the heap on the bottom shows
# The surge: the mean rate while so many g are left, over that in LINEAR. The paper sees it below 200 g. Fixed on
# 2026-11-24,
# when submerged runs of 400 g ended at 97 g (the first window was seen, the second was not) and the dry one was whole;
# below
# 50 g the heap on the bottom slows the dry flow. What the heap does above that, the dry run in the same window tells.
SURGE = ((200, 100), (100, 50))
# For particles of 1 mm, which start from 150 g, and for those of 2 mm beside them: the window and what it is compared
# with. Fixed on
# 2026-11-25, before any of 1 mm was run. The second leaves out how the flow of 150 g sets in, and was chosen after the
# run.
SURGE_OF_150, BEFORE_IT, BEFORE_IT_STEADY = (100, 50), (142.5, 100), (130, 100)
BINS_OF_START, BINS_OF_CURVE = 5, 12
STOPPED = 0.05  # of the rate at the start: below it the hopper counts as empty
END = 0.3  # s of a run that show whether it still flows
USUAL_FILL = 100  # g, of which there are most runs
DRAWS = 400  # of a fit's data, for the uncertainty of what follows from it


class MissingRuns(Exception):
    """Which entries of the parameter study would have to be run."""


@dataclass(frozen=True)
class Value:
    mean: float
    error: float  # one standard error

    def __str__(self) -> str:
        return f"{self.mean:.4g} +- {self.error:.2g}"


def difference(one: Value, other: Value) -> Value:
    return Value(one.mean - other.mean, float(np.hypot(one.error, other.error)))


def ratio(above: Value, below: Value) -> Value:
    mean = above.mean / below.mean
    return Value(mean, abs(mean) * np.hypot(above.error / above.mean, below.error / below.mean))


class HopperRun:
    """One m(t), in g and s."""

    def __init__(self, run: Any) -> None:
        self.run, self.name, self.step = run, run.name, run.step
        self.entry = run.case.split("-")[0]
        self.parameters = run.parameters
        self.friction = run.parameters["friction"]
        self.time, self.mass = run.time, 1e3 * run.mass
        self.particle_mass = 1e3 * run.parameters["particleDensity"] * pi / 6 * run.parameters["particleDiameter"] ** 3
        self.fill = self.particle_mass * run.parameters["particleCount"]

    def mean_rate(self, upper: float, lower: float) -> float:
        """g/s while the hopper holds between two parts of its fill."""
        return flow.required_mean_rate(self.time, self.mass, upper, lower)

    def rates(self, upper: float, lower: float, bins: int) -> tuple[np.ndarray, np.ndarray]:
        """Mass and rate in the middle of equal shares of the fill."""
        edges = np.linspace(upper, lower, bins + 1)
        rates = np.array([self.mean_rate(*pair) for pair in zip(edges, edges[1:])])
        return self.mass[0] * (edges[1:] + edges[:-1]) / 2, rates

    @cached_property
    def clogged(self) -> bool:
        """Whether an arch over the orifice ended the flow before it had a rate."""
        return not self.has_start and self.last_rate == 0

    @property
    def has_start(self) -> bool:
        return self.mass[-1] < START[1] * self.mass[0]

    @cached_property
    def last_rate(self) -> float:
        """g/s at the end of the run."""
        end = self.time > self.time[-1] - END
        return -np.polyfit(self.time[end], self.mass[end], 1)[0] if np.ptp(self.mass[end]) else 0

    @property
    def ends_in_heap(self) -> bool:
        """Whether it went on until the heap on the bottom shows; else it may tell its rate at the start only."""
        return self.mass[-1] < CURVED[-1] * self.mass[0]

    def rate_between(self, upper: float, lower: float) -> Value:
        """Mean rate while the hopper holds between two parts of its fill; its error from how the rate varies
        meanwhile."""
        _, rates = self.rates(upper, lower, BINS_OF_START)
        return Value(self.mean_rate(upper, lower), np.std(rates, ddof=1) / np.sqrt(len(rates)))

    @cached_property
    def start_rate(self) -> Value:
        """The paper's W, "at the beginning"."""
        return self.rate_between(*START)

    def gain(self, late: tuple[float, float], early: tuple[float, float]) -> Value:
        """Mean rate while so many g are left, over that while more were."""
        if self.mass[-1] > late[1]:
            raise MissingRuns(f"{self.name} ended before {late[1]:g} g were left")
        return ratio(self.rate_while_left(*late), self.rate_while_left(*early))

    def rate_while_left(self, upper: float, lower: float) -> Any:
        """As rateBetween, of masses in g."""
        return self.rate_between(upper / self.mass[0], lower / self.mass[0])

    @cached_property
    def rise(self) -> Value:
        """What the rate gains, as a part of its mean, while half of the fill leaves: slope of W against m.

        A straight m(t) has none. The error is the regression's, from the scatter round it."""
        mass, rates = self.rates(*CURVED, BINS_OF_CURVE)
        fit = stats.linregress(mass, rates)
        scale = 0.5 * self.mass[0] / rates.mean()
        return Value(-fit.slope * scale, fit.stderr * scale)

    @cached_property
    def rate_exponent(self) -> Value:
        """p of W ~ m^p: 1/2 for a fluid that leaves by Torricelli's law."""
        mass, rates = self.rates(*CURVED, BINS_OF_CURVE)
        fit = stats.linregress(np.log(mass), np.log(rates))
        return Value(fit.slope, fit.stderr)

    @cached_property
    def emptying_time(self) -> float | None:
        """t_c: when the flow stops. None where the run ended before."""
        if self.last_rate > STOPPED * self.start_rate.mean:
            return None
        return flow.emptying_time(*self.padded, STOPPED * self.start_rate.mean)

    @cached_property
    def padded(self) -> tuple[Any, Any]:
        """m(t) with what follows: nothing leaves any more."""
        after = np.arange(1, 500) * 0.01
        return np.append(self.time, self.time[-1] + after), np.append(self.mass, np.full(len(after), self.mass[-1]))

    def paper_rate(self) -> Any:
        """t and W(t) as the paper takes it."""
        return flow.smoothed_rate(*self.padded, deviation=paper.WINDOW_DEVIATION)

    @property
    def upper_half(self) -> Any:
        """The masses, in g, between which the paper fits its straight line."""
        return tuple(part * self.fill for part in LINEAR)

    def line(self) -> Any:
        """Slope and height of the straight line through the upper half of m(t)."""
        upper, lower = self.upper_half
        part = (self.mass < upper) & (self.mass > lower)
        return np.polyfit(self.time[part], self.mass[part], 1)


@cache
def all_runs() -> tuple[HopperRun, ...]:
    """All committed runs, each checked against its own inputs."""
    runs = tuple(HopperRun(run) for run in parameter_study_results.read(RESULTS / "runs"))
    for run in runs:
        check(run)
    return runs


def check(run: HopperRun) -> None:
    """A curve that is not that of its inputs must not be drawn."""
    record = json.loads(parameter_study_results.files(RESULTS / "runs")[run.name].read_text())
    problems = []
    if abs(run.mass[0] - run.fill) > 0.01 * run.fill:
        problems.append(f"m(t) begins with {run.mass[0]:.4g} g, the inputs say {run.fill:.4g} g")
    if record["summary"]["particles_lost"] != 0:
        problems.append(f"{record['summary']['particles_lost']} particles were lost")
    if run.entry != "paperMesh" and not run.has_start and not run.clogged:
        problems.append(f"it ended before {100 - 100 * START[1]:g} % had left, without an arch")
    if np.any(np.diff(run.time) <= 0):
        problems.append("its times do not increase")
    swept = run.run.case.removeprefix(run.entry).removeprefix("-")
    if run.entry.startswith("fill") and swept and not isclose(float(swept), run.friction):
        problems.append(f"its friction is {run.friction:g}")
    if any("dirty" in version for version in record["code"]):
        problems.append("it was made by a program that no commit holds")
    if problems:
        raise SystemExit(f"cases/paper/results/runs.zip: {run.name}: {'; '.join(problems)}")


def of_entries(begin: str, step: str, **wanted: Any) -> list[HopperRun]:
    """Runs of the entries that begin so, of a step and with the parameters wanted, in order of fill and friction."""
    found = [
        run
        for run in all_runs()
        if run.step == step
        and run.entry.startswith(begin)
        and all(isclose(run.parameters[name], value) for name, value in wanted.items())
    ]
    return sorted(found, key=lambda run: (run.fill, run.friction))


def by_friction(runs: Iterable[HopperRun]) -> dict[float, list[HopperRun]]:
    found: dict[float, list[HopperRun]] = {}
    for run in runs:
        found.setdefault(run.friction, []).append(run)
    return found


def fills(step: str, **wanted: Any) -> list[HopperRun]:
    """Runs of the entries fill..., of a step and with the parameters wanted, in order of fill; without clogged ones."""
    return [run for run in with_clogged(step, **wanted) if not run.clogged]


def with_clogged(step: str, **wanted: Any) -> list[HopperRun]:
    return of_entries("fill", step, **wanted)


def clogged_runs(step: str, **wanted: Any) -> list[HopperRun]:
    return [run for run in with_clogged(step, **wanted) if run.clogged]


def by_fill(step: str, friction: float, whole: bool = False) -> dict[int, list[HopperRun]]:
    """{fill in g: runs}, the largest fill last; of whole discharges only, where wanted."""
    found: dict[int, list[HopperRun]] = {}
    for run in fills(step, friction=friction):
        if run.emptying_time or not whole:
            found.setdefault(round(run.fill), []).append(run)
    return found


def deepest(step: str, friction: float, whole: bool = False) -> list[HopperRun]:
    """The runs with the largest fill there is: one or several packings."""
    found = by_fill(step, friction, whole)
    if not found:
        clogged = "".join(f"; {run.name} clogged" for run in clogged_runs(step, friction=friction))
        raise MissingRuns(f"no {step} run with a friction of {friction:g}: entries fill100, fill200, fill400{clogged}")
    return found[max(found)]


def deepest_of_both(friction: float) -> dict[str, list[HopperRun]]:
    """{step: runs} of the largest fill that has been run dry and submerged, so that the water alone makes the
    difference."""
    found = {step: by_fill(step, friction) for step in paper.STEPS}
    common: set[int] = set.intersection(*(set(fills_of_step) for fills_of_step in found.values()))
    if not common:
        raise MissingRuns(f"no fill with a friction of {friction:g} in both: entries fill100, fill200, fill400")
    return {step: fills_of_step[max(common)] for step, fills_of_step in found.items()}


def mean(values: Sequence[Value]) -> Value:
    """Of runs that differ by their packing. Few runs: the larger of their scatter and of their own errors counts."""
    means = [value.mean for value in values]
    within = np.hypot.reduce([value.error for value in values]) / len(values)
    between = np.std(means, ddof=1) / np.sqrt(len(means)) if len(means) > 1 else 0
    return Value(float(np.mean(means)), float(max(within, between)))


def sweep(step: str) -> dict[float, list[HopperRun]]:
    """Runs of the fill with the most frictions, the larger fill where two have as many: {friction: [run, ...]}."""
    by_fill: dict[int, dict[float, list[HopperRun]]] = {}
    for run in fills(step):
        by_fill.setdefault(round(run.fill), {}).setdefault(run.friction, []).append(run)
    if not by_fill:
        raise MissingRuns(f"no {step} run: entries fill100, fill200, fill400")
    return by_fill[max(by_fill, key=lambda fill: (len(by_fill[fill]), fill))]


@dataclass(frozen=True)
class FrictionLaw:
    """W = W_o + A exp(-mu/mu_o), and as many more as were drawn within the errors of the rates."""

    fits: np.ndarray  # rows of W_o, A, mu_o; the first is the fit to the means

    def rate(self, friction: Any, fit: int = 0) -> Any:
        asymptote, amplitude, scale = self.fits[fit]
        return asymptote + amplitude * np.exp(-np.asarray(friction) / scale)

    def band(self, friction: Any) -> Any:
        """Between what 16 and what 84 % of the draws have."""
        drawn = [self.rate(friction, fit) for fit in range(1, len(self.fits))]
        return np.percentile(drawn, [16, 84], axis=0)

    def through(self, rates: Any, common: Any) -> Any:
        """The same shape through other runs' rates at some frictions, {friction: rate}: one factor for all, each draw's
        to rates drawn within their errors, which count for more where they scatter more, and all off by one common
        part."""
        frictions = np.array(list(rates))
        means, errors = np.array([rate.mean for rate in rates.values()]), np.array(
            [rate.error for rate in rates.values()]
        )
        shapes = np.array([self.rate(frictions, fit) for fit in range(len(self.fits))])

        def factors(values: Any) -> Any:
            return (values * shapes / errors**2).sum(axis=1) / (shapes**2 / errors**2).sum(axis=1)

        best = factors(means)[0]
        spread = errors * max(1, scatter_over_errors(means - best * shapes[0], errors, parameters=1))
        random = np.random.default_rng(20170328)
        drawn = (means + spread * random.standard_normal(shapes.shape)) * (
            1 + common * random.standard_normal((len(shapes), 1))
        )
        scale = np.append(best, factors(drawn)[1:])[:, None]
        return FrictionLaw(self.fits * np.hstack([scale, scale, np.ones_like(scale)]))

    def over(self, other: Any, friction: float) -> Any:
        """The one's rate over the other's, of which it is the shape: draw by draw, so that what both share does not
        count."""
        return self._value(
            np.array([self.rate(friction, fit) / other.rate(friction, fit) for fit in range(len(self.fits))])
        )

    def value(self, friction: float) -> Any:
        """The rate with its error."""
        return self._value(np.array([self.rate(friction, fit) for fit in range(len(self.fits))]))

    def parameter(self, index: Any) -> Any:
        return self._value(self.fits[:, index])

    def friction_at(self, rate: Any) -> Any:
        """Where the law has this rate; an error of infinity where more than a tenth of the draws has it nowhere."""
        asymptote, amplitude, scale = self.fits.T
        inside = (rate > asymptote) & (rate < asymptote + amplitude)
        found = np.full(len(inside), np.nan)
        found[inside] = scale[inside] * np.log(amplitude[inside] / (rate - asymptote[inside]))
        return self._value(found)

    @staticmethod
    def _value(values: Any) -> Any:
        drawn = values[1:][np.isfinite(values[1:])]
        missing = 1 - len(drawn) / (len(values) - 1)
        # half of the central 68 %: some draws lie far out
        error = np.subtract(*np.percentile(drawn, [84, 16])) / 2 if missing < 0.1 else np.inf
        return Value(float(values[0]), float(error))


@cache
def friction_law(step: str) -> FrictionLaw:
    """The paper's fit to the rates of a sweep. Needs three frictions; three leave nothing to check it by."""
    by_friction = sweep(step)
    if len(by_friction) < 3:
        raise MissingRuns(f"{len(by_friction)} frictions are not enough for a fit, {step}: entry fill200")
    frictions = np.array(list(by_friction))
    rates = [mean([run.start_rate for run in runs]) for runs in by_friction.values()]
    means, errors = np.array([rate.mean for rate in rates]), np.array([rate.error for rate in rates])

    def fit(values: Any) -> Any:
        start = (values.min() - 0.1, values.max() - values.min() + 0.1, 0.15)

        def deviations(law: Any) -> Any:
            return (law[0] + law[1] * np.exp(-frictions / law[2]) - values) / errors

        return optimize.least_squares(deviations, start, bounds=([0, 0, 0.01], [np.inf, np.inf, 2])).x

    best = fit(means)
    spread = errors * max(
        1, scatter_over_errors(means - (best[0] + best[1] * np.exp(-frictions / best[2])), errors, len(best))
    )
    random = np.random.default_rng(20170327)
    draws = [fit(means + spread * random.standard_normal(len(means))) for _ in range(DRAWS)]
    return FrictionLaw(np.array([best, *draws]))


def scatter_over_errors(residuals: Any, errors: Any, parameters: Any) -> Any:
    """Square root of chi2 per degree of freedom of a fit; 1 where there is none."""
    freedom = len(residuals) - parameters
    return np.sqrt(((residuals / errors) ** 2).sum() / freedom) if freedom > 0 else 1.0


def matching(step: Any, whole: Any = False) -> Any:
    """The deepest runs at the friction that the paper finds to match; at the dry one's, where those are from a larger
    fill or of more packings."""

    def worth(friction: float) -> tuple[Any, int, bool]:
        fill, runs = max(by_fill(step, friction, whole).items(), default=(0, []))
        return fill, len(runs), friction == paper.MATCHING_FRICTION[step]

    return deepest(step, max({paper.MATCHING_FRICTION[step], paper.MATCHING_FRICTION["dry"]}, key=worth), whole)


def variants(step: Any) -> Any:
    """Runs that differ from one of the entry fill100 by their mesh or by how stiff the particles are, by what
    differs."""
    found = {}
    for run in all_runs():
        if run.step == step and run.entry == "cells":
            found[f"{run.parameters['meshLevel']} mesh"] = run
        if run.step == step and run.entry == "stiff":
            found[f"particles of {run.parameters['youngsModulus'] / 1e6:g} MPa"] = run
    return found


def stiff_with_clogged(step: Any) -> Any:
    """{friction: runs} of the paper's fill with stiffer particles on a finer mesh."""
    return by_friction(of_entries("match", step))


def described(run: Any) -> str:
    """What tells these from the runs of the sweep."""
    return f"{run.fill:.0f} g, {run.parameters['youngsModulus'] / 1e6:g} MPa, {run.parameters['meshLevel']} mesh"


def stiff_runs(step: Any) -> Any:
    """The same without clogged ones."""
    found = by_friction(run for run in of_entries("match", step) if not run.clogged)
    if not found:
        raise MissingRuns(f"no {step} run of the paper's fill with stiffer particles on a finer mesh: entry match")
    return found


@cache
def stiff_law(step: Any) -> Any:
    """The sweep's fit, through the rates of the paper's fill with stiffer particles on a finer mesh."""
    runs_of = stiff_runs(step)
    packings = min(len(runs) for runs in runs_of.values())
    return friction_law(step).through(
        {friction: mean([run.start_rate for run in runs]) for friction, runs in runs_of.items()},
        packing_scatter(step) / np.sqrt(packings),
    )


def packing_scatter(step: str) -> float:
    """Standard deviation over packings, of the mean: from the largest fill that has several."""
    rates = [run.start_rate.mean for run in deepest(step, paper.MATCHING_FRICTION["dry"])]
    if len(rates) < 2:
        raise MissingRuns("no fill of two packings: entries fill400packings, fill200packings")
    return float(np.std(rates, ddof=1) / np.mean(rates))


def small_particles(step: str) -> list[HopperRun]:
    """Runs of particles of 1 mm in the full simulator."""
    return of_entries("particles1mm", step)


def of_usual_fill(step: str) -> list[HopperRun]:
    """Runs at the friction that the paper finds to match the dry rate."""
    found = [
        run
        for run in fills(step, friction=paper.MATCHING_FRICTION["dry"])
        if isclose(run.fill, USUAL_FILL, rel_tol=0.01)
    ]
    if not found:
        raise MissingRuns(f"no {step} run of {USUAL_FILL} g: entry fill100")
    return found
