"""Disks that are full, fail or refuse to be written."""

import functools
import shutil
import signal
import subprocess
from typing import Any

from developers.fault_kinds.bench import Bench, Case, Outcome
from developers.fault_kinds.kinds import Skipped, Wrong, fault

# What the program says of a disk that takes nothing more, or fails: the system's words, or that a file has no end.
OF_DISK = (
    "has no room for the new directory",  # OpenFOAM
    "Couldn't create directory",  # OpenFOAM, of errors that it does not know, with the folder's name
    "No space left on device",
    "Input/output error",
    "Read-only file system",
    "Too many open files",
    "is the disk full",
    "error in IOstream",
    "could not be",
    "annot open",
    "annot write",
    "annot read",
    "annot make",
)
STOPS = "stops with a message and loses nothing; with room again the same command goes on to the same end"


def mount(bench: Bench, folder: Any, *options: Any) -> None:
    if not bench.may_mount:
        raise Skipped("the system allows no mounts here (neither as root nor by unshare)")
    subprocess.run(["mount", *options, folder], check=True)


def on_small_disk_at(bench: Bench, folder: Any, kibibytes: int) -> Any:
    """Puts what is in a folder on a disk with so much room left. Returns the folder."""
    kept = bench.fresh_folder("kept")
    if folder.exists():
        shutil.copytree(folder, kept, symlinks=True, dirs_exist_ok=True)
    folder.mkdir(exist_ok=True)
    mount(bench, folder, "-t", "tmpfs", "-o", "size=64m", "none")
    shutil.copytree(kept, folder, symlinks=True, dirs_exist_ok=True)
    used = int(subprocess.run(["df", "--output=used", folder], stdout=subprocess.PIPE, text=True).stdout.split()[1])
    # at least a page: no size at all means no limit
    mount(bench, folder, "-o", f"remount,size={max(4, used + kibibytes)}k")
    return folder


def room_again(bench: Bench, folder: Any) -> None:
    mount(bench, folder, "-o", "remount,size=64m")


def fill(bench: Bench, part: Any, kibibytes: int, fresh: Any = False, ranks: int = 1) -> Any:
    case = bench.pile(ranks) if fresh else bench.stopped(ranks)
    disk = on_small_disk_at(bench, case.folder / part, kibibytes)
    outcome = case.run()
    said = judged(outcome)
    room_again(bench, disk)
    case.settle()
    return said


def judged_where_engines_crash(outcome: Outcome, *file: str) -> Any:
    """The engines do not look at all that they read or allocate: short of a message they end by a signal, which loses
    nothing either."""
    if outcome.status in (-signal.SIGSEGV, -signal.SIGABRT):
        return "an engine crashed, then the same end"
    return judged(outcome, *file)


def judged(outcome: Outcome, *file: str) -> str:
    """What a run that met a fault has done, short of a silent wrong. file: names of a file whose mention explains the
    fault, too."""
    if outcome.status == 0:
        return "went on; same end"  # that it is the same is seen when it has gone on
    if outcome.status < 0 or not outcome.explains(*OF_DISK, *file):
        raise Wrong(f"status {outcome.status} without a message of the disk: {outcome.last_words}")
    return "stopped with a message, then the same end"


@fault("the disk of the case is full after so many KiB, between a resume and the end", STOPS)
def disk_full(bench: Bench) -> list[Any]:
    return [functools.partial(fill, bench, ".", room) for room in bench.some(range(0, 640, 16), quick=5)]


@fault("the disk of the case is full after so many KiB of a fresh run", STOPS, in_quick=False)
def disk_full_from_start(bench: Bench) -> list[Any]:
    return [functools.partial(fill, bench, ".", room, True) for room in bench.some(range(0, 1500, 100), quick=1)]


@fault("the disk is full where the particles' checkpoints are", STOPS)
def disk_full_for_particles(bench: Bench) -> list[Any]:
    return [functools.partial(fill, bench, "checkpoints", room) for room in bench.some(range(0, 196, 14), quick=2)]


@fault("the disk is full where the tables (m(t), conservation) are", STOPS)
def disk_full_for_tables(bench: Bench) -> list[Any]:
    return [functools.partial(fill, bench, "postProcessing", room) for room in bench.some(range(0, 20, 2), quick=2)]


@fault("the disk is full where the drawings of the particles are", STOPS)
def disk_full_for_drawings(bench: Bench) -> list[Any]:
    return [functools.partial(fill, bench, "VTK", room) for room in bench.some(range(0, 48, 4), quick=2)]


@fault("the disk is full where two ranks have the case, the particles' checkpoints or their drawings", STOPS)
def disk_full_on_two_ranks(bench: Bench) -> list[Any]:
    places = [(part, room) for room in (0, 8, 40, 120) for part in ("checkpoints", "VTK", ".")]
    return [functools.partial(fill, bench, part, room, ranks=2) for part, room in bench.some(places, quick=2)]


@fault("the output goes to a full disk (/dev/full)", STOPS, in_quick=False)
def disk_full_for_log(bench: Bench) -> list[Any]:
    def run() -> str:
        case = bench.pile()
        with open("/dev/full", "w") as full:
            process = case.start(stdout=full, stderr=subprocess.PIPE, text=True)
            said = process.communicate()[1]
        case.settle()
        if "FATAL" not in said:
            raise Wrong(f"status {process.returncode} without a message")
        return "stopped with a message, then the same end"

    return [run]


@fault(
    "the case is read-only when a run starts",
    "refuses with a message, changes nothing; writable, the same end",
    in_quick=False,
)
def read_only(bench: Bench) -> list[Any]:
    def run(case: Case) -> str:
        mount(bench, case.folder, "--bind", case.folder)
        mount(bench, case.folder, "-o", "remount,bind,ro")
        outcome = case.run()
        subprocess.run(["umount", "--lazy", case.folder], check=True)
        if outcome.status == 0 or not outcome.explains("Read-only file system"):
            raise Wrong(f"status {outcome.status}: {outcome.last_words}")
        case.settle()
        return "refused, then the same end"

    return [lambda: run(bench.pile()), lambda: run(bench.stopped())]


@fault(
    "the case folder is moved away in the midst of a run",
    "stops with a message; moved back, the same end",
    in_quick=False,
)
def folder_moved(bench: Bench) -> list[Any]:
    return [functools.partial(move_folder, bench) for _ in bench.times(1, 3)]


def move_folder(bench: Bench) -> str:
    case = bench.pile()
    process = case.start()
    case.wait_for(f"\nTime = {bench.random.randrange(5, 70) * 1e-3:.8g}\n", process)
    away = case.folder.with_name(case.folder.name + ".away")
    case.folder.rename(away)
    outcome = bench.finished(process, case.log)
    made_again = case.folder.exists()
    shutil.rmtree(case.folder, ignore_errors=True)
    away.rename(case.folder)
    if outcome.status == 0 or not outcome.explains("was the case moved", *OF_DISK):
        raise Wrong(f"status {outcome.status}{', a folder was made again' if made_again else ''}: {outcome.last_words}")
    case.settle()
    return "stopped with a message, then the same end"
