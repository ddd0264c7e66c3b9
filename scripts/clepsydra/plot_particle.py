#!/usr/bin/python3
"""Height and speed of a particle against time, from particleHeight.dat, with the speed that it would reach alone in
unlimited liquid."""

import argparse
from pathlib import Path

from clepsydra import case_files, closures, parameter_file, picture_style
from clepsydra.picture_style import pyplot


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "case", type=Path, metavar="CASE", help="a case with `parameters` as tutorials/settlingParticle has"
    )
    parser.add_argument("file", type=Path, metavar="FILE", help="the picture")
    given = parser.parse_args()
    case, file = given.case, given.file
    entries = parameter_file.parameters(case / "parameters")
    terminal = closures.value(
        "terminalVelocity",
        **{
            name: entries[name]
            for name in ("dragLaw", "particleDiameter", "particleDensity", "fluidDensity", "fluidViscosity")
        },
    )
    time, height, velocity = case_files.columns(case, "particleHeight")[:3]

    figure, (above, below) = pyplot.subplots(2, 1, figsize=(6, 4.5), sharex=True, constrained_layout=True)
    above.plot(time, 1e3 * height, color=picture_style.LINE)
    above.set(ylabel="height of the centre [mm]", ylim=(0, None))
    below.plot(time, -velocity, color=picture_style.LINE, label="the particle, downwards")
    below.axhline(
        terminal, color="black", linewidth=0.8, linestyle="--", label=f"{entries['dragLaw']}, terminal velocity"
    )
    below.set(xlabel="time [s]", ylabel="speed [m/s]", xlim=(0, None))
    below.legend()
    for axes in (above, below):
        axes.grid(alpha=0.3)
    figure.savefig(file, dpi=picture_style.DPI)


if __name__ == "__main__":
    main()
