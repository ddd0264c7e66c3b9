#!/usr/bin/python3
"""Figure 3: rate over the rate long before the end, for particles of 2 mm and of 1 mm.

The paper divides by the rate 80 s before the end; runs as long as that are not there. Here it is the rate at the start.
"""


import output
import paper
import series

from clepsydra.picture_style import pyplot

STYLE = {2e-3: "-", 1e-3: "--"}


def main(folder: output.Folder) -> None:
    figure, axes = pyplot.subplots(figsize=output.SIZE)
    rows, missing = [], []
    for step in paper.STEPS:
        for diameter, runs_of in ((2e-3, series.of_usual_fill), (1e-3, series.small_particles)):
            curves = []
            for run in runs_of(step):
                if run.emptying_time:
                    time, rate = run.paper_rate()
                    relative = output.significant(rate / run.start_rate.mean)
                    curves.append((output.significant((time - run.emptying_time) / run.emptying_time), relative))
                    rows += [
                        (step, diameter, run.name, *row) for row in output.thinned(time - run.emptying_time, relative)
                    ]
                    label = f"{step}, d = {1e2 * diameter:g} cm, {run.fill:.3g} g"
            if curves:
                output.band(axes, curves, output.COLOUR[step], label, ls=STYLE[diameter])
            else:
                missing.append(step)
    axes.axhline(1, color="k", lw=0.5)
    axes.set(xlabel="$(t - t_c)/t_c$", ylabel="$W/W_{start}$", ylim=(0, 1.4), xlim=(-1, 0.1))
    axes.legend(loc="lower left")
    folder.picture(figure, "figure3")
    folder.numbers("figure3", ["step", "particle diameter [m]", "run", "t - t_c [s]", "W/W_start [-]"], rows)
    if missing:
        print(
            f"figure3: no curve {' and '.join(missing)} of particles of 1 mm, for no run has gone on until its flow"
            " stopped: entry particles1mm of the parameter study"
        )


output.command(main, __doc__, ["fill100", "particles1mm"])
