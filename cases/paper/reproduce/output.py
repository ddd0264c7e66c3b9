"""Pictures, the numbers behind them, and what the commands figure1, figure2, ... have in common."""

import argparse
import csv
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import paper
import series
from repository import CASE, PARAMETER_STUDY, RESULTS

from clepsydra import picture_style, whole_files
from clepsydra.environment import SCRIPTS
from clepsydra.picture_style import pyplot

# one style for all
SIZE = (7, 4.6)
pyplot.rcParams.update({"figure.constrained_layout.use": True, "legend.fontsize": 8, "lines.linewidth": 1.3})

# the paper's: dry red and open, submerged blue and filled
COLOUR = picture_style.STEPS
MARKER = {"dry": dict(marker="o", markerfacecolor="none"), "submerged": dict(marker="s")}
MEASURED = {"dry": dict(marker="x", color="tab:red"), "submerged": dict(marker="+", color="tab:blue")}
PANEL = {"dry": "(a) dry", "submerged": "(b) submerged"}

# Of s, g and g/s, what is drawn and written: far below what a particle (.01 g) makes, far above what processors and
# libraries of
# linear algebra differ by, some 1e-9 after a fit. So the files are the same everywhere.
DECIMALS = 3


def command(main: Any, description: Any, entries: Any, after_run: Any = None) -> None:
    """main() after the command line is read: --run runs first what of the parameter study's entries has no results yet.

    afterRun(folder): takes from the parameter study's work folder what its results do not hold."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument(
        "--run",
        action="store_true",
        help=(
            f"first run what has no results yet of the entries {', '.join(entries)} of {PARAMETER_STUDY}"
            if entries
            else "nothing has to be run for this one"
        ),
    )
    parser.add_argument("--into", metavar="FOLDER", type=Path, default=RESULTS / "figures")
    if after_run:
        parser.add_argument(
            "--from", dest="work", metavar="FOLDER", help="take it from this work folder of the parameter study"
        )
    given = parser.parse_args()
    if given.run and entries:
        run(entries)
    if after_run and (given.run or given.work):
        after_run(given.work or CASE / "work")
    try:
        main(Folder(given.into))
    except series.MissingRuns as missing:
        sys.exit(
            f"{sys.argv[0]}: {missing}; `scripts/parameterStudy run {PARAMETER_STUDY} --missing --only ENTRY` makes"
            " them"
        )


def run(entries: Any) -> None:
    with subprocess.Popen(
        [SCRIPTS / "parameterStudy", "run", PARAMETER_STUDY, "--missing", "--only", *entries]
    ) as parameter_study:
        try:
            status = parameter_study.wait()
        except KeyboardInterrupt:
            parameter_study.terminate()  # which lets its runs write their checkpoints
            parameter_study.wait()
            sys.exit(f"{sys.argv[0]}: stopped; the same command goes on")
    if status != 0:
        sys.exit(1)


def significant(values: Any) -> Any:
    """Rounded to DECIMALS, without the sign of a zero."""
    return np.round(values, DECIMALS) + 0.0


def band(axes: Any, curves: Any, colour: Any, label: str | None = None, **style: Any) -> None:
    """Curves (x, y) of several packings as their mean and, shaded, one standard deviation to each side; one curve as it
    is."""
    common = np.linspace(max(x[0] for x, _ in curves), min(x[-1] for x, _ in curves), 400)
    if len(curves) == 1:
        x, y = curves[0]
    else:
        on_common = np.array([np.interp(common, *curve) for curve in curves])
        x, y = common, significant(on_common.mean(axis=0))
        spread = significant(on_common.std(axis=0, ddof=1))
        axes.fill_between(x, y - spread, y + spread, color=colour, alpha=0.25, lw=0)
        label = label and f"{label}, {len(curves)} packings"
    axes.plot(x, y, color=colour, label=label, **style)


def measured_rate(axes: Any, step: Any) -> None:
    """The paper's, over what its last digit leaves open; it gives no error."""
    axes.axhspan(
        paper.RATE[step] - paper.RATE_ERROR, paper.RATE[step] + paper.RATE_ERROR, color=COLOUR[step], alpha=0.35, lw=0
    )
    axes.axhline(
        paper.RATE[step], ls=":", color=COLOUR[step], label=f"measured at 300 to 400 g, {paper.RATE[step]} g/s"
    )


class Folder:
    """Where pictures and the numbers behind them go."""

    def __init__(self, path: Path) -> None:
        self.path = path
        path.mkdir(parents=True, exist_ok=True)

    def picture(self, figure: Any, name: str) -> None:
        figure.savefig(self.path / f"{name}.png", dpi=picture_style.DPI, metadata={"Software": None})
        pyplot.close(figure)
        print(self.path / f"{name}.png")

    def numbers(self, name: str, head: Any, rows: Any) -> None:
        with whole_files.replacing(self.path / f"{name}.csv") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(head)
            table.writerows([f"{value:.6g}" if isinstance(value, float) else value for value in row] for row in rows)


def thinned(*columns: Any, rows: Any = 400) -> Any:
    """Some of the rows of long columns."""
    step = -(-len(columns[0]) // rows)
    return zip(*(map(float, significant(column[::step])) for column in columns))
