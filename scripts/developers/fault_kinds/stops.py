"""Runs that somebody or something ends."""

import functools
import os
import re
import signal
import time
from typing import Any

from developers.fault_kinds.bench import END, Bench, Case, Outcome
from developers.fault_kinds.kinds import Wrong, fault

TO_THE_SAME_END = "the same command goes on to the same end, bit for bit"


@fault("SIGKILL at a random moment, up to three times in a run", TO_THE_SAME_END)
def killed(bench: Bench) -> list[Any]:
    return [functools.partial(kill_at_random, bench, signal.SIGKILL) for _ in bench.times(2, 25)]


@fault("SIGHUP at a random moment, as when the terminal is closed", TO_THE_SAME_END, in_quick=False)
def hangup(bench: Bench) -> list[Any]:
    return [functools.partial(kill_at_random, bench, signal.SIGHUP) for _ in bench.times(1, 5)]


@fault("SIGABRT at a random moment, as an engine's own assertion", TO_THE_SAME_END, in_quick=False)
def aborted(bench: Bench) -> list[Any]:
    return [functools.partial(kill_at_random, bench, signal.SIGABRT) for _ in bench.times(1, 5)]


def kill_at_random(bench: Bench, how: signal.Signals) -> str:
    case = bench.pile()
    kills = 0
    for _ in range(3):
        process = case.start()
        at_random_moment(case, process)
        if process.poll() is None:
            process.send_signal(how)
            kills += 1
        process.wait()
    case.settle()
    return f"same end after {kills} kills"


def at_random_moment(case: Case, process: Any) -> None:
    """While it starts or resumes, in a third of all; otherwise in some interval or while it writes."""
    random = case.bench.random
    if random.random() < 1 / 3:
        time.sleep(random.uniform(0, 0.3))
    elif case.wait_for(f"\nTime = {random.randrange(1, 100) * 1e-3:.8g}\n", process):
        time.sleep(random.uniform(0, 0.01))


@fault(
    "SIGTERM at a random moment", "status 0 with a checkpoint; then the end of a run that ended there by its endTime"
)
def terminated(bench: Bench) -> list[Any]:
    return [functools.partial(asked_to_stop, bench, signal.SIGTERM) for _ in bench.times(2, 12)]


@fault(
    "SIGINT (Ctrl-C) at a random moment",
    "a word at once, status 0 with a checkpoint; then the end of a run that ended there by its endTime",
    in_quick=False,
)
def interrupted(bench: Bench) -> list[Any]:
    return [functools.partial(asked_to_stop, bench, signal.SIGINT) for _ in bench.times(1, 8)]


def asked_to_stop(bench: Bench, how: signal.Signals) -> str:
    case = bench.pile()
    process = case.start()
    steps = bench.random.randrange(1, 95)
    if not case.wait_for(f"\nTime = {steps * 1e-3:.8g}\n", process):
        raise Wrong("ended before the signal")
    process.send_signal(how)
    outcome = bench.finished(process, case.log)
    if outcome.status != 0 or not outcome.stopped or not outcome.says("Stopping"):
        raise Wrong(f"status {outcome.status}: {outcome.last_words}")
    stopped_at = last_time(outcome)
    case.must_run()
    case.require_undisturbed(ended_and_resumed(bench, stopped_at).folder)
    return "checkpoint written, same end"


@fault("SIGINT twice, the second at once", "ends at once; " + TO_THE_SAME_END, in_quick=False)
def interrupted_twice(bench: Bench) -> list[Any]:
    return [functools.partial(interrupt_twice, bench) for _ in bench.times(1, 5)]


def interrupt_twice(bench: Bench) -> str:
    case = bench.pile()
    process = case.start()
    if not case.wait_for("\nTime = 0.03", process):
        raise Wrong("ended before the signal")
    for _ in range(2):
        process.send_signal(signal.SIGINT)
        time.sleep(1e-3)
    outcome = bench.finished(process, case.log)
    stopped_at = last_time(outcome)
    outcome = case.must_run()
    # the second may come when the checkpoint is on the disk already
    resumed_at_stop = f"the checkpoint of time {stopped_at}\n" in outcome.output
    case.require_undisturbed(ended_and_resumed(bench, stopped_at).folder if resumed_at_stop else None)
    return "same end"


