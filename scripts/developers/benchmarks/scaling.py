"""How many ranks are worth it: what each rank of a bed computes and sends, counted on up to 32 ranks, and a model of a
network for more.

A rank of P has N/P particles and as many cells, and a box whose faces it shares with others. Its time in a coupling
step is its work, which is measured on one rank, plus for each phase

    messages * LATENCY + bytes / BANDWIDTH + collective calls * LATENCY * log2(P)

Messages go to 6 neighbours, those of LISTS to 26; bytes go with the area of the faces; the calls are what they are.
The still bed's pressure is solved at once, so the pressure's counts and work are those of the submerged hopper. Its
multigrid halves the cells from level to level, and the messages go with the number of levels. Left out: an uneven load,
and that ranks of a node share its memory."""

import math
from typing import Any

from developers.benchmarks.hopper import Hopper

from . import large_bed, messages, timing

LATENCY = 2e-6  # of a message, of InfiniBand
BANDWIDTH = 1e9  # bytes a second, of one of the ranks that share a node's link
SIDE = 40  # particles and cells along a side of the bed whose messages are counted
BOXES = ((2, 1, 1), (2, 2, 1), (2, 2, 2), (2, 2, 4), (2, 4, 4))
COUNTED = BOXES[2]  # with faces in three directions; more ranks test the model
STEPS = 5  # coupling steps
SIZE = 10**7  # particles, and cells
RANKS = (32, 128, 512, 1024, 4096)
LISTS = ("distribute", "exchange")  # sent to all whose boxes particles touch, not only across faces
PER_PARTICLE = large_bed.OF_PARTICLES
HOPPER_CELLS = 11868
LEAST_CELLS = 10  # of the coarsest level


def ranks_at_half_efficiency(hopper: Hopper, repetitions: int) -> timing.Figure:
    counts = {math.prod(boxes): bed_counts(hopper, boxes) for boxes in BOXES}
    of_hopper = messages.largest(messages.measured(hopper.quick_one())[math.prod(COUNTED)])
    reference = {**counts[math.prod(COUNTED)], "pressure": of_hopper["pressure"]}
    work = work_of(hopper)
    table = {ranks: step(reference, work, SIZE, ranks) for ranks in RANKS}
    ranks = 2
    while efficiency(step(reference, work, SIZE, ranks)) > 0.5:
        ranks *= 2
    return timing.Figure(
        [ranks],
        meaning=f"ranks on which half of the time is spent in messages, by a model, {SIZE:.0e} particles and cells",
        details={
            "secondsOfACouplingStep": table,
            "efficiency": {ranks: efficiency(of) for ranks, of in table.items()},
            "countsOnRanks": counts,
            "countedOverModel": {ranks: tested(reference, counts[ranks], ranks) for ranks in (16, 32)},
            "workPerParticleAndDEMStepOrCellAndStep": work,
        },
    )


def bed_counts(hopper: Hopper, boxes: tuple[int, int, int]) -> Any:
    end = STEPS * large_bed.DEM_STEPS * 1e-5
    run = large_bed.bed(hopper, f"bedOn{math.prod(boxes)}", (SIDE, SIDE), (SIDE, SIDE), boxes, endTime=end)
    return messages.largest(messages.counts_of(run))


def work_of(hopper: Hopper) -> dict[str, float]:
    """Processor seconds on one rank: of a particle and DEM step, or of a cell and step of the fluid."""
    run = large_bed.bed(hopper, "bedOn1", (SIDE, SIDE), (SIDE, SIDE), (1, 1, 1))
    seconds = timing.timed(run).result["phaseProcessorSeconds"]
    steps = large_bed.INTERVALS * SIDE**3
    work = {
        phase: seconds[phase] / steps / (large_bed.DEM_STEPS if phase in PER_PARTICLE else 1)
        for phase in PER_PARTICLE + large_bed.OF_CELLS
    }
    quick = hopper.quick_one()
    duration = 0.05
    pressure = timing.timed(quick.run("submerged", "pressureWork", duration)).result["phaseProcessorSeconds"][
        "pressure"
    ]
    work["pressure"] = pressure / (duration / quick.parameters["couplingTimeStep"]) / HOPPER_CELLS
    return work


def step(counts: Any, work: dict[str, float], size: int, ranks: int) -> dict[str, float]:
    """Seconds of a coupling step of so many particles and cells."""
    each = size / ranks
    seconds = {
        "work": sum(of * each * (large_bed.DEM_STEPS if phase in PER_PARTICLE else 1) for phase, of in work.items())
    }
    parts = [of_phase(phase, of, each) for phase, of in counts.items()]
    seconds["messages"] = LATENCY * sum(part["messages"] for part in parts)
    seconds["bytes"] = sum(part["bytes"] for part in parts) / BANDWIDTH
    seconds["collectives"] = LATENCY * math.log2(ranks) * sum(of["collectives"] for of in counts.values())
    return seconds


def of_phase(phase: str, counts: Any, each: float, faces: int = 6, neighbours: int = 26) -> dict[str, float]:
    """Messages and bytes of a rank with so many particles and cells, from those of one of COUNTED."""
    counted_each = (HOPPER_CELLS if phase == "pressure" else SIDE**3) / math.prod(COUNTED)
    growth = faces / faces_of(COUNTED)
    area = growth * (each / counted_each) ** (2 / 3)
    if phase in LISTS:
        return {"messages": counts["messages"] * neighbours / neighbours_of(COUNTED), "bytes": counts["bytes"] * area}
    levels = math.log(each / LEAST_CELLS) / math.log(counted_each / LEAST_CELLS) if phase == "pressure" else 1
    return {"messages": counts["messages"] * growth * levels, "bytes": counts["bytes"] * area}


def faces_of(boxes: tuple[int, int, int]) -> int:
    """Faces that the rank in the middle shares."""
    return sum(min(along - 1, 2) for along in boxes)


def neighbours_of(boxes: tuple[int, int, int]) -> int:
    """Ranks whose boxes touch that of the rank in the middle, also at edges and corners."""
    return math.prod(min(along, 3) for along in boxes) - 1


def efficiency(seconds: dict[str, float]) -> float:
    return seconds["work"] / sum(seconds.values())


def tested(reference: Any, counted: Any, ranks: int) -> dict[str, Any]:
    """Counted on more ranks over what the model says of them: of all phases but the pressure, which is the hopper's."""
    boxes = next(boxes for boxes in BOXES if math.prod(boxes) == ranks)
    each = SIDE**3 / ranks
    phases = [phase for phase in reference if phase != "pressure"]
    model = [of_phase(phase, reference[phase], each, faces_of(boxes), neighbours_of(boxes)) for phase in phases]
    return {
        quantity: sum(counted[phase][quantity] for phase in phases) / sum(of[quantity] for of in model)
        for quantity in ("messages", "bytes")
    }
