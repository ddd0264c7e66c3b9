#!/usr/bin/python3
"""The surge: rate against what is left, from every fill and particle at the friction that the paper finds to match the
dry rate, and from the largest fill at that of the submerged one.

No figure of the paper's: its figure 8 shows the rate against time. """

from typing import Any

import numpy as np
import output
import paper
import series

from clepsydra.picture_style import pyplot

BIN = 20  # g
LAST = 40  # g: below it the heap on the bottom shows
STYLE = {100: ":", 200: "--", 400: "-"}


def main(folder: output.Folder) -> None:
    figure, (axes, beside) = pyplot.subplots(1, 2, figsize=(11, output.SIZE[1]), width_ratios=(3, 2))
    rows = draw_fills(axes) + draw_sizes(beside)
    folder.picture(figure, "surge")
    folder.numbers("surge", ["step", "fill [g]", "run", "mass [g]", "W [g/s]"], rows)


def draw_fills(axes: Any) -> Any:
    """The rate of particles of 2 mm."""
    rows, other = [], paper.MATCHING_FRICTION["submerged"]
    beside = series.deepest_of_both(other)
    for step in paper.STEPS:
        for fill, runs in series.by_fill(step, paper.MATCHING_FRICTION["dry"]).items():
            rows += draw(axes, runs, lambda run: 1, output.COLOUR[step], f"{step}, {fill} g", STYLE.get(fill, "-."))
        rows += draw(
            axes,
            beside[step],
            lambda run: 1,
            output.COLOUR[step],
            f"{step}, {beside[step][0].fill:.0f} g, $\\mu$ = {other:g}",
            "-.",
        )
        output.measured_rate(axes, step)
    deepest = series.deepest_of_both(paper.MATCHING_FRICTION["dry"])["submerged"]
    early = series.mean([run.rate_between(*series.LINEAR) for run in deepest]).mean
    left = np.arange(380, LAST, -BIN)
    scale = early / paper.wilson_rate(*deepest[0].upper_half)
    expected = [scale * paper.wilson_rate(mass, mass - BIN) for mass in left]
    axes.plot(
        BIN / 2 - left,
        output.significant(expected),
        color="k",
        lw=0.8,
        label=f"rise of Wilson et al. (2014), {deepest[0].fill:.0f} g",
    )
    finish(axes, series.SURGE, "rate $W$ [g/s]")
    axes.set_ylim(5, 14)
    return rows


def draw_sizes(axes: Any) -> Any:
    """Particles of 1 and of 2 mm over the same masses, relative to each one's rate before the window."""
    early = series.BEFORE_IT

    def scale(run: Any) -> Any:
        return run.rate_while_left(*early).mean

    large = series.deepest_of_both(paper.MATCHING_FRICTION["dry"])
    rows = []
    for step in paper.STEPS:
        draw(axes, large[step], scale, output.COLOUR[step], f"{step}, 2 mm", "--")  # their rows are drawFills'
        rows += draw(axes, series.small_particles(step), scale, output.COLOUR[step], f"{step}, 1 mm", "-")
    finish(axes, [series.SURGE_OF_150], "$W$ over $W$ from {:.0f} to {:.0f} g".format(*early))
    axes.set(xlim=(-early[0], -LAST), ylim=(0.85, 1.1))
    return rows


def draw(axes: Any, runs: Any, scale: Any, colour: Any, label: str, style: Any) -> Any:
    """Those of the runs that go on for long enough, each over its scale; rows of what they are, without it."""
    curves, rows = [], []
    for run in runs:
        if run.ends_in_heap:
            mass, rate = binned(run)
            curves.append((-mass, output.significant(rate / scale(run))))
            rows += [(run.step, round(run.fill), run.name, *row) for row in zip(map(float, mass), map(float, rate))]
    if curves:
        output.band(axes, curves, colour, label, ls=style)
    return rows


def finish(axes: Any, windows: Any, label: str) -> None:
    for shade, window in zip(("0.93", "0.86"), windows):
        axes.axvspan(*(-mass for mass in window), color=shade, zorder=0)
    axes.xaxis.set_major_formatter(lambda mass, _: f"{-mass:g}")
    axes.set(xlabel="left in the hopper [g]", ylabel=label)
    axes.legend(loc="lower left", ncol=2, fontsize=7)


def binned(run: Any) -> tuple[Any, Any]:
    """Mean rate of each 20 g, from 95 % of the fill on."""
    edges = np.arange(BIN * int(0.95 * run.mass[0] / BIN), LAST - 1, -BIN)
    edges = edges[edges > run.mass[-1]]
    rates = [run.mean_rate(*(edge / run.mass[0] for edge in pair)) for pair in zip(edges, edges[1:])]
    return (edges[1:] + edges[:-1]) / 2, output.significant(rates)


output.command(main, __doc__, ["fill100", "fill200", "fill400", "fill400packings", "particles1mm"])
