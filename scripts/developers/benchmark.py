#!/usr/bin/python3
"""How fast Clepsydra is, each figure a ratio of runs that were interleaved on this machine.

Usage: benchmark [--quick] [--realTime] [--repetitions N] [--json FILE] [ENTRY ...]
       benchmark --picture PNG --json FILE

Without ENTRY, all entries are measured; with --quick all but the longest. Prints a table and, with --json, writes
it with machine, commit, date and load, beside what a FILE of the same machine and commit has already; --picture draws
from such a file. An entry that cannot be measured on this machine is skipped, with the reason. LAMMPS and Yade come
with scripts/setup --with otherCodes. """

import argparse
import json
import sys
import tempfile
from pathlib import Path
from typing import Any

from clepsydra import environment
from developers.benchmarks import (
    balance,
    cost_model,
    coupled,
    dpm_foam,
    emptying,
    flow_rates,
    functions,
    large_bed,
    memory,
    messages,
    other_programs,
    picture,
    pressure,
    report,
    scaling,
    stock_liggghts,
    timing,
    two_ranks,
    whole_run,
)
from developers.benchmarks.hopper import Hopper

# Each takes (hopper, repetitions) and gives a timing.Figure.
ENTRIES = {
    "coupledOverEnginesAlone": coupled.coupled_over_engines_alone,
    "coupledOverEnginesAloneWithoutSmoothing": coupled.coupled_over_engines_alone_without_smoothing,
    "coupledOverLiggghtsAndFluid": coupled.coupled_over_liggghts_and_fluid,
    "couplingShare": coupled.coupling_share,
    "largestFunction": functions.largest_function,
    "exchangeBytesPerParticle": coupled.exchange_bytes_per_particle,
    "pressureMicrosecondsPerCell": pressure.microseconds_per_cell,
    "speedupTwoRanks": two_ranks.speedup_coupled,
    "speedupTwoRanksDry": two_ranks.speedup_dry,
    "speedupTwoRanksEmptying": emptying.speedup_emptying,
    "demOverStockLiggghts": stock_liggghts.dem_over_stock_liggghts,
    "overDPMFoam": dpm_foam.over_dpm_foam,
    "overDPMFoamBed": dpm_foam.over_dpm_foam_bed,
    "overLammps": other_programs.over_lammps,
    "overYade": other_programs.over_yade,
    "overLammpsFlow": flow_rates.over_lammps_flow,
    "flowRates": flow_rates.rates,
    "messagesPerInterval": messages.messages_per_interval,
    "reductionsPerStep": messages.reductions_per_step,
    "busiestRankOverMean": balance.busiest_rank_over_mean,
    "ranksAtHalfEfficiency": scaling.ranks_at_half_efficiency,
    "bytesPerRank": messages.bytes_per_rank,
    "bytesPerParticle": memory.bytes_per_particle,
    "bytesPerCell": memory.bytes_per_cell,
    "millionParticles": large_bed.million_particles,
    "millionParticlesDry": large_bed.million_particles_dry,
    "millionCells": large_bed.million_cells,
    "quickHopperSubmerged_s": whole_run.quick_hopper_submerged,
    "overLast": whole_run.over_last,
    "overLastDry": whole_run.over_last_dry,
    "costModelErrorPercent": cost_model.cost_model_error_percent,
}

# Not of --quick, unless they are named.
LONG = (
    "speedupTwoRanksEmptying",
    "overLammpsFlow",
    "flowRates",
    "busiestRankOverMean",
    "ranksAtHalfEfficiency",
    "millionParticles",
    "millionParticlesDry",
    "millionCells",
    "pressureMicrosecondsPerCell",
)


# Not of --realTime: two ranks that wait for each other keep the system's own threads, which write their files, off both
# cores.
TWO_RANKS = (
    "speedupTwoRanks",
    "speedupTwoRanksDry",
    "speedupTwoRanksEmptying",
    "millionParticles",
    "millionParticlesDry",
    "millionCells",
    "quickHopperSubmerged_s",
)


def main() -> None:
    options = read_options()
    if options.picture:
        picture.draw(json.loads(options.json.read_text())["entries"], options.picture)
        return
    earlier = report.earlier_entries(options.json, options) if options.json else {}
    environment.load()
    timing.real_time = options.realTime
    figures: dict[str, timing.Figure | str] = {}
    with tempfile.TemporaryDirectory(prefix="clepsydraBenchmark") as folder:
        hopper = Hopper(Path(folder), quick=options.quick)
        for name in options.entries or [name for name in ENTRIES if not (options.quick and name in LONG)]:
            print(f"{name} ...", file=sys.stderr, flush=True)
            try:
                if options.realTime and name in TWO_RANKS:
                    raise timing.Skipped("two ranks are timed on a quiet machine, without --realTime")
                figures[name] = ENTRIES[name](hopper, options.repetitions)
            except timing.Skipped as reason:
                figures[name] = str(reason)
            if options.json:  # after each: the benchmark may be interrupted
                report.write(options.json, earlier, figures, options)
    print(report.table(figures))


def read_options() -> Any:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("entries", nargs="*", metavar="ENTRY", help=", ".join(ENTRIES))
    parser.add_argument("--quick", action="store_true", help="3000 particles, short windows")
    parser.add_argument("--repetitions", type=int, default=3, help="runs of each program (%(default)d)")
    parser.add_argument(
        "--realTime",
        action="store_true",
        help="timed programs of one rank push all other work on this machine aside, others are left out; root only",
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the results to this file")
    parser.add_argument("--picture", type=Path, metavar="PNG", help="measure nothing; draw what --json names")
    options = parser.parse_args()
    if options.picture and not (options.json and options.json.exists()):
        parser.error("--picture draws from a file of results, which --json FILE names")
    unknown = [name for name in options.entries if name not in ENTRIES]
    if unknown:
        parser.error(f"no entry {' '.join(unknown)}; there are: {', '.join(ENTRIES)}")
    if options.repetitions < 1:
        parser.error("--repetitions is a whole number above 0")
    return options


if __name__ == "__main__":
    main()
