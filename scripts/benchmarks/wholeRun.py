"""The quick hopper under water from the first bead that leaves to the last, on two cores."""

from . import timing


def quickHopperSubmerged(hopper, repetitions):
    """Always the 3000 beads of the case; where the benchmark is quick, once."""
    run = hopper.quickOne().run("submerged", "whole", float(hopper.parameters["submergedTime"]), 2)
    times = timing.interleaved({"whole": run}, 1 if hopper.quick else repetitions)["whole"]
    return timing.Figure(
        [time.wall for time in times], target="<= 60", meaning="s wall time, submerged quick hopper until its flow ends, 2 ranks",
        details={"simulated": times[0].result["timeEnd"], "phases": [time.result["phaseSeconds"] for time in times]})