@fault(
    "maxClockTime is over",
    "status 0 with a checkpoint; then the end of a run that ended there by its endTime",
    in_quick=False,
)
def clock_time_over(bench: Bench) -> list[Any]:
    return [functools.partial(out_of_time, bench) for _ in bench.times(1, 3)]


def out_of_time(bench: Bench) -> str:
    case = bench.pile(endTime=1000, writeInterval=500)
    control_dict = (case.folder / "system/controlDict").read_text()
    (case.folder / "system/controlDict").write_text(control_dict + "maxClockTime 1;\n")
    outcome = case.must_run()
    if not outcome.stopped:
        raise Wrong("did not stop: " + outcome.last_words)
    stopped_at = float(last_time(outcome))
    (case.folder / "system/controlDict").write_text(control_dict)
    case.set(endTime=f"{stopped_at + 0.01:.8g}")
    case.must_run()
    ended = bench.pile(endTime=f"{stopped_at:.8g}", writeInterval=500)
    ended.must_run()
    ended.set(endTime=f"{stopped_at + 0.01:.8g}").must_run()
    case.require_undisturbed(ended.folder)
    return "checkpoint written, same end"


def last_time(outcome: Outcome) -> Any:
    return re.findall(r"^Time = (\S+)$", outcome.output, re.MULTILINE)[-1]


def ended_and_resumed(bench: Bench, stopped_at: Any) -> Any:
    """A checkpoint off the write times makes neighbour lists again: only a run that has one there, too, ends alike."""
    case = bench.pile(endTime=stopped_at)
    case.must_run()
    case.set(endTime=END).must_run()
    return case


@fault("SIGSTOP and SIGCONT, three times", "goes on to the same end by itself", in_quick=False)
def frozen(bench: Bench) -> list[Any]:
    return [functools.partial(freeze, bench) for _ in bench.times(1, 4)]


def freeze(bench: Bench) -> str:
    case = bench.pile()
    process = case.start()
    for _ in range(3):
        time.sleep(bench.random.uniform(0.05, 0.4) * bench.wall_seconds())
        if process.poll() is None:
            process.send_signal(signal.SIGSTOP)
            time.sleep(0.05)
            process.send_signal(signal.SIGCONT)
    outcome = bench.finished(process, case.log)
    if outcome.status != 0:
        raise Wrong(outcome.last_words)
    case.require_undisturbed()
    return "same end"


@fault(
    "a second instance is started in the same case", "the second refuses and says who runs here; the first ends as ever"
)
def two_instances(bench: Bench) -> list[Any]:
    return [functools.partial(start_twice, bench, ranks) for ranks in bench.some([1, 1, 1, 2], quick=1)]


def start_twice(bench: Bench, ranks: int) -> str:
    case = bench.pile(ranks)
    first = case.start()
    if not case.wait_for("\nTime = ", first):
        raise Wrong("the first ended: " + bench.finished(first, case.log).last_words)
    os.kill(first.pid, signal.SIGSTOP)  # so that it is there still when the second starts
    log = case.folder.with_name("second.log")
    second = bench.finished(bench.start(case.command, case.folder, log), log)
    os.kill(first.pid, signal.SIGCONT)
    if second.status == 0 or not second.says("Another program runs in this case"):
        raise Wrong(f"the second: status {second.status}, {second.last_words}")
    outcome = bench.finished(first, case.log)
    if outcome.status != 0:
        raise Wrong("the first: " + outcome.last_words)
    case.require_undisturbed()
    return "refused; the first came to the same end"


@fault("the program that reads the output ends, as in a pipe to head", TO_THE_SAME_END, in_quick=False)
def reader_gone(bench: Bench) -> list[Any]:
    return [functools.partial(pipe_to_head, bench, lines) for lines in bench.some([1, 40, 200], quick=1)]


def pipe_to_head(bench: Bench, lines: Any) -> str:
    case = bench.pile()
    bench.call(["sh", "-c", f"pimpleDemFoam 2>&1 | head -n {lines} > log.head"], case.folder)
    case.settle()
    return "same end"
