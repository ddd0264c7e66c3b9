"""Particles and water in the middle plane of a hopper, and the mass in it against time."""

import argparse
from pathlib import Path

from clepsydra import case_files, flow, flow_drawing, particle_files, picture_style


def main() -> None:
    parser = argparse.ArgumentParser(
        description=f"{__doc__} Of several cases the planes only, side by side. The colours are the speeds of the"
        " particles that the plane cuts and of the water, with its streamlines."
    )
    parser.add_argument(
        "--remaining",
        type=float,
        default=0.6,
        metavar="FRACTION",
        help="draw the written time nearest to that when the hopper holds this part of its particles (%(default)s)",
    )
    parser.add_argument("picture", type=Path, metavar="PICTURE")
    parser.add_argument("cases", type=Path, metavar="CASE", nargs="+")
    given = parser.parse_args()
    views = [flow_drawing.View(case) for case in given.cases]
    moments = [moment_of(case, view, given.remaining) for case, view in zip(given.cases, views)]
    if len(moments) == 1:
        (case,), (view,), (moment,) = given.cases, views, moments
        figure = flow_drawing.draw(case, view, moment, moment.fastest_particle(view), moment.fastest_water())
    else:
        figure = flow_drawing.draw_cases(given.cases, views, moments)
    given.picture.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(given.picture, dpi=picture_style.DPI, bbox_inches="tight")


def moment_of(case: Path, view: flow_drawing.View, remaining: float) -> flow_drawing.Moment:
    """The written time nearest to that when the hopper holds so much of its particles."""
    time, _, count = case_files.columns(case, "massInHopper")[:3]
    times = flow_drawing.written_times(case)
    at = particle_files.time_nearest(times, flow.time_at_mass(time, count, remaining * count[0]))
    return flow_drawing.Moment(case, view, at, *times[at])


if __name__ == "__main__":
    main()
