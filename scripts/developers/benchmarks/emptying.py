"""One rank against two as the bed empties: from checkpoints of one run, so that both begin with the same particles."""

import json
import shutil
from pathlib import Path
from typing import Any

from clepsydra import case_files

from . import timing
from .hopper import Hopper, solver
from .two_ranks import loop_seconds

# Parts of the fill that remain, and the length of each window [s]
REMAINING = (1.0, 0.5, 0.12)
WINDOW = 0.04


def speedup_emptying(hopper: Hopper, repetitions: int) -> timing.Figure:
    """Figures of the three windows in `details`; the value is the least of their medians."""
    folder = discharged(hopper)
    speedups = {}
    for remaining in REMAINING:
        start = start_of(folder, remaining)
        runs = {ranks: window(folder, start, ranks) for ranks in (1, 2)}
        times = timing.interleaved(runs, repetitions)
        seconds = {ranks: [loop_seconds(time.result) for time in of] for ranks, of in times.items()}
        speedups[remaining] = [one / two for one, two in zip(seconds[1], seconds[2])]
    middle = {remaining: timing.Figure(of, "").median for remaining, of in speedups.items()}
    return timing.Figure(
        speedups[min(middle, key=lambda remaining: middle[remaining])],
        target=">= 1.8",
        details={"remaining": speedups},
        meaning=f"wall time on 1 rank over that on 2, submerged, windows of {WINDOW} s; with "
        + ", ".join(f"{of:.2f} while {100 * remaining:.0f} % remain" for remaining, of in middle.items())
        + "; here the least",
    )


def discharged(hopper: Hopper) -> Any:
    """The submerged step with its checkpoints, until less than the last part remains."""
    folder = hopper.step("submerged", "discharged", 3.0)
    timing.timed(timing.Run(solver(), folder))
    return folder


def start_of(folder: Path, remaining: Any) -> Any:
    """The write time at which most nearly this part of the fill remains."""
    at, _, particles = case_files.columns(folder, "massInHopper")[:3]
    written = [float(path.name) for path in (folder / "checkpoints").iterdir() if path.name != "beginning"]
    return min([0.0, *written], key=lambda time: abs(particles[abs(at - time).argmin()] / particles[0] - remaining))


def window(folder: Path, start: Any, ranks: int) -> Any:
    """A run of this length from the checkpoint at `start`."""
    name = f"{start:g}"
    part = folder.parent / f"from{name}On{ranks}"
    shutil.rmtree(part, ignore_errors=True)
    shutil.copytree(folder, part, symlinks=True, ignore=shutil.ignore_patterns("postProcessing", "VTK", "[0-9]*"))
    shutil.rmtree(part / "checkpoints", ignore_errors=True)
    shutil.copytree(folder / name, part / name)
    if start > 0:
        shutil.copytree(folder / "checkpoints" / name, part / "checkpoints" / name)
        shutil.copy(folder / "checkpoints" / "beginning", part / "checkpoints")
    with open(part / "step", "a") as step:
        step.write(f"stepEndTime {start + WINDOW};\nfieldInterval 10;\n")
    Hopper.in_folder(part.parent.parent, f"./Allrun -np {ranks} -prepare {part.name}")
    if ranks > 1:
        Hopper.in_folder(part, "decomposePar -latestTime > log.decomposePar 2>&1")
    return timing.Run(solver(ranks), part, prepare=lambda: forget(part, name), result=lambda: newest_balance(part))


def forget(part: Any, kept: Any) -> None:
    """What a window wrote; what it starts from stays."""
    for pattern in ("postProcessing", "VTK", "[0-9]*", "processor*/[0-9]*", "checkpoints/[0-9]*"):
        for path in part.glob(pattern):
            if path.name != kept:
                shutil.rmtree(path)


def newest_balance(part: Any) -> Any:
    return json.loads(next((part / "postProcessing/conservation").glob("*/summary.json")).read_text())
