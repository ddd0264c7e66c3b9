"""Faults of runs on two ranks."""

import functools
import os
import signal
import time

from faultKinds.damage import flipBit
from faultKinds.bench import BEFORE_STOPPED, STOPPED
from faultKinds.kinds import Wrong, fault

TO_THE_SAME_END = "no rank lives on; the same command goes on to the same end, bit for bit"


@fault("SIGKILL to one of two ranks", TO_THE_SAME_END)
def rankKilled(bench):
    return [functools.partial(hitRank, bench, signal.SIGKILL) for _ in bench.times(1, 8)]


@fault("SIGKILL to mpirun", TO_THE_SAME_END, inQuick=False)
def mpirunKilled(bench):
    return [functools.partial(hitMpirun, bench, signal.SIGKILL) for _ in bench.times(1, 4)]


@fault("SIGTERM to mpirun", TO_THE_SAME_END, inQuick=False)
def mpirunTerminated(bench):
    return [functools.partial(hitMpirun, bench, signal.SIGTERM) for _ in bench.times(1, 4)]


@fault("SIGTERM to both ranks", "status 0 with a checkpoint; then every particle and every row of m(t) once", inQuick=False)
def ranksTerminated(bench):
    return [functools.partial(stopRanks, bench) for _ in bench.times(1, 4)]


def ranksOf(bench):
    found = []
    for process in bench.alive():
        try:
            with open(f"/proc/{process}/comm") as name:
                if name.read().strip() == "pimpleDemFoam":
                    found.append(process)
        except OSError:
            pass
    return sorted(found)


def started(bench, upTo=0.9):
    case = bench.pile(2)
    process = case.start()
    step = bench.random.randrange(1, int(100 * upTo))
    if not case.waitFor(f"\nTime = {step * 1e-3:.8g}\n", process):
        raise Wrong("ended before the fault: " + bench.finished(process, case.log).lastWords)
    return case, process


def requireNobody(bench):
    deadline = time.monotonic() + 30
    while bench.alive():
        if time.monotonic() > deadline:
            raise Wrong(f"{len(bench.alive())} processes live on")
        time.sleep(0.05)


def hitRank(bench, how):
    case, process = started(bench)
    os.kill(bench.random.choice(ranksOf(bench)), how)
    outcome = bench.finished(process, case.log)
    if outcome.status == 0:
        raise Wrong("status 0 though a rank was killed")
    requireNobody(bench)
    case.settle()
    return "same end"


def hitMpirun(bench, how):
    case, process = started(bench)
    process.send_signal(how)
    bench.finished(process, case.log)
    requireNobody(bench)
    if "writing a checkpoint" in case.log.read_text():
        return goOnAfterStop(case)
    case.settle()
    return "same end"


def stopRanks(bench):
    case, process = started(bench)
    for rank in ranksOf(bench):
        os.kill(rank, signal.SIGTERM)
    outcome = bench.finished(process, case.log)
    if outcome.status != 0 or not outcome.stopped:
        raise Wrong(f"status {outcome.status}: {outcome.lastWords}")
    return goOnAfterStop(case)


def goOnAfterStop(case):
    """Off the write times the neighbour lists are made again, and rounding differs: times and counts only."""
    from faultKinds.bench import rows
    case.mustRun()
    reference = [row.split()[::2] for row in rows(case.bench.reference(case.ranks))]
    found = [row.split()[::2] for row in rows(case.folder)]
    if found != reference:
        raise Wrong(f"m(t) has {len(found)} rows in place of {len(reference)}, or others")
    return "goes on, every row and particle once"


@fault("a bit flipped in a field of one rank",
       "names the file, goes on from the checkpoint before to the same end", inQuick=False)
def fieldOfRankDamaged(bench):
    names = [name for name in bench.stopped(2).manifest(STOPPED) if name.startswith("processor")]
    return [functools.partial(damageRank, bench, name) for name in bench.some(names, quick=1, full=6)]


def damageRank(bench, name):
    case = bench.stopped(2)
    flipBit(case.folder / name)
    outcome = case.settle()
    if not (outcome.says(name) and outcome.says(f"time {BEFORE_STOPPED}")):
        raise Wrong(f"{name} is not named")
    return "named; from the checkpoint before to the same end"


@fault("going on with another number of ranks than before, without decomposing",
       "refuses with a message, nothing is lost", inQuick=False)
def otherRanks(bench):
    return [functools.partial(goOnWith, bench, before, after) for before, after in ((1, 2), (2, 1), (2, 3))]


def goOnWith(bench, before, after):
    case = bench.stopped(before)
    case.ranks = after
    outcome = case.run()
    if outcome.status == 0 or not outcome.explained:
        raise Wrong(f"{before} ranks, then {after}: status {outcome.status}, {outcome.lastWords}")
    requireNobody(bench)
    case.ranks = before
    case.settle()
    return "refused; with the right number the same end"
