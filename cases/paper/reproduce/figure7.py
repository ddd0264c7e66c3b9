#!/usr/bin/python3
"""Figure 7: mass in the hopper against time with the straight line through its upper half; inset: how far m(t) leaves
it."""


import output
import paper
import series

from clepsydra.picture_style import pyplot


def main(folder: output.Folder) -> None:
    figure, axes = pyplot.subplots(figsize=(7, 5))
    inset = axes.inset_axes([0.6, 0.6, 0.38, 0.37])
    rows = []
    for step in paper.STEPS:
        runs, colour = series.matching(step), output.COLOUR[step]
        output.band(
            axes, [(run.time, run.mass) for run in runs], colour, f"{step}, $\\mu$ = {runs[0].friction:g}", lw=2.5
        )
        aside = []
        for number, run in enumerate(runs):
            slope, height = run.line()
            line = output.significant(height + slope * run.time)
            above = line > 0
            axes.plot(
                run.time[above],
                line[above],
                color="k",
                lw=0.7,
                label=None if number else f"line through its upper half: {-slope:.2f} g/s",
            )
            # against what is gone by the line, which grows
            aside.append((run.mass[0] - line[above], output.significant(run.mass - line)[above]))
            rows += [(step, run.friction, run.name, *row) for row in output.thinned(run.time, run.mass, line)]
        output.band(inset, aside, colour)
        end = runs[0].mass[0] / paper.RATE[step]
        axes.plot([0, end], [runs[0].mass[0], 0], ":", color=colour, label=f"measured rate, {paper.RATE[step]} g/s")
    axes.set(xlabel="time [s]", ylabel="mass in the hopper [g]", xlim=(0, None), ylim=(0, None))
    inset.axhline(0, color="k", lw=0.5)
    inset.set(xlabel="gone by the line [g]", ylabel="$m$ - line [g]")
    inset.text(0.05, 0.92, "below zero: a surge", transform=inset.transAxes, va="top", fontsize=9)
    axes.legend(loc="lower left")
    folder.picture(figure, "figure7")
    folder.numbers("figure7", ["step", "friction [-]", "run", "time [s]", "mass [g]", "line [g]"], rows)


output.command(main, __doc__, ["fill100", "fill200", "fill400"])
