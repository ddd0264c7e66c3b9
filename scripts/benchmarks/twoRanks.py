"""One rank against two, in wall time. Only a machine with nothing else to do shows what two ranks can do."""

from . import timing
from .hopper import forgetResults, solver


def speedupCoupled(hopper, repetitions):
    return speedup(hopper, repetitions, "submerged", 0.1 if hopper.quick else 1)


def speedupDry(hopper, repetitions):
    return speedup(hopper, repetitions, "dry", 0.3 if hopper.quick else 1)


def speedup(hopper, repetitions, stage, duration):
    runs = {}
    for ranks in (1, 2):
        folder = hopper.stage(stage, f"{stage}On{ranks}", duration, ranks)
        runs[ranks] = timing.Run(solver(ranks), folder, prepare=lambda folder=folder: forgetResults(folder))
    times = timing.interleaved(runs, repetitions)
    return timing.Figure(
        timing.ratios(times, 1, 2, "wall"), target=">= 1.8",
        meaning=f"wall time on 1 rank over that on 2, {stage}, first {duration} s of the drain",
        details={f"{ranks} ranks": [time.wall for time in of] for ranks, of in times.items()})
