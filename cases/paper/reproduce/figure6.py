#!/usr/bin/python3
"""Figure 6: rate at the start against friction, dry and submerged, with the paper's fit and what was measured; dashed:
of the paper's fill with stiffer particles on a finer mesh."""

from typing import Any, Iterator

import numpy as np
import output
import paper
import series

from clepsydra.picture_style import pyplot

FRICTIONS = np.linspace(0, 0.85, 100)
INSET_END = 0.6  # beyond it the fits are less than .05 g/s above their limits


def main(folder: output.Folder) -> None:
    figure, axes = pyplot.subplots(figsize=(7, 6.2))
    inset = axes.inset_axes([0.58, 0.66, 0.4, 0.32])
    rows: list[tuple[Any, ...]] = []
    for step in paper.STEPS:
        rows += draw_runs(axes, step)
        axes.errorbar(
            paper.MATCHING_FRICTION[step],
            paper.RATE[step],
            paper.RATE_ERROR,
            ls="none",
            ms=11,
            mew=2,
            **output.MEASURED[step],
            label=f"measured {paper.RATE[step]} g/s, at the paper's friction",
        )
        draw_fit(axes, inset, step)
    axes.set(xlabel="friction $\\mu$", ylabel="rate at the start $W$ [g/s]", xlim=(-0.02, 0.85), ylim=(0, None))
    inset.set(yscale="log", xlabel="$\\mu$", ylabel="$W - W_o$ [g/s]", xlim=(-0.02, 0.85), ylim=(0.04, None))
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=2, fontsize=7)
    folder.picture(figure, "figure6")
    folder.numbers("figure6", ["step", "friction [-]", "fill [g]", "run", "W [g/s]", "error [g/s]"], rows)


def draw_runs(axes: Any, step: Any) -> Iterator[Any]:
    """Means over packings; paler where the fill is not that of the sweep."""
    swept = series.sweep(step)
    points: dict[Any, Any] = {}
    for run in series.fills(step):
        points.setdefault((round(run.fill), run.friction), []).append(run)
        yield step, run.friction, run.fill, run.name, *map(
            float, output.significant([run.start_rate.mean, run.start_rate.error])
        )
    for (fill, friction), runs in points.items():
        label = f"{step}, {fill} g"
        known = label in axes.get_legend_handles_labels()[1]
        rate = series.mean([run.start_rate for run in runs])
        axes.errorbar(
            friction,
            *output.significant([rate.mean, rate.error]),
            ls="none",
            color=output.COLOUR[step],
            alpha=1 if runs == swept.get(friction) else 0.4,
            label=None if known else label,
            **output.MARKER[step],
        )
    for number, run in enumerate(series.clogged_runs(step)):
        axes.plot(
            run.friction,
            0,
            "v",
            color=output.COLOUR[step],
            clip_on=False,
            label=None if number else f"{step}: an arch closes the orifice",
        )
        yield step, run.friction, run.fill, run.name, "clogged", ""


def draw_fit(axes: Any, inset: Any, step: Any) -> None:
    try:
        law = series.friction_law(step)
    except series.MissingRuns as missing:
        print(f"figure6: no fit: {missing}")
        return
    asymptote = law.parameter(0)
    axes.fill_between(
        FRICTIONS, *map(output.significant, law.band(FRICTIONS)), color=output.COLOUR[step], alpha=0.25, lw=0
    )
    axes.plot(
        FRICTIONS,
        output.significant(law.rate(FRICTIONS)),
        color=output.COLOUR[step],
        label=f"$W_o$ = {asymptote} g/s (paper {paper.ASYMPTOTIC_RATE[step]}), $\\mu_o$ = {law.parameter(2)}",
    )
    draw_stiff(axes, step)
    shown = FRICTIONS < INSET_END
    inset.plot(
        FRICTIONS[shown], output.significant(law.rate(FRICTIONS) - asymptote.mean)[shown], color=output.COLOUR[step]
    )
    for friction, runs in series.sweep(step).items():
        rate = series.mean([run.start_rate for run in runs])
        inset.errorbar(
            friction,
            *output.significant([rate.mean - asymptote.mean, rate.error]),
            color=output.COLOUR[step],
            ms=4,
            **output.MARKER[step],
        )


def draw_stiff(axes: Any, step: Any) -> None:
    law, runs_of = series.stiff_law(step), series.stiff_runs(step)
    axes.fill_between(
        FRICTIONS, *map(output.significant, law.band(FRICTIONS)), color=output.COLOUR[step], alpha=0.12, lw=0
    )
    axes.plot(FRICTIONS, output.significant(law.rate(FRICTIONS)), "--", lw=1, color=output.COLOUR[step])
    for number, (friction, runs) in enumerate(runs_of.items()):
        rate = series.mean([run.start_rate for run in runs])
        axes.errorbar(
            friction,
            *output.significant([rate.mean, rate.error]),
            fmt="d",
            ms=5,
            color=output.COLOUR[step],
            mfc="w",
            label=None if number else f"{step}, {series.described(runs[0])}",
        )


output.command(main, __doc__, ["fill100", "fill100start", "fill200", "match"])
