#!/usr/bin/python3
"""Particles and water in the middle plane of a hopper, and the mass in it against time: what a scale would read.

Usage: renderFlow [--remaining FRACTION] PICTURE CASE

Drawn at the written time nearest to the moment when the hopper holds FRACTION (0.6 unless given) of its particles: the particles that
the plane cuts, coloured by their speed; behind them the water's speed and its streamlines.
"""

import argparse
from pathlib import Path

from clepsydra import case_files, flow, flow_drawing, particle_files


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--remaining", type=float, default=0.6)
    arguments.add_argument("picture")
    arguments.add_argument("case", type=Path)
    given = arguments.parse_args()
    time, _, count = case_files.columns(given.case, "massInHopper")[:3]
    times = flow_drawing.written_times(given.case)
    at = particle_files.time_nearest(times, flow.time_at_mass(time, count, given.remaining * count[0]))
    view = flow_drawing.View(given.case)
    moment = flow_drawing.Moment(given.case, view, at, *times[at])
    figure = flow_drawing.draw(given.case, view, moment, moment.fastest_particle(view), moment.fastest_water())
    figure.savefig(given.picture, dpi=flow_drawing.picture_style.DPI, bbox_inches="tight")


if __name__ == "__main__":
    main()
