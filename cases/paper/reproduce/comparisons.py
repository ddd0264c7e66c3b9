"""Quantities that the paper measured or simulated, beside ours: groups of rows, and what must hold of them.

A row is never wrong for being far off. A group fails where its runs are missing or contradict each other, or where a
claim that is made of them (`require`) is not borne out. """

from typing import Any

import exit_flow
import numpy as np
import paper
import series
from repository import hopper
from scipy import stats
from series import Value, difference, ratio

from clepsydra import closures

SIGNIFICANT = 3  # standard errors
KEYS = ("quantity", "unit", "measured", "paperSimulation", "ours", "uncertainty", "residualPercent", "runs")


class ClaimFailed(Exception):
    """What was claimed and is not so."""


def row(quantity: str, unit: str, ours: Any, runs: Any, measured: Any = None, simulated: Any = None) -> dict[str, Any]:
    """The residual is against the measurement; without one, against the paper's simulation."""
    reference = simulated if measured is None else measured
    return dict(
        zip(
            KEYS,
            (
                quantity,
                unit,
                measured,
                simulated,
                float(f"{ours.mean:.5g}"),
                float(f"{ours.error:.2g}") if np.isfinite(ours.error) else None,
                round(100 * (ours.mean / reference - 1), 2) if reference else None,
                runs,
            ),
        )
    )


def require(claim: Any, holds: bool) -> None:
    print(f"  {'holds' if holds else 'DOES NOT HOLD'}: {claim}")
    if not holds:
        raise ClaimFailed(claim)


def names(runs: Any) -> list[Any]:
    return [run.name for run in runs]


def rates() -> Any:
    """W at the start, at the frictions that the paper finds to match, from every fill."""
    found = []
    for step in paper.STEPS:
        for friction in sorted({paper.MATCHING_FRICTION[step], paper.MATCHING_FRICTION["dry"]}):
            simulated = paper.RATE[step] if friction == paper.MATCHING_FRICTION[step] else None
            by_fill = series.by_fill(step, friction)
            if not by_fill:
                print(f"  not run yet: {step}, mu = {friction:g}")
            for fill, runs in by_fill.items():
                found.append(
                    row(
                        f"W_{step}, mu = {friction:g}, {fill} g",
                        "g/s",
                        series.mean([run.start_rate for run in runs]),
                        names(runs),
                        paper.RATE[step],
                        simulated,
                    )
                )
    if not found:
        raise series.MissingRuns("no run at a friction that matches: entries fill100, fill200, fill400")
    return found


def ratio_of_rates() -> list[Any]:
    """W_sub/W_dry: of one friction, so that the water alone makes the difference."""
    friction = paper.MATCHING_FRICTION["dry"]
    runs_of = series.deepest_of_both(friction)
    ours = ratio(*(series.mean([run.start_rate for run in runs_of[step]]) for step in ("submerged", "dry")))
    require(
        "under water the hopper is slower, by more than three standard errors", 1 - ours.mean > SIGNIFICANT * ours.error
    )
    return [
        row(
            f"W_submerged/W_dry, mu = {friction:g} in both",
            "-",
            ours,
            names(sum(runs_of.values(), [])),
            paper.RATE["submerged"] / paper.RATE["dry"],
        )
    ]


def matching_friction() -> Any:
    """mu at which our rate would be the measured one, and W_o, from the paper's fit."""
    found = []
    for step in paper.STEPS:
        law = series.friction_law(step)
        runs = names([run for repeats in series.sweep(step).values() for run in repeats])
        matching = law.friction_at(paper.RATE[step])
        if np.isfinite(matching.mean):
            found.append(
                row(
                    f"mu_{step} that matches the measured rate",
                    "-",
                    matching,
                    runs,
                    simulated=paper.MATCHING_FRICTION[step],
                )
            )
        else:
            print(
                f"  {step}: no friction matches, for the fit's rate stays above {paper.RATE[step]:g} g/s, the"
                " measured one"
            )
        found.append(row(f"W_o,{step}", "g/s", law.parameter(0), runs, simulated=paper.ASYMPTOTIC_RATE[step]))
        found.append(row(f"mu_o,{step} of the fit", "-", law.parameter(2), runs))
    return found


