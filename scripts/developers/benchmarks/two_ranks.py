"""One rank against two, in wall time. Only a machine with nothing else to do shows what two ranks can do."""

from typing import Any

from developers.benchmarks.hopper import Hopper

from . import timing


def speedup_coupled(hopper: Hopper, repetitions: int) -> timing.Figure:
    return speedup(hopper, repetitions, "submerged", 0.2 if hopper.quick else 0.1)


def speedup_dry(hopper: Hopper, repetitions: int) -> timing.Figure:
    return speedup(hopper, repetitions, "dry", 0.3)


def speedup(hopper: Hopper, repetitions: int, step: Any, duration: Any) -> timing.Figure:
    runs = {ranks: hopper.run(step, f"{step}On{ranks}", duration, ranks) for ranks in (1, 2)}
    times = timing.interleaved(runs, repetitions)
    seconds = {ranks: [loop_seconds(time.result) for time in of] for ranks, of in times.items()}
    return timing.Figure(
        [one / two for one, two in zip(seconds[1], seconds[2])],
        target=">= 1.8",
        meaning=f"wall time on 1 rank over that on 2 without the start, {step}, first {duration} s of the discharge",
        details={f"{ranks} ranks": of for ranks, of in seconds.items()},
    )


def loop_seconds(conservation: dict[str, Any]) -> Any:
    """Reading the mesh, and what else is done once, is the phase "other"."""
    return sum(seconds for name, seconds in conservation["phaseSeconds"].items() if name != "other")
