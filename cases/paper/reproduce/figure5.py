#!/usr/bin/python3
"""Figure 5: mass in the hopper against t - t_c for all frictions, dry and submerged, with the end magnified."""

from typing import Any, Iterator

import matplotlib
import numpy as np
import output
import paper
import series

from clepsydra.picture_style import pyplot

END = (-6, 1, 0, 60)  # the inset: s, g


def main(folder: output.Folder) -> None:
    colour = colours({runs[0].friction for step in paper.STEPS for runs in deepest_of_each(step)})
    figure, panels = pyplot.subplots(1, 2, figsize=(11, output.SIZE[1]), sharey=True)
    rows = []
    for axes, step in zip(panels, paper.STEPS):
        inset = axes.inset_axes([0.60, 0.56, 0.38, 0.4])
        for runs in deepest_of_each(step):
            friction = runs[0].friction
            curves = [(output.significant(run.time - run.emptying_time), run.mass) for run in runs]
            for place in (axes, inset):
                output.band(place, curves, colour[friction], f"$\\mu$ = {friction:g}, {runs[0].fill:.0f} g")
            for run, curve in zip(runs, curves):
                rows += [(step, friction, run.name, *row) for row in output.thinned(*curve)]
        for time, mass in newtonian(step):
            axes.plot(time, mass, "k--", lw=1, label="Newtonian fluid")
            rows += [(step, 0.0, "Newtonian fluid", *row) for row in output.thinned(time, mass, rows=100)]
        axes.set(title=output.PANEL[step], xlabel="$t - t_c$ [s]", ylim=(0, None), xlim=(None, 2))
        inset.set(xlim=END[:2], ylim=END[2:])
        axes.legend(loc="lower left", fontsize=7)
    panels[0].set_ylabel("mass in the hopper [g]")
    folder.picture(figure, "figure5")
    folder.numbers("figure5", ["step", "friction [-]", "run", "t - t_c [s]", "mass [g]"], rows)


def deepest_of_each(step: Any) -> list[Any]:
    """Of each friction the whole discharges from the largest fill there is."""
    frictions = sorted({run.friction for run in series.fills(step) if run.emptying_time})
    if not frictions:
        raise series.MissingRuns(f"no {step} run until its end: entries fill100, fill200")
    return [series.deepest(step, friction, whole=True) for friction in frictions]


def newtonian(step: Any) -> Iterator[Any]:
    """Torricelli's m(t), with mass and rate at the start from the run nearly without friction: no more is chosen."""
    for run, *_ in deepest_of_each(step):
        if run.friction == paper.SMOOTH_FRICTION:
            start, _ = run.rates(*series.START, 1)
            duration = 2 * np.sqrt(start[0] * run.fill) / run.start_rate.mean
            time = np.linspace(-duration, 0)
            yield output.significant(time), output.significant(run.fill * (time / duration) ** 2)


def colours(frictions: Any) -> dict[str, Any]:
    """From blue, nearly without friction, to red; as far apart as they can be, since two frictions may be close."""
    ordered = sorted(frictions)
    return dict(zip(ordered, matplotlib.colormaps["turbo"](np.linspace(0.08, 0.92, len(ordered)))))


output.command(main, __doc__, ["fill100", "fill100start", "fill200"])
