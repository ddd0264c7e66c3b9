#!/usr/bin/python3
"""Figure 2b: the hopper in its tank, as it is computed: particles that the mid-plane cuts, and the walls."""


import exit_flow
import hopper_drawing
import output
from matplotlib.ticker import MultipleLocator
from repository import hopper

from clepsydra.picture_style import pyplot


def main(folder: output.Folder) -> None:
    figure, axes = pyplot.subplots(figsize=(5, 7.5))
    position, velocity, radius = exit_flow.slab("submerged")
    hopper_drawing.particles(axes, position, 0 * velocity, radius, 1)
    hopper_drawing.walls(axes, whole=True)
    p = hopper()
    for text, x, z in (
        (f"$D_h$ = {1e2 * p['hopperDiameter']:g} cm", 0, 0.15),
        (f"$D$ = {1e2 * p['orificeDiameter']:g} cm", 0.045, -0.003),
        ("particles d = 0.2 cm, seen 1 s after opening", 0, -0.076),
    ):
        axes.text(x, z, text, ha="center", fontsize=9)
    axes.xaxis.set_major_locator(MultipleLocator(0.05))
    axes.set(aspect="equal", ylim=(-0.085, None), xlabel="x [m]", ylabel="z [m]")
    folder.picture(figure, "figure2")
    folder.numbers(
        "figure2",
        list(exit_flow.SLAB_COLUMNS[:3]) + ["radius [m]"],
        [(*map(float, place), float(size)) for place, size in zip(position, radius)],
    )


output.command(main, __doc__, ["fill100"])
