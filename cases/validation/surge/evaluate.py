#!/usr/bin/python3
"""The late rise of the rate, with the way of the water through the bed open and closed."""

import sys
from typing import Any

import numpy as np

from clepsydra import flow, parameter_study_results, validation
from clepsydra.picture_style import pyplot

WHOLE, START = (0.95, 0.4), (0.98, 0.92)  # of the fill
EARLY, LATE = (0.95, 0.75), (0.55, 0.4)
ALIKE = 5  # %, of two ways to compute the same
RISE = 20  # %, of a rise measured in another hopper
DURIAN = "Koivisto & Durian, Nat. Commun. 8:15551 (2017): no surge where the flow through the packing is fixed"
WILSON = "Wilson et al., Papers in Physics 6, 060009 (2014): up to 1.25, in other hoppers"
DILATION = (
    "the rise does not need d(eps)/dt: a steady dilation at the orifice reaches the water through div(eps U), "
    "and d(eps)/dt only adds the water that takes the place of the particles that left"
)


def rise(run: Any) -> Any:
    return flow.required_mean_rate(run.time, run.mass, *LATE) / flow.required_mean_rate(run.time, run.mass, *EARLY)


def start_rate(run: Any) -> Any:
    return flow.required_mean_rate(run.time, run.mass, *START)


def main() -> None:
    cases = parameter_study_results.by_case(parameter_study_results.read("results/runs"))
    quick = parameter_study_results.by_case(parameter_study_results.read("results/quick"))
    found = {case: [rise(run) for run in runs] for case, runs in cases.items()}
    deviation = parameter_study_results.pooled_deviation(found.values())
    rises = {case: parameter_study_results.mean_and_error(values, deviation) for case, values in found.items()}
    rows = [
        against(rises, "open", 1.25, 0, WILSON, "measured", RISE),
        against(rises, "closedLid", 1, 0, DURIAN, "measured", 2 * ALIKE),
        against(rises, "dry", 1, 0, "no water, no pumping", "computed", 2 * ALIKE),
        against(rises, "noDilation", *rises["open"], "the same with d(eps)/dt", "computed", ALIKE, DILATION),
        against(rises, "noLowPass", *rises["open"], "the same with the low-pass of d(eps)/dt", "computed", ALIKE),
    ]
    validation.write(rows + [of_lid(quick or cases)])
    require_mechanism(cases, rises)
    plot(cases)


def against(
    rises: Any, case: Any, reference: Any, its_error: Any, source: Any, kind: Any, tolerance: float, finding: Any = None
) -> Any:
    ours, error = rises[case]
    return validation.row(
        f"late over early rate, {case}",
        "-",
        reference,
        source,
        kind,
        ours,
        float(np.hypot(error, its_error)),
        tolerance,
        finding,
    )


def of_lid(cases: Any) -> Any:
    """What the lid takes from the rate at the start. The reference is the committed runs', also of a short fresh
    run."""
    ratio = {
        name: np.mean([start_rate(run) for run in found["closedLid"]])
        / np.mean([start_rate(run) for run in found["open"]])
        for name, found in (
            ("now", cases),
            ("committed", parameter_study_results.by_case(parameter_study_results.read("results/runs"))),
        )
    }
    return validation.row(
        "rate with a lid over rate without, at the start",
        "-",
        ratio["committed"],
        "results/runs of this case",
        "computed",
        ratio["now"],
        0.05 * ratio["committed"],
        15,
    )


def require_mechanism(cases: Any, rises: Any) -> None:
    """With the lid the water must come up through the orifice, against the particles: far slower, beyond any
    scatter."""
    for case, (mean, error) in sorted(rises.items()):
        print(f"surge: late over early rate, {case}: {mean:.3f} +- {error:.3f}")
    rates = {
        case: [flow.required_mean_rate(run.time, run.mass, *WHOLE) for run in cases[case]]
        for case in ("open", "closedLid")
    }
    deviation = parameter_study_results.pooled_deviation(rates.values())
    (free, free_error), (closed, closed_error) = (
        parameter_study_results.mean_and_error(rates[case], deviation) for case in ("open", "closedLid")
    )
    if free - closed < 3 * np.hypot(free_error, closed_error):
        sys.exit("surge: the lid does not slow the flow beyond three standard errors")


def plot(cases: Any) -> None:
    figure, axes = pyplot.subplots(figsize=(6, 4), constrained_layout=True)
    for number, (case, runs) in enumerate(sorted(cases.items())):
        for run in runs:
            time, rate = flow.smoothed_rate(run.time, run.mass)
            left = np.interp(time, run.time, run.mass) / run.mass[0]
            early = start_rate(run)
            axes.plot(left, rate / early, color=f"C{number}", alpha=0.7, label=case if run is runs[0] else None)
    axes.set(xlim=(1, 0.35), ylim=(0, 2), xlabel="part of the fill left", ylabel="rate / rate at the start")
    axes.legend()
    figure.savefig("results/surge.png", dpi=150)


if __name__ == "__main__":
    main()
