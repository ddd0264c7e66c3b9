#!/usr/bin/python3
"""Mass in the hopper and rate of outflow against time, from massInHopper.dat.

Writes FOLDER/mass.png and FOLDER/rate.png with one curve for each case directory, named after it. """

import argparse
from pathlib import Path

import numpy as np

from clepsydra import case_files, flow, picture_style
from clepsydra.picture_style import pyplot


def draw(path: Path, curves: list[tuple[str, np.ndarray, np.ndarray]], ylabel: str, title: str) -> None:
    figure, axes = pyplot.subplots(figsize=(6, 4), constrained_layout=True)
    for name, x, y in curves:
        axes.plot(x, y, label=name, color=picture_style.STEPS.get(name))
    axes.set(xlabel="time [s]", ylabel=ylabel, title=title, ylim=(0, None), xlim=(0, None))
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(path, dpi=picture_style.DPI)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="FOLDER")
    parser.add_argument("cases", type=Path, metavar="CASE", nargs="+")
    given = parser.parse_args()
    folder, cases = given.folder, [case.resolve() for case in given.cases]
    folder.mkdir(parents=True, exist_ok=True)

    masses, rates = [], []
    for case in cases:
        time, mass = case_files.columns(case, "massInHopper")[:2]
        masses.append((case.name, time, 1e3 * mass))
        at, rate = flow.smoothed_rate(time, 1e3 * mass)
        rates.append((case.name, at, rate))

    draw(folder / "mass.png", masses, "mass in the hopper [g]", "")
    draw(
        folder / "rate.png",
        rates,
        "rate of outflow [g/s]",
        f"slope of a parabola in a Gaussian window, sd {flow.DEVIATION} s",
    )


if __name__ == "__main__":
    main()
