"""The picture of docs/benchmarks: where the time of a coupled run goes, and how fast the programs do DEM steps."""

import statistics
from pathlib import Path
from typing import Any

from clepsydra.picture_style import DPI, pyplot

from .coupled import FLUID

# Phases of a run as the picture has them, from the engines' own to the coupling's.
PHASES = {
    "DEM": ("DEM",),
    "pressure": ("pressure",),
    "momentum": ("momentum",),
    "smoothing": ("smooth",),
    "locating, distributing": ("locate", "distribute", "exchange"),
    "forces": ("forces",),
    "output, start": ("output", "other"),
}
PROGRAMS = {"ours": "Clepsydra", "LAMMPS": "LAMMPS", "Yade": "Yade"}


def draw(entries: dict[str, Any], file: Path) -> None:
    """From the entries of a file that scripts/benchmark has written."""
    figure, (times, steps) = pyplot.subplots(1, 2, figsize=(11, 3.6), gridspec_kw={"width_ratios": [3, 2]})
    draw_times(times, entries["coupledOverLiggghtsAndFluid"]["details"])
    draw_steps(steps, entries)
    figure.tight_layout()
    figure.savefig(file, dpi=DPI)


def draw_times(axes: Any, details: dict[str, Any]) -> None:
    """The coupled run beside LIGGGHTS and the same fluid solver apart, phase after phase."""
    coupled = {
        phase: statistics.median(sum(run[name] for name in names) for run in details["coupled"])
        for phase, names in PHASES.items()
    }
    apart = {phase: coupled[phase] if set(names) <= set(FLUID) else 0 for phase, names in PHASES.items()}
    apart["DEM"] = statistics.median(details["liggghts"])
    rows = {"Clepsydra": coupled, "LIGGGHTS and\nfluid solver\napart": apart}
    left = [0.0] * len(rows)
    for phase in PHASES:
        widths = [row[phase] for row in rows.values()]
        axes.barh(list(rows), widths, left=left, label=phase)
        left = [a + b for a, b in zip(left, widths)]
    axes.invert_yaxis()
    axes.set_xlabel("processor time [s]: submerged hopper, first 0.2 s, 3000 particles")
    axes.legend(ncols=4, fontsize=8, loc="lower center", bbox_to_anchor=(0.45, 1))


def draw_steps(axes: Any, entries: dict[str, Any]) -> None:
    """Dry particles, in a bed at rest and while they flow."""
    rest = {"ours": entries["overLammps"], "LAMMPS": entries["overLammps"], "Yade": entries["overYade"]}
    flow = entries["flowRates"]["details"]
    height = 0.38
    for offset, label, speeds in (
        (
            -height / 2,
            "bed at rest",
            {name: of["details"][name]["particleStepsPerSecond"] for name, of in rest.items()},
        ),
        (height / 2, "while it flows", {name: [flow[name]["particleStepsPerSecond"]] for name in PROGRAMS}),
    ):
        axes.barh(
            [place + offset for place in range(len(PROGRAMS))],
            [statistics.median(speeds[name]) / 1e6 for name in PROGRAMS],
            height,
            label=label,
        )
    axes.set_yticks(range(len(PROGRAMS)), list(PROGRAMS.values()))
    axes.invert_yaxis()
    axes.set_xlabel("million particles times DEM steps per second")
    axes.legend(fontsize=8)
