"""The n-th call of one kind on one file fails, or is the last that a run makes; for each n between a resume and the
next checkpoint.

strace injects the failures. libfiu's preloaded library, which fails calls by chance, counts none, and sees neither what
the C library calls by itself (all that is written by fopen or a stream) nor what a static library does.
"""

import functools
import re
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from developers.fault_kinds.bench import END, Bench, Case, Outcome, spread
from developers.fault_kinds.disk import judged, judged_where_engines_crash
from developers.fault_kinds.kinds import Wrong, fault

NEXT = 0.08  # s: one checkpoint after stopped()
WRITES = ("write", "writev", "pwrite64", "ftruncate", "truncate")
NAMES = ("rename", "renameat", "renameat2", "mkdir", "unlink", "unlinkat")
READS = ("read", "pread64", "readv")
OPENS = ("open", "openat", "creat")
SYNCS = ("fsync", "fdatasync")
# without what has no path, as pipes
OF_FILE = re.compile(r"^\d+ +(\w+)\(\d+<(/[^>]*)>")
OF_PATH = re.compile(r'^\d+ +(\w+)\((?:AT_FDCWD[^"]*)?"([^"]*)"')
# A file is written in many small pieces by the drawing library: some of them tell as much as all.
MOST_OF_A_FILE = 4


@dataclass(frozen=True)
class Call:
    name: str
    file: str  # of the case
    number: int  # of this call on this file
    writing: bool  # of a call that opens


def calls_on(bench: Bench) -> Any:
    """Those that a run from stopped() to the next checkpoint makes on files of the case, in order."""
    if not bench.calls:
        bench.needs("strace", "strace")
        case = bench.stopped(endTime=NEXT)
        trace = bench.fresh_folder("trace") / "trace"
        calls = ",".join(WRITES + NAMES + READS + OPENS + SYNCS)
        outcome = case.run(["strace", "-f", "-y", "-o", trace, "-e", "trace=" + calls])
        if outcome.status != 0:
            raise Wrong("does not run under strace: " + outcome.last_words)
        bench.calls = []
        times: Counter[tuple[str, str]] = Counter()
        for line in trace.read_text(errors="replace").splitlines():
            match = OF_FILE.match(line) or OF_PATH.match(line)
            if not match:
                continue
            file = Path(case.folder / match[2])
            if case.folder in file.parents and not file.name.startswith("log."):
                name = str(file.relative_to(case.folder))
                times[match[1], name] += 1
                if " = -1 E" not in line:
                    writes = "O_WRONLY" in line or "O_RDWR" in line
                    bench.calls.append(Call(match[1], name, times[match[1], name], writes))
    return bench.calls


def each(bench: Bench, names: Any, writing: Any = None) -> list[Any]:
    """The calls of these names, of each file some at most."""
    found: dict[Any, Any] = {}
    for call in calls_on(bench):
        if call.name in names and writing in (None, call.writing):
            found.setdefault((call.name, call.file), []).append(call)
    return [call for calls in found.values() for call in spread(calls, MOST_OF_A_FILE)]


def on_file(case: Case, name: str) -> list[Any]:
    """Options of strace: by either of the names that a run in the case has for it."""
    return ["-P", case.folder / name, "-P", name]


def inject(bench: Bench, what: Any, call: Any, judge: Any) -> Any:
    case = bench.stopped(endTime=NEXT)
    outcome = case.run(
        [
            "strace",
            "-f",
            "-o",
            "/dev/null",
            *on_file(case, call.file),
            "-e",
            f"trace={call.name}",
            "-e",
            f"inject={call.name}:{what}:when={call.number}",
        ]
    )
    try:
        said = judge(outcome, call)
        case.set(endTime=END).settle()
    except Wrong as problem:
        raise Wrong(f"{what} in {call.name} {call.number} of {call.file}: {problem}") from None
    return said


def writing_judged(outcome: Outcome, _: Call) -> str:
    return judged(outcome)


def reading_judged(outcome: Outcome, call: Call) -> Any:
    """OpenFOAM does not keep the system's reason, but says which file it could not read."""
    return judged_where_engines_crash(outcome, call.file, f'"{Path(call.file).name}"')


