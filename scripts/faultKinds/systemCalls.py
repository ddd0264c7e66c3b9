"""The n-th call of one kind on one file fails, or is the last that a run makes; for each n between a resume and the next
checkpoint.

strace injects the failures. libfiu's preloaded library, which fails calls by chance, counts none, and sees neither what the
C library calls by itself (all that is written by fopen or a stream) nor what a static library does.
"""

import functools
import re
from pathlib import Path

from faultKinds.bench import END
from faultKinds.disk import judged
from faultKinds.kinds import Wrong, fault

NEXT = 0.08     # s: one checkpoint after stopped()
WRITES = ("write", "writev", "pwrite64", "ftruncate", "truncate")
NAMES = ("rename", "renameat", "renameat2", "mkdir", "unlink", "unlinkat")
READS = ("read", "pread64", "readv")
OPENS = ("open", "openat", "creat")
SYNCS = ("fsync", "fdatasync")
OF_FILE = re.compile(r"^\d+ +(\w+)\(\d+<([^>]*)>")
OF_PATH = re.compile(r'^\d+ +(\w+)\((?:AT_FDCWD[^"]*)?"([^"]*)"')
# A file is written in many small pieces by the drawing library: some of them tell as much as all.
MOST_OF_A_FILE = 4


def callsOn(bench):
    """How often each call is made on each file of the case: {(call, file, opened for writing): times}."""
    if not hasattr(bench, "calls"):
        bench.needs("strace", "strace")
        case = bench.stopped(endTime=NEXT)
        trace = bench.freshFolder("trace") / "trace"
        outcome = case.run(["strace", "-f", "-y", "-o", trace, "-e", "trace=" + ",".join(WRITES + NAMES + READS + OPENS + SYNCS)])
        if outcome.status != 0:
            raise Wrong("does not run under strace: " + outcome.lastWords)
        bench.calls = {}
        for line in trace.read_text(errors="replace").splitlines():
            match = OF_FILE.match(line) or OF_PATH.match(line)
            if not match or "ENOENT" in line or " = -1 E" in line:
                continue
            file = Path(case.folder / match[2])
            if case.folder in file.parents:
                key = match[1], str(file.relative_to(case.folder)), "O_WRONLY" in line or "O_RDWR" in line
                bench.calls[key] = bench.calls.get(key, 0) + 1
    return bench.calls


def each(bench, calls, where=lambda file, writing: True):
    """Each of the calls: (call, file, number)."""
    found = []
    for (call, file, writing), times in callsOn(bench).items():
        if call in calls and where(file, writing) and not file.startswith("log."):
            numbers = range(1, times + 1)
            if times > MOST_OF_A_FILE:
                numbers = [1 + round(i * (times - 1) / (MOST_OF_A_FILE - 1)) for i in range(MOST_OF_A_FILE)]
            found += [(call, file, number) for number in numbers]
    return found


def inject(bench, what, call, file, number, judge):
    case = bench.stopped(endTime=NEXT)
    outcome = case.run(["strace", "-f", "-o", "/dev/null", "-P", case.folder / file, "-e", f"trace={call}",
                        "-e", f"inject={call}:{what}:when={number}"])
    try:
        said = judge(outcome)
        case.set(endTime=END).settle()
    except Wrong as problem:
        raise Wrong(f"{call} {number} of {file}: {problem}") from None
    return said


def tries(bench, calls, errors, quick, full=None, where=lambda file, writing: True):
    chosen = bench.some(each(bench, calls, where), quick, full)
    return [functools.partial(inject, bench, f"error={errors[number % len(errors)]}", *call, judged)
            for number, call in enumerate(chosen)]


EXPECTED = "stops with a message, or does without; the same command goes on to the same end"


@fault("the n-th write to a file fails (ENOSPC, EIO)", EXPECTED)
def failingWrites(bench):
    return tries(bench, WRITES, ("ENOSPC", "EIO"), quick=4)


@fault("the n-th fsync of a file fails (EIO)", EXPECTED)
def failingSyncs(bench):
    return tries(bench, SYNCS, ("EIO",), quick=2)


@fault("the n-th rename, mkdir or unlink of a file fails (EIO, ENOSPC)", EXPECTED)
def failingRenames(bench):
    return tries(bench, NAMES, ("EIO", "ENOSPC"), quick=3)


@fault("the n-th opening of a file for writing fails (ENOSPC, EMFILE)", EXPECTED, inQuick=False)
def failingOpens(bench):
    return tries(bench, OPENS, ("ENOSPC", "EMFILE"), quick=2, where=lambda file, writing: writing)


@fault("the n-th opening of a file for reading fails (EIO, EMFILE)", EXPECTED, inQuick=False)
def failingOpensToRead(bench):
    return tries(bench, OPENS, ("EIO", "EMFILE"), quick=2, full=80, where=lambda file, writing: not writing)


@fault("the n-th read of a file fails (EIO)", EXPECTED, inQuick=False)
def failingReads(bench):
    return tries(bench, READS, ("EIO",), quick=2, full=80)


@fault("SIGKILL at the n-th write, fsync, rename, mkdir, unlink or opening of a file, over a whole checkpoint",
       "the same command goes on to the same end, bit for bit")
def killedAtCalls(bench):
    calls = each(bench, WRITES + SYNCS + NAMES) + each(bench, OPENS, lambda file, writing: writing)
    return [functools.partial(inject, bench, "signal=KILL", *call, killed) for call in bench.some(calls, quick=4)]


@fault("from the n-th call on all writes, openings, renames and fsyncs fail (EIO, EROFS): the disk dies", EXPECTED, inQuick=False)
def dyingDisk(bench):
    return [functools.partial(die, bench, call, error, number) for call in ("openat", "writev", "fsync", "mkdir")
            for error in ("EIO", "EROFS") for number in bench.some((1, 2, 3, 5, 8, 13), quick=1)]


def die(bench, call, error, number):
    """The calls are counted by kind: the one named begins to fail at its n-th, the others at their third."""
    files = sorted({file for _, file, writing in callsOn(bench) if not file.startswith("log.")})
    case = bench.stopped(endTime=NEXT)
    wrapper = ["strace", "-f", "-o", "/dev/null", "-e", "trace=openat,write,writev,fsync,rename,mkdir"]
    for file in files:
        wrapper += ["-P", case.folder / file]
    for other in ("openat", "write", "writev", "fsync", "rename", "mkdir"):
        # reading goes well in the beginning
        first = len(files) if other == "openat" else 3
        wrapper += ["-e", f"inject={other}:error={error}:when={first + number if other == call else first + 13}+"]
    outcome = case.run(wrapper)
    said = judged(outcome)
    case.set(endTime=END).settle()
    return said


def killed(outcome):
    return "same end" if outcome.status else "had ended before"
