#!/usr/bin/python3
"""Figure 8: rate against t - t_c: slope of a parabola in a 2 s Gaussian window, as the paper takes it."""


import output
import paper
import series

from clepsydra.picture_style import pyplot


def main(folder: output.Folder) -> None:
    figure, axes = pyplot.subplots(figsize=output.SIZE)
    rows = []
    for step in paper.STEPS:
        runs, curves = series.matching(step, whole=True), []
        for run in runs:
            time, rate = run.paper_rate()
            curves.append((output.significant(time - run.emptying_time), output.significant(rate)))
            rows += [(step, run.friction, run.name, *row) for row in output.thinned(*curves[-1])]
        output.band(axes, curves, output.COLOUR[step], f"{step}, $\\mu$ = {runs[0].friction:g}, {runs[0].fill:.0f} g")
        output.measured_rate(axes, step)
    axes.set(xlabel="$t - t_c$ [s]", ylabel="rate $W$ [g/s]", ylim=(0, None), xlim=(None, 3))
    axes.legend(loc="lower left")
    folder.picture(figure, "figure8")
    folder.numbers("figure8", ["step", "friction [-]", "run", "t - t_c [s]", "W [g/s]"], rows)


output.command(main, __doc__, ["fill100", "fill200", "fill400"])
