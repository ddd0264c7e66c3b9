#!/usr/bin/python3
"""Figure 1: particles that the mid-plane cuts near the orifice, coloured by speed, dry and submerged; packing at the
exit."""


import exit_flow
import hopper_drawing
import output
import paper
from matplotlib.ticker import MultipleLocator

from clepsydra.picture_style import pyplot

VIEW = (-0.016, 0.016, -0.009, 0.023)


def main(folder: output.Folder) -> None:
    figure, panels = pyplot.subplots(1, 3, figsize=(13, 4.9), gridspec_kw={"width_ratios": [1, 1, 0.7]})
    fastest = max(hopper_drawing.speeds(exit_flow.slab(step), VIEW).max() for step in paper.STEPS)
    for axes, step in zip(panels, paper.STEPS):
        particles = hopper_drawing.particles(axes, *exit_flow.slab(step), fastest, arrows=True)
        hopper_drawing.walls(axes)
        axes.xaxis.set_major_locator(MultipleLocator(0.01))
        axes.set(xlim=VIEW[:2], ylim=VIEW[2:], aspect="equal", title=output.PANEL[step], xlabel="x [m]", ylabel="z [m]")
    figure.colorbar(particles, ax=panels[:2], label="speed [m/s]", shrink=0.8)
    rows = []
    for step in paper.STEPS:
        profile = exit_flow.profile(step)
        share, error = profile.mean(profile.share)
        flux, _ = profile.mean(profile.flux)
        panels[2].errorbar(share, 1e3 * profile.height, xerr=error, color=output.COLOUR[step], label=step, capsize=2)
        rows += [(step, *map(float, row)) for row in zip(profile.height, share, error, flux)]
    panels[2].axhspan(-1, 0, color="0.9", label="land of the orifice")
    panels[2].set(xlabel="solid share of the circle D", ylabel="height [mm]", xlim=(0, 0.75), title="(c) packing")
    panels[2].legend(fontsize=8)
    folder.picture(figure, "figure1")
    folder.numbers(
        "figure1", ["step", "height [m]", "solid fraction [-]", "error [-]", "downward solid flux [m/s]"], rows
    )


output.command(main, __doc__, ["fill100"], after_run=exit_flow.keep_all)
