"""What the coupling costs beside the two engines, from the phases of coupled runs and of dry ones in between."""

import functools
from typing import Any

from developers.benchmarks.hopper import Hopper

from . import timing
from .stock_liggghts import liggghts

COUPLING = ("locate", "distribute", "smooth", "exchange", "forces")
# The engines' own; "other" is reading the mesh and what is outside all phases.
FLUID = ("momentum", "pressure", "output", "other")


@functools.cache
def runs(hopper: Hopper, repetitions: int) -> dict[Any, Any]:
    """Processor seconds of each phase by name, a dictionary a repetition."""
    duration = 0.2 if hopper.quick else 0.1
    times = timing.interleaved(
        {"coupled": hopper.run("submerged", "coupled", duration), "dry": hopper.run("dry", "alone", duration)},
        repetitions,
    )
    return {name: [time.result["phaseProcessorSeconds"] for time in of] for name, of in times.items()}


def coupling_share(hopper: Hopper, repetitions: int) -> timing.Figure:
    coupled = runs(hopper, repetitions)["coupled"]
    shares = [{name: 100 * seconds / sum(phases.values()) for name, seconds in phases.items()} for phases in coupled]
    return timing.Figure(
        [sum(share[name] for name in COUPLING) for share in shares],
        target="<= 9",
        meaning=f"% of the whole run's processor time: {', '.join(COUPLING)}",
        details={"shares": shares},
    )


def coupled_over_engines_alone(hopper: Hopper, repetitions: int) -> timing.Figure:
    return over_engines(hopper, repetitions, "<= 1.10", "", [])


def coupled_over_engines_alone_without_smoothing(hopper: Hopper, repetitions: int) -> timing.Figure:
    return over_engines(hopper, repetitions, "<= 1.05", " without the smoothing", ["smooth"])


def over_engines(hopper: Hopper, repetitions: int, target: Any, said: str, without: Any) -> timing.Figure:
    of = runs(hopper, repetitions)
    ratios = [
        (sum(coupled.values()) - sum(coupled[name] for name in without))
        / (dry["DEM"] + sum(coupled[name] for name in FLUID))
        for coupled, dry in zip(of["coupled"], of["dry"])
    ]
    return timing.Figure(
        ratios,
        target=target,
        meaning=(
            f"processor time of the coupled run{said} over the same number of DEM steps without fluid from the same"
            " packing plus its own fluid steps"
        ),
        details=of,
    )


def coupled_over_liggghts_and_fluid(hopper: Hopper, repetitions: int) -> timing.Figure:
    """The same with the DEM steps in the program liggghts, whose contacts are its own: what two programs would cost."""
    duration = 0.2 if hopper.quick else 0.1
    run = hopper.run("submerged", "besideLiggghts", duration)
    steps = round(duration / hopper.parameters["demStep"])
    numbers = {name: value for name, value in hopper.parameters.items() if isinstance(value, (int, float))}
    numbers |= {f"ranksAlong{axis}": 1 for axis in "XYZ"}
    variables = "".join(f"variable {name} equal {value}\n" for name, value in numbers.items())
    lines = (run.folder / "DEM" / "in.discharge").read_text().splitlines(keepends=True)
    discharge = "".join(line for line in lines if not line.startswith("fix balance"))  # LIGGGHTS alone has none
    for name, count in (("alone", steps), ("start", 0)):
        (run.folder / f"in.{name}").write_text(
            f"{variables}variable packing string {hopper.packing}\n{discharge}run {count}\n"
        )
    times = timing.interleaved(
        {"coupled": run, **{name: timing.Run(liggghts(name), run.folder) for name in ("alone", "start")}}, repetitions
    )
    phases = [time.result["phaseProcessorSeconds"] for time in times["coupled"]]
    alone = [time.processor - start.processor for time, start in zip(times["alone"], times["start"])]
    return timing.Figure(
        [sum(of.values()) / (dem + sum(of[name] for name in FLUID)) for of, dem in zip(phases, alone)],
        target="<= 1.10",
        meaning=(
            "processor time of the coupled run over the same DEM steps without fluid in the program liggghts plus its"
            " own fluid steps"
        ),
        details={"coupled": phases, "liggghts": alone},
    )


def exchange_bytes_per_particle(hopper: Hopper, repetitions: int) -> timing.Figure:
    """A count, not a time: one run."""
    run = hopper.run("submerged", "exchange", 0.05, 2)
    conservation = timing.timed(run).result
    intervals = (conservation["timeEnd"] - conservation["timeStart"]) / hopper.parameters["couplingTimeStep"]
    per_particle = conservation["exchangedBytes"] / conservation["particlesStart"] / intervals
    return timing.Figure(
        [per_particle],
        target="< 1100",
        meaning=(
            "bytes that both of two ranks send for a particle and interval; all-to-all: about 1100 a particle and rank"
        ),
    )
