"""Runs that somebody or something ends."""

import functools
import os
import re
import signal
import time

from faultKinds.bench import END
from faultKinds.kinds import Wrong, fault

TO_THE_SAME_END = "the same command goes on to the same end, bit for bit"


@fault("SIGKILL at a random moment, up to three times in a run", TO_THE_SAME_END)
def killed(bench):
    return [functools.partial(killAtRandom, bench, signal.SIGKILL) for _ in bench.times(2, 25)]


@fault("SIGHUP at a random moment, as when the terminal is closed", TO_THE_SAME_END, inQuick=False)
def hangup(bench):
    return [functools.partial(killAtRandom, bench, signal.SIGHUP) for _ in bench.times(1, 5)]


@fault("SIGABRT at a random moment, as an engine's own assertion", TO_THE_SAME_END, inQuick=False)
def aborted(bench):
    return [functools.partial(killAtRandom, bench, signal.SIGABRT) for _ in bench.times(1, 5)]


def killAtRandom(bench, how):
    case = bench.pile()
    kills = 0
    for _ in range(3):
        process = case.start()
        atRandomMoment(case, process)
        if process.poll() is None:
            process.send_signal(how)
            kills += 1
        process.wait()
    case.settle()
    return f"same end after {kills} kills"


def atRandomMoment(case, process):
    """While it starts or resumes, in a third of all; otherwise in some interval or while it writes."""
    random = case.bench.random
    if random.random() < 1 / 3:
        time.sleep(random.uniform(0, 0.3))
    elif case.waitFor(f"\nTime = {random.randrange(1, 100) * 1e-3:.8g}\n", process):
        time.sleep(random.uniform(0, 0.01))


@fault("SIGTERM at a random moment",
       "status 0 with a checkpoint; then the end of a run that ended there by its endTime")
def terminated(bench):
    return [functools.partial(askedToStop, bench, signal.SIGTERM) for _ in bench.times(2, 12)]


@fault("SIGINT (Ctrl-C) at a random moment",
       "a word at once, status 0 with a checkpoint; then the end of a run that ended there by its endTime",
       inQuick=False)
def interrupted(bench):
    return [functools.partial(askedToStop, bench, signal.SIGINT) for _ in bench.times(1, 8)]


def askedToStop(bench, how):
    case = bench.pile()
    process = case.start()
    steps = bench.random.randrange(1, 95)
    if not case.waitFor(f"\nTime = {steps * 1e-3:.8g}\n", process):
        raise Wrong("ended before the signal")
    process.send_signal(how)
    outcome = bench.finished(process, case.log)
    if outcome.status != 0 or not outcome.stopped or not outcome.says("Stopping"):
        raise Wrong(f"status {outcome.status}: {outcome.lastWords}")
    stoppedAt = lastTime(outcome)
    case.mustRun()
    case.requireUndisturbed(endedAndResumed(bench, stoppedAt).folder)
    return "checkpoint written, same end"


@fault("SIGINT twice, the second at once", "ends at once; " + TO_THE_SAME_END, inQuick=False)
def interruptedTwice(bench):
    return [functools.partial(interruptTwice, bench) for _ in bench.times(1, 5)]


def interruptTwice(bench):
    case = bench.pile()
    process = case.start()
    if not case.waitFor("\nTime = 0.03", process):
        raise Wrong("ended before the signal")
    for _ in range(2):
        process.send_signal(signal.SIGINT)
        time.sleep(1e-3)
    outcome = bench.finished(process, case.log)
    stoppedAt = lastTime(outcome)
    outcome = case.mustRun()
    # the second may come when the checkpoint is on the disk already
    resumedAtStop = f"the checkpoint of time {stoppedAt}\n" in outcome.output
    case.requireUndisturbed(endedAndResumed(bench, stoppedAt).folder if resumedAtStop else None)
    return "same end"


@fault("maxClockTime is over",
       "status 0 with a checkpoint; then the end of a run that ended there by its endTime", inQuick=False)
def clockTimeOver(bench):
    return [functools.partial(outOfTime, bench) for _ in bench.times(1, 3)]


def outOfTime(bench):
    case = bench.pile(endTime=1000, writeInterval=500)
    controlDict = (case.folder / "system/controlDict").read_text()
    (case.folder / "system/controlDict").write_text(controlDict + "maxClockTime 1;\n")
    outcome = case.mustRun()
    if not outcome.stopped:
        raise Wrong("did not stop: " + outcome.lastWords)
    stoppedAt = float(lastTime(outcome))
    (case.folder / "system/controlDict").write_text(controlDict)
    case.set(endTime=f"{stoppedAt + 0.01:.8g}")
    case.mustRun()
    ended = bench.pile(endTime=f"{stoppedAt:.8g}", writeInterval=500)
    ended.mustRun()
    ended.set(endTime=f"{stoppedAt + 0.01:.8g}").mustRun()
    case.requireUndisturbed(ended.folder)
    return "checkpoint written, same end"


def lastTime(outcome):
    return re.findall(r"^Time = (\S+)$", outcome.output, re.MULTILINE)[-1]


def endedAndResumed(bench, stoppedAt):
    """A checkpoint off the write times makes neighbour lists again: only a run that has one there, too, ends alike."""
    case = bench.pile(endTime=stoppedAt)
    case.mustRun()
    case.set(endTime=END).mustRun()
    return case


@fault("SIGSTOP and SIGCONT, three times", "goes on to the same end by itself", inQuick=False)
def frozen(bench):
    return [functools.partial(freeze, bench) for _ in bench.times(1, 4)]


def freeze(bench):
    case = bench.pile()
    process = case.start()
    for _ in range(3):
        time.sleep(bench.random.uniform(0.05, 0.4) * bench.wallSeconds())
        if process.poll() is None:
            process.send_signal(signal.SIGSTOP)
            time.sleep(0.05)
            process.send_signal(signal.SIGCONT)
    outcome = bench.finished(process, case.log)
    if outcome.status != 0:
        raise Wrong(outcome.lastWords)
    case.requireUndisturbed()
    return "same end"


@fault("a second instance is started in the same case",
       "the second refuses and says who runs here; the first ends as ever")
def twoInstances(bench):
    return [functools.partial(startTwice, bench, ranks) for ranks in bench.some([1, 1, 1, 2], quick=1)]


def startTwice(bench, ranks):
    case = bench.pile(ranks)
    first = case.start()
    if not case.waitFor("\nTime = ", first):
        raise Wrong("the first ended: " + bench.finished(first, case.log).lastWords)
    os.kill(first.pid, signal.SIGSTOP)      # so that it is there still when the second starts
    log = case.folder.with_name("second.log")
    second = bench.finished(bench.start(case.command, case.folder, log), log)
    os.kill(first.pid, signal.SIGCONT)
    if second.status == 0 or not second.says("Another program runs in this case"):
        raise Wrong(f"the second: status {second.status}, {second.lastWords}")
    outcome = bench.finished(first, case.log)
    if outcome.status != 0:
        raise Wrong("the first: " + outcome.lastWords)
    case.requireUndisturbed()
    return "refused; the first came to the same end"


@fault("the program that reads the output ends, as in a pipe to head", TO_THE_SAME_END, inQuick=False)
def readerGone(bench):
    return [functools.partial(pipeToHead, bench, lines) for lines in bench.some([1, 40, 200], quick=1)]


def pipeToHead(bench, lines):
    case = bench.pile()
    bench.call(["sh", "-c", f"pimpleDemFoam 2>&1 | head -n {lines} > log.head"], case.folder)
    case.settle()
    return "same end"
