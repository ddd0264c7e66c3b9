"""Particles and walls of the hopper in its mid-plane."""

from typing import Any

import numpy as np
from matplotlib.collections import EllipseCollection
from repository import hopper

from clepsydra import picture_style


def walls(axes: Any, whole: Any = False) -> None:
    p = hopper()
    orifice, radius, height = p["orificeDiameter"] / 2, p["hopperDiameter"] / 2, p["hopperHeight"]
    land, bevel = p["landHeight"], p["bevelHeight"]
    for side in (-1, 1):
        axes.plot(
            side * np.array([radius, radius, orifice, orifice, orifice + bevel]),
            [height, 0, 0, -land, -land - bevel],
            "k",
            lw=2,
        )
    if whole:
        tank = p["tankDiameter"] / 2
        axes.plot(
            [-tank, -tank, tank, tank],
            [height + p["waterAboveRim"], -p["tankDepth"], -p["tankDepth"], height + p["waterAboveRim"]],
            color="0.5",
        )


def speeds(slab: Any, view: Any) -> Any:
    """Of the particles in view."""
    position, velocity, _ = slab
    inside = (
        (position[:, 0] > view[0])
        & (position[:, 0] < view[1])
        & (position[:, 2] > view[2])
        & (position[:, 2] < view[3])
    )
    return np.linalg.norm(velocity[inside], axis=1)


def particles(
    axes: Any, position: np.ndarray, velocity: np.ndarray, radius: Any, fastest: float, arrows: Any = False
) -> Any:
    """Circles as large as the plane cuts them; the colour is the speed in space."""
    order = np.argsort(-np.abs(position[:, 1]))
    position, velocity, radius = position[order], velocity[order], radius[order]
    cut = 2 * np.sqrt(radius**2 - position[:, 1] ** 2)
    circles = EllipseCollection(
        cut,
        cut,
        np.zeros(len(cut)),
        units="xy",
        offsets=position[:, [0, 2]],
        transOffset=axes.transData,
        cmap=picture_style.PARTICLES,
        edgecolors="k",
        linewidths=0.3,
    )
    circles.set_array(np.linalg.norm(velocity, axis=1))
    circles.set_clim(0, fastest)
    axes.add_collection(circles)
    if arrows:
        axes.quiver(position[:, 0], position[:, 2], velocity[:, 0], velocity[:, 2], color="0.2", scale=4, width=0.003)
    return circles