def stiff() -> Any:
    """The same of the paper's fill with stiffer particles on a finer mesh: the fit's shape through the rates of those
    runs."""
    friction, found, rates, frictions, used = paper.MATCHING_FRICTION["dry"], [], {}, {}, []
    for step in paper.STEPS:
        runs_of, law, sweep = series.stiff_runs(step), series.stiff_law(step), series.friction_law(step)
        for at, runs in runs_of.items():
            rate = series.mean([run.start_rate for run in runs])
            print(f"  {step}, mu = {at:g}: {ratio(rate, sweep.value(at))} of the sweep's fit")
            found.append(
                row(f"W_{step}, mu = {at:g}, {series.described(runs[0])}", "g/s", rate, names(runs), paper.RATE[step])
            )
        for at, tried in series.stiff_with_clogged(step).items():
            found += arches(f"{step}, mu = {at:g}, {series.described(tried[0])}", tried)
        runs = names(sum(runs_of.values(), []))
        used += runs
        found.append(row(f"factor of W_{step} over the sweep's fit", "-", law.over(sweep, friction), runs))
        rates[step] = law.value(friction)
        frictions[step] = law.friction_at(paper.RATE[step])
        found.append(
            row(
                f"mu_{step} that matches the measured rate, with these",
                "-",
                frictions[step],
                runs,
                simulated=paper.MATCHING_FRICTION[step],
            )
        )
    found.append(
        row(
            f"W_submerged/W_dry with these, mu = {friction:g} in both",
            "-",
            ratio(rates["submerged"], rates["dry"]),
            used,
            paper.RATE["submerged"] / paper.RATE["dry"],
        )
    )
    return found + [
        row("mu_submerged less mu_dry, with these", "-", difference(frictions["submerged"], frictions["dry"]), used),
        row(
            "W_submerged at the friction that matches the dry rate, with these",
            "g/s",
            rate_at(series.stiff_law("submerged"), frictions["dry"]),
            used,
            paper.RATE["submerged"],
        ),
    ]


def rate_at(law: Any, friction: Value) -> Value:
    """The law's rate, with its own error and the friction's."""
    rate = law.value(friction.mean)
    change = law.rate(friction.mean - friction.error) - law.rate(friction.mean + friction.error)
    return Value(rate.mean, float(np.hypot(rate.error, change / 2)))


def surge() -> Any:
    """How straight m(t) is, at both frictions that the paper finds to match; what is claimed is of the one with three
    packings."""
    found, rises, gain = surge_at(paper.MATCHING_FRICTION["dry"])
    first = gain[series.SURGE[0]]["submerged over dry"]
    require(
        "m(t) is straight dry: no rise beyond three standard errors",
        rises["dry"].mean < SIGNIFICANT * rises["dry"].error,
    )
    require(
        f"from 200 to 100 g the rate gains more under water than dry ({first}), beyond three standard errors",
        first.mean - 1 > SIGNIFICANT * first.error,
    )
    found += surge_at(paper.MATCHING_FRICTION["submerged"])[0]
    early = series.deepest("dry", paper.MATCHING_FRICTION["dry"])[0].upper_half
    return found + [wilson_gain(window, early) for window in series.SURGE]


def surge_at(friction: float) -> tuple[Any, Any, Any]:
    """Rows, what the rate gains while half of the fill leaves, and what it is late over what it was early, by
    window."""
    runs_of = series.deepest_of_both(friction)
    rises = {step: series.mean([run.rise for run in runs]) for step, runs in runs_of.items()}
    found = [
        row(
            f"rise of W while half of {runs[0].fill:.0f} g leaves, {step}, mu = {friction:g}",
            "-",
            rises[step],
            names(runs),
        )
        for step, runs in runs_of.items()
    ]
    more = difference(rises["submerged"], rises["dry"])
    found.append(row(f"rise of W, submerged less dry, mu = {friction:g}", "-", more, names(sum(runs_of.values(), []))))
    early, gain = runs_of["dry"][0].upper_half, {}
    for window in series.SURGE:
        rows, gain[window] = gains(runs_of, window, early, f"mu = {friction:g}: ")
        found += rows
    for name, rise in (*rises.items(), ("submerged less dry", more)):
        print(f"  mu = {friction:g}, rise of W, {name}: {rise}, {rise.mean / rise.error:+.1f} standard errors")
    return found, rises, gain


def gains(runs_of: Any, late: Any, early: Any, of_what: Any) -> tuple[Any, Any]:
    """W while so many g are left over W while more were: rows, and the values of each medium and of the one over the
    other, which frees it of the heap."""
    what = "{}W from {} to {} g over W from {:.4g} to {:.4g} g".format(of_what, *late, *early)
    gains_of = {step: [run.gain(late, early) for run in runs] for step, runs in runs_of.items()}
    gain = {step: series.mean(values) for step, values in gains_of.items()}
    found = [row(f"{what}, {step}", "-", value, names(runs_of[step])) for step, value in gain.items()]
    of_packings = [ratio(*pair) for pair in zip(gains_of["submerged"], gains_of["dry"], strict=True)]
    gain["submerged over dry"] = series.mean(of_packings)
    if len(of_packings) > 1:
        means = [one.mean for one in of_packings]
        print(
            f"  {what}, submerged over dry of each packing: {', '.join(f'{one:.3f}' for one in means)}; one-sided "
            f"p = {stats.ttest_1samp(means, 1, alternative='greater').pvalue:.2g}"
        )
    found.append(row(f"{what}, submerged over dry", "-", gain["submerged over dry"], names(sum(runs_of.values(), []))))
    return found, gain