def killed(outcome: Outcome, _: Call) -> str:
    return "same end" if outcome.status else "had ended before"


def tries(
    bench: Bench,
    names: Any,
    errors: Any,
    quick: int,
    full: Any = None,
    writing: Any = None,
    judge: Any = writing_judged,
) -> list[Any]:
    chosen = bench.some(each(bench, names, writing), quick, full)
    return [
        functools.partial(inject, bench, f"error={errors[number % len(errors)]}", call, judge)
        for number, call in enumerate(chosen)
    ]


CRASH_EXPECTED = (
    "stops with a message or by the crash of an engine, or does without; the same command goes on to the same end"
)
EXPECTED = "stops with a message, or does without; the same command goes on to the same end"


@fault("the n-th write to a file fails (ENOSPC, EIO)", EXPECTED)
def failing_writes(bench: Bench) -> Any:
    return tries(bench, WRITES, ("ENOSPC", "EIO"), quick=4, full=100)


@fault("the n-th fsync of a file fails (EIO)", EXPECTED)
def failing_syncs(bench: Bench) -> Any:
    return tries(bench, SYNCS, ("EIO",), quick=2)


@fault("the n-th rename, mkdir or unlink of a file fails (EIO, ENOSPC)", EXPECTED)
def failing_renames(bench: Bench) -> Any:
    return tries(bench, NAMES, ("EIO", "ENOSPC"), quick=3)


@fault("the n-th opening of a file for writing fails (ENOSPC, EMFILE)", EXPECTED, in_quick=False)
def failing_opens(bench: Bench) -> Any:
    return tries(bench, OPENS, ("ENOSPC", "EMFILE"), quick=2, writing=True)


@fault("the n-th opening of a file for reading fails (EIO, EMFILE)", CRASH_EXPECTED, in_quick=False)
def failing_opens_to_read(bench: Bench) -> Any:
    return tries(bench, OPENS, ("EIO", "EMFILE"), quick=2, full=60, writing=False, judge=reading_judged)


@fault("the n-th read of a file fails (EIO)", CRASH_EXPECTED, in_quick=False)
def failing_reads(bench: Bench) -> Any:
    return tries(bench, READS, ("EIO",), quick=2, full=60, judge=reading_judged)


@fault(
    "SIGKILL at the n-th write, fsync, rename, mkdir, unlink or opening of a file, over a whole checkpoint",
    "the same command goes on to the same end, bit for bit",
)
def killed_at_calls(bench: Bench) -> list[Any]:
    calls = each(bench, WRITES + SYNCS + NAMES) + each(bench, OPENS, True)
    return [
        functools.partial(inject, bench, "signal=KILL", call, killed) for call in bench.some(calls, quick=4, full=120)
    ]


@fault(
    "from the n-th call on all writes, openings, renames and fsyncs fail (EIO, EROFS): the disk dies",
    EXPECTED,
    in_quick=False,
)
def dying_disk(bench: Bench) -> list[Any]:
    return [
        functools.partial(die, bench, call, error, number)
        for call in ("openat", "writev", "fsync", "mkdir")
        for error in ("EIO", "EROFS")
        for number in bench.some((1, 2, 5, 13), quick=1)
    ]


def die(bench: Bench, call: Any, error: Any, number: Any) -> Any:
    """The calls are counted by kind: the one named begins to fail at its n-th, the others at their third."""
    files = sorted({call.file for call in calls_on(bench)})
    case = bench.stopped(endTime=NEXT)
    wrapper = ["strace", "-f", "-o", "/dev/null", "-e", "trace=openat,write,writev,fsync,rename,mkdir"]
    for file in files:
        wrapper += on_file(case, file)
    for other in ("openat", "write", "writev", "fsync", "rename", "mkdir"):
        # reading goes well in the beginning
        first = len(files) if other == "openat" else 3
        wrapper += ["-e", f"inject={other}:error={error}:when={first + number if other == call else first + 13}+"]
    outcome = case.run(wrapper)
    said = judged(outcome)
    case.set(endTime=END).settle()
    return said