def wilson_gain(late: Any, early: Any) -> Any:
    return row(
        "W from {} to {} g over W from {:.4g} to {:.4g} g, by the formula of Wilson et al. (2014)".format(
            *late, *early
        ),
        "-",
        Value(paper.wilson_rate(*late) / paper.wilson_rate(*early), 0),
        [],
    )


def surge_of_small_particles() -> Any:
    """The paper's figure 3: the surge grows as the particles get smaller. Ours: 150 g of particles of 1 mm."""
    large = series.deepest_of_both(paper.MATCHING_FRICTION["dry"])
    small = {step: series.small_particles(step) for step in paper.STEPS}
    if not all(small.values()):
        raise series.MissingRuns("no dry or no submerged run with particles of 1 mm: entry particles1mm")
    found, changes = [], {}
    for early in (series.BEFORE_IT, series.BEFORE_IT_STEADY):
        of_large, gain_of_large = gains(large, series.SURGE_OF_150, early, "d = 2 mm: ")
        of_small, gain_of_small = gains(small, series.SURGE_OF_150, early, "d = 1 mm: ")
        found += [*of_large, *of_small]
        for what, gain in gain_of_small.items():
            change = changes[early, what] = ratio(gain, gain_of_large[what])
            print(f"  the gain over {early[0]:g} to {early[1]:g} g of 1 mm over that of 2 mm, {what}: {change}")
            runs = [run for step in paper.STEPS if step in what for run in small[step] + large[step]]
            found.append(row(f"the same of 1 mm over that of 2 mm, {what}", "-", change, names(runs)))
        found.append(wilson_gain(series.SURGE_OF_150, early))
    change = changes[series.BEFORE_IT, "submerged over dry"]
    require(
        (
            "under water more than dry, the rate gains more with particles of 1 mm than of 2 mm, beyond three standard"
            " errors"
        ),
        change.mean - 1 > SIGNIFICANT * change.error,
    )
    return found


def numerical_choices() -> Any:
    """What finer meshes and stiffer particles than the parameter study's make of the rate at the start."""
    found = []
    for step in paper.STEPS:
        usual = series.of_usual_fill(step)
        for what, run in series.variants(step).items():
            change = ratio(run.start_rate, series.mean([its.start_rate for its in usual]))
            found.append(row(f"W_{step} with {what} over W", "-", change, names(usual) + [run.name]))
    if not found:
        raise series.MissingRuns("no run on another mesh or with stiffer particles: entries cells and stiff")
    return found


def emptying() -> Any:
    """Time that 500 g need at mu = .8: from the deepest run there is, and its rate at the start for what it lacks."""
    found, times = [], {}
    for step in paper.STEPS:
        clogging = arches(
            f"{step}, mu = {paper.EMPTYING_FRICTION:g}", series.with_clogged(step, friction=paper.EMPTYING_FRICTION)
        )
        found += clogging
        if clogging and not series.fills(step, friction=paper.EMPTYING_FRICTION):
            continue
        runs = series.deepest(step, paper.EMPTYING_FRICTION)
        whole = [run for run in runs if run.emptying_time] or runs  # others were stopped when their rate was known
        times[step] = series.mean([emptying_of(run) for run in whole])
        found.append(
            row(
                f"time to empty {paper.EMPTYING_MASS} g, {step}, mu = {paper.EMPTYING_FRICTION:g}"
                + (f", extrapolated from {runs[0].fill:.0f} g" if runs[0].fill < 0.99 * paper.EMPTYING_MASS else ""),
                "s",
                times[step],
                names(whole),
                simulated=paper.EMPTYING_TIME[step],
            )
        )
        found.append(
            row(
                f"W_{step}, mu = {paper.EMPTYING_FRICTION:g}, {runs[0].fill:.0f} g",
                "g/s",
                series.mean([run.start_rate for run in runs]),
                names(runs),
                simulated=paper.EMPTYING_MASS / paper.EMPTYING_TIME[step],
            )
        )
    if len(times) == len(paper.STEPS):
        longer = difference(times["submerged"], times["dry"])
        require("500 g need longer under water", longer.mean > SIGNIFICANT * longer.error)
    return found


def arches(what: Any, tried: Any) -> list[Any]:
    """A row of the runs that an arch over the orifice ended, where there are any."""
    clogged = [run for run in tried if run.clogged]
    if not clogged:
        return []
    left = series.mean([Value(run.mass[0] - run.mass[-1], run.particle_mass) for run in clogged])
    return [
        row(
            f"what leaves before an arch closes the orifice, {what}, {len(clogged)} of {len(tried)} runs",
            "g",
            left,
            names(clogged),
        )
    ]


def emptying_of(run: Any) -> Any:
    if not run.emptying_time:
        raise series.MissingRuns(f"{run.name} ended before its flow did")
    lacking = (paper.EMPTYING_MASS - run.fill) / run.start_rate.mean
    # the deeper part may also flow at the mean rate of the whole: the rise is not known to go on or to end
    drift = lacking * abs(run.rise.mean)
    return Value(
        run.emptying_time + lacking, float(np.hypot(lacking * run.start_rate.error / run.start_rate.mean, drift))
    )


def torricelli() -> Any:
    """W ~ m^p nearly without friction: p = 1/2 for a Newtonian fluid, 0 for Beverloo's grains."""
    found = []
    for step in paper.STEPS:
        runs = series.deepest(step, paper.SMOOTH_FRICTION)
        exponent = series.mean([run.rate_exponent for run in runs])
        rough = series.mean([run.rate_exponent for run in series.deepest(step, paper.MATCHING_FRICTION["dry"])])
        found.append(
            row(
                f"p of W ~ m^p, {step}, mu = {paper.SMOOTH_FRICTION:g} (Torricelli: .5)",
                "-",
                exponent,
                names(runs),
                simulated=0.5,
            )
        )
        less = difference(exponent, rough)
        require(
            f"{step}, without friction the rate falls with the height ({exponent}), with friction less ({rough})",
            exponent.mean > SIGNIFICANT * exponent.error and less.mean > SIGNIFICANT * less.error,
        )
    return found


def table_i() -> Any:
    """Re and C_d by Brown & Lawler's fit to measured spheres, and by the drag law that the runs use; I as printed."""
    found, p = [], hopper()
    water = {name: p[name] for name in ("fluidDensity", "fluidViscosity")}
    excess = p["particleDensity"] / p["fluidDensity"] - 1
    for law in ("BrownLawlerDrag", p["dragLaw"]):
        for particle in paper.TABLE_1:
            speed = closures.value(
                "terminalVelocity",
                dragLaw=law,
                particleDiameter=particle.diameter,
                particleDensity=p["particleDensity"],
                **water,
            )
            reynolds = speed * particle.diameter / p["fluidViscosity"]
            drag = closures.value(
                "dragCoefficient", dragLaw=law, particleDiameter=particle.diameter, slipSpeed=speed, **water
            )
            inertial = 4 * p["fluidViscosity"] / (excess * speed * p["orificeDiameter"])
            for name, ours, printed in (
                ("Re", reynolds, particle.reynolds),
                ("C_d", drag, particle.drag_coefficient),
                ("I = 4 eta/(rho_e v_t D)", inertial, particle.inertial_number),
            ):
                found.append(
                    row(
                        f"Table I: {name}, d = {1e2 * particle.diameter:g} cm, {law}",
                        "-",
                        Value(ours, 0),
                        [],
                        simulated=printed,
                    )
                )
    return found


def packing_at_the_exit() -> Any:
    """The paper says that the packing is denser there under water; it gives no number."""
    shares = {step: exit_flow.profile(step).share_at(0) for step in paper.STEPS}
    found = [
        row(f"share of the orifice inside particles, {step}, mu = .15", "-", share, [exit_flow.run_of(step)])
        for step, share in shares.items()
    ]
    more = difference(shares["submerged"], shares["dry"])
    found.append(
        row(
            "share of the orifice inside particles, submerged less dry",
            "-",
            more,
            [exit_flow.run_of(step) for step in paper.STEPS],
        )
    )
    print(f"  submerged less dry: {more}, {more.mean / more.error:+.1f} standard errors")
    return found


GROUPS = {
    "rates": rates,
    "ratioOfRates": ratio_of_rates,
    "matchingFriction": matching_friction,
    "stiff": stiff,
    "surge": surge,
    "surgeOfSmallParticles": surge_of_small_particles,
    "numericalChoices": numerical_choices,
    "emptying": emptying,
    "torricelli": torricelli,
    "tableI": table_i,
    "packingAtTheExit": packing_at_the_exit,
}


def table(rows: Any) -> str:
    """Lines of text."""

    def shown(value: Any) -> Any:
        return "-" if value is None else value if isinstance(value, str) else f"{value:.4g}"

    lines: list[tuple[str, ...]] = [("quantity", "unit", "measured", "paper's simulation", "ours", "+-", "residual %")]
    lines += [tuple(shown(one[key]) for key in KEYS[:-1]) for one in rows]
    widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in lines)
