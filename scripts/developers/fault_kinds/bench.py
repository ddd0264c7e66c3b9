"""A small case, copies of it for tries, and what an undisturbed run of it leaves, to the last bit."""

import hashlib
import os
import random
import re
import shutil
import signal
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from clepsydra import case_files
from clepsydra.environment import REPOSITORY
from developers.fault_kinds.kinds import Skipped, Wrong

HERE = Path(__file__).resolve().parent
TUTORIAL = REPOSITORY / "cases/tutorials/hopperQuick"
OF_TUTORIAL = ("0/U", "0/p", "constant/g", "system/fvSchemes")  # water at rest between walls, as for the pile
END = 0.1  # s, simulated; a checkpoint every .02 s
STOPPED = "0.06"  # where stopped() has been
BEFORE_STOPPED = "0.04"
TOO_LONG = 300  # s: a run of half a second hangs
MARK = "CLEPSYDRA_FAULT"
# How an error begins, by whom it is reported: OpenFOAM and the program, a program before OpenFOAM's errors work, mpirun
# and MPI, the loader, the C++ library.
ERROR_BEGINS = re.compile(
    r"FOAM FATAL|^(?:\[\d+\] )?(?:pimpleDemFoam|traceResidual|parameterStudy|prlimit|mpirun)\b.*: |^ERROR\b"
    r"|error while loading|terminate called|^ORTE|^\*\*\* |^It looks like MPI_INIT|No space left on device",
    re.MULTILINE,
)


@dataclass
class Outcome:
    status: int
    output: str

    def says(self, text: str) -> bool:
        return text in self.output

    @property
    def stopped(self) -> Any:
        return self.says("Asked to stop: writing a checkpoint")

    @property
    def last_words(self) -> Any:
        """The error message, or else the end of what it said."""
        at = max(self.output.rfind("FOAM FATAL"), self.output.rfind("ERROR:"))
        words = self.output[at:].splitlines()[1:5] if at >= 0 else self.output.splitlines()[-3:]
        return " ".join(" ".join(words).split())[:300] or f"nothing, status {self.status}"

    @property
    def message(self) -> str:
        """What is said from where an error begins; nothing where there is none."""
        begin = ERROR_BEGINS.search(self.output)
        return self.output[begin.start() :] if begin else ""

    def explains(self, *words: str) -> bool:
        """Whether an error tells one of these: what is wrong, or with what. That the word 'error' stands somewhere, as
        in 'momentum error 1e-16', explains nothing to a user."""
        return any(word in self.message for word in words)


class Bench:
    def __init__(self, folder: Path, quick: bool = False, may_mount: bool = False, seed: Any = 1) -> None:
        self.folder = folder
        self.may_mount = may_mount
        self.quick = quick
        self.random = random.Random(seed)
        self.wall: dict[Any, Any] = {}
        # What studies, parameter_studies and system_calls find out once.
        self.study: Path | None = None
        self.study_answer: dict[str, Any] | None = None
        self.study_done = Path()
        self.parameter_study_results: dict[str, str] | None = None
        self.study_seconds = self.parameter_study_seconds = 0.0
        self.calls: list[Any] = []
        self._made: dict[Any, Any] = {}
        self._kept: set[Any] = set()
        self._count = 0
        self._mark = f"{os.getpid()}"

    def some(self, candidates: Any, quick: int = 2, full: Any = None) -> Any:
        """As many of the candidates as this run of the bench has time for, evenly spread."""
        return spread(list(candidates), quick if self.quick else full or len(candidates))

    def times(self, quick: int, full: Any) -> range:
        return range(quick if self.quick else full)

    def pile(self, ranks: int = 1, **entries: Any) -> Any:
        """The case with its mesh, not run yet."""
        name = "mesh" if ranks == 1 else f"mesh{ranks}"
        return self._copy(self._once(name, lambda: self._meshed(ranks)), ranks, entries)

    def stopped(self, ranks: int = 1, **entries: Any) -> Any:
        """The case as an undisturbed run to .06 s has left it; it goes on to the end."""

        def make() -> Any:
            case = self.pile(ranks, endTime=STOPPED)
            case.must_run()
            return case

        case = self._copy(self._once(f"stopped{ranks}", make), ranks, {"endTime": END})
        return case.set(**entries)

    def reference(self, ranks: int = 1) -> Any:
        """What an undisturbed run leaves."""

        def make() -> Any:
            case = self.pile(ranks)
            began = time.monotonic()
            case.must_run()
            self.wall[ranks] = time.monotonic() - began
            return case

        return self._once(f"reference{ranks}", make)

    def wall_seconds(self, ranks: int = 1) -> Any:
        """Of an undisturbed run on this machine, as busy as it is."""
        self.reference(ranks)
        return self.wall[ranks]

    def fresh_folder(self, name: str = "try") -> Any:
        self._count += 1
        folder = self.folder / f"{name}.{self._count}"
        folder.mkdir()
        return folder

    def keep(self, folder: Path) -> None:
        """Beyond the try that has made it."""
        self._kept.add(folder)

    def clean(self) -> None:
        """Removes the folders of a try; what is made once stays."""
        kept = set(self._made.values()) | self._kept
        for entry in self.folder.iterdir():
            if entry.is_file():
                entry.unlink()
            elif entry not in kept:
                for mount in reversed(mounts_below(entry)):
                    subprocess.run(["umount", "--lazy", mount])
                shutil.rmtree(entry, ignore_errors=True)

    def needs(self, program: Any, package: Any) -> None:
        if not shutil.which(program):
            raise Skipped(f"there is no {program} here (package {package})")

    def start(self, command: Any, folder: Path, log: Any, wrapper: Any = (), **options: Any) -> Any:
        """A program of a try, marked as such, its output at the end of the log."""
        with open(log, "a") as output:
            options = {"stdout": output, "stderr": subprocess.STDOUT, "stdin": subprocess.DEVNULL, **options}
            return subprocess.Popen(
                [*map(str, wrapper), *map(str, command)],
                cwd=folder,
                start_new_session=True,
                env=os.environ | {MARK: self._mark},
                **options,
            )

    def call(
        self, command: Any, folder: Path, log: Any = None, wrapper: Any = (), timeout: Any = TOO_LONG, **options: Any
    ) -> Any:
        """Runs it to its end."""
        log = log or folder.with_name(folder.name + ".log")
        begin = log.stat().st_size if log.exists() else 0
        process = self.start(command, folder, log, wrapper, **options)
        return self.finished(process, log, begin, timeout)

    def finished(self, process: Any, log: Any, begin: Any = 0, timeout: Any = TOO_LONG) -> Any:
        try:
            status = process.wait(timeout)
        except subprocess.TimeoutExpired:
            self.kill_all()
            raise Wrong(f"does not end within {timeout} s") from None
        with open(log, errors="replace") as text:
            text.seek(begin)
            return Outcome(status, text.read())

    def alive(self) -> Any:
        """Processes that tries have started and that live, whoever their parent is now."""
        mark = f"{MARK}={self._mark}".encode()
        found = []
        for entry in Path("/proc").iterdir():
            if entry.name.isdigit():
                try:
                    marked = mark in (entry / "environ").read_bytes().split(b"\0")
                    if marked and (entry / "stat").read_text().rpartition(")")[2].split()[0] != "Z":
                        found.append(int(entry.name))
                except OSError:  # another user's, or it has ended
                    pass
        return found

    def kill_all(self) -> None:
        for process in self.alive():
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def _meshed(self, ranks: int) -> Any:
        folder = self.fresh_folder("mesh")
        shutil.copytree(HERE / "pile", folder, dirs_exist_ok=True)
        for name in OF_TUTORIAL:
            (folder / name).parent.mkdir(exist_ok=True)
            shutil.copy(TUTORIAL / name, folder / name)
        for command in [["blockMesh"]] + [["decomposePar"]] * (ranks > 1):
            outcome = self.call(command, folder)
            if outcome.status != 0:
                raise SystemExit(f"faults: {command[0]} failed: {outcome.last_words}")
        return Case(self, folder, ranks)

    def _once(self, name: str, make: Any) -> Any:
        if name not in self._made:
            self._made[name] = make().folder
        return self._made[name]

    def _copy(self, source: Any, ranks: int, entries: Any) -> Any:
        folder = self.fresh_folder()
        shutil.copytree(source, folder, dirs_exist_ok=True)
        return Case(self, folder, ranks).set(**entries)


class Case:
    """A copy of the small case, on one rank or more."""

    def __init__(self, bench: Any, folder: Path, ranks: int, log: Any = None) -> None:
        self.bench = bench
        self.folder = folder
        self.ranks = ranks
        # beside the case: its disk may be full
        self.log = log or folder.with_name(folder.name + ".log")

    def set(self, **entries: Any) -> Any:
        """Entries of system/controlDict."""
        for name, value in entries.items():
            self.edit("system/controlDict", rf"^{name}( +).*;", rf"{name}\g<1>{value};")
        return self

    def edit(self, name: str, pattern: str, replacement: Any) -> Any:
        file = self.folder / name
        text, found = re.subn(pattern, replacement, file.read_text(), count=1, flags=re.MULTILINE)
        if not found:
            raise SystemExit(f"faults: {file} has nothing like {pattern}")
        file.write_text(text)
        return self

    @property
    def command(self) -> Any:
        return ["pimpleDemFoam"] if self.ranks == 1 else ["mpirun", "-np", self.ranks, "pimpleDemFoam", "-parallel"]

    def start(self, wrapper: Any = (), **options: Any) -> Any:
        return self.bench.start(self.command, self.folder, self.log, wrapper, **options)

    def run(self, wrapper: Any = (), **options: Any) -> Any:
        return self.bench.call(self.command, self.folder, self.log, wrapper, **options)

    def must_run(self) -> Any:
        outcome = self.run()
        if outcome.status != 0:
            raise Wrong(f"status {outcome.status}: {outcome.last_words}")
        return outcome

    def wait_for(self, text: str, process: Any) -> bool:
        """Until the log says so. False where the run has ended."""
        while text not in (self.log.read_text(errors="replace") if self.log.exists() else ""):
            if process.poll() is not None:
                return False
            time.sleep(0.005)
        return True

    def settle(self) -> Any:
        """Lets the same command go on to the end, which must be the undisturbed one."""
        outcome = self.must_run()
        self.require_undisturbed()
        return outcome

    def require_undisturbed(self, reference: Any = None) -> None:
        found = differences(self.folder, reference or self.bench.reference(self.ranks))
        if found:
            raise Wrong("another end than undisturbed: " + ", ".join(found[:4]) + (" ..." if len(found) > 4 else ""))

    def manifest(self, time_name: Any) -> list[Any]:
        """Names of the files of a checkpoint."""
        return sorted(files(self.folder / "checkpoints" / time_name / "complete"))


def spread(candidates: Any, most: Any) -> Any:
    """At most so many of a list, from its beginning to its end."""
    if len(candidates) <= most:
        return candidates
    return [candidates[round(i * (len(candidates) - 1) / max(1, most - 1))] for i in range(most)]


def mounts_below(folder: Path) -> list[Any]:
    """Mount points in a folder, and itself, outer ones first."""
    points = [Path(line.split()[1]) for line in Path("/proc/self/mounts").read_text().splitlines()]
    return [point for point in points if folder == point or folder in point.parents]


def files(manifest: Any) -> dict[Any, Any]:
    """Checksum of each file that a checkpoint consists of."""
    lines = [line.split(" ", 2) for line in manifest.read_text().splitlines()]
    return {line[2]: line[0] for line in lines if len(line) == 3 and len(line[0]) == 64}


def differences(case: Any, reference: Any) -> Any:
    """What a case lacks or has otherwise than an undisturbed one: states, drawings of the particles and rows of
    m(t)."""
    found = []
    for pattern in ("[0-9]*/**/*", "processor*/[0-9]*/**/*", "checkpoints/*/particles.*", "VTK/*.vtp"):
        for file in sorted(reference.glob(pattern)):
            name = file.relative_to(reference)
            if file.is_file() and not same_content(case / name, file):
                found.append(str(name))
    for manifest in sorted(reference.glob("checkpoints/*/complete")):
        name = manifest.relative_to(reference)
        if not (case / name).exists():
            found.append(f"{name} is missing")
            continue
        found += [
            f"{file} is not that of {name}"
            for file, checksum in files(case / name).items()
            if checksum != sha256(case / file)
        ]
    if rows(case) != rows(reference):
        found.append(f"m(t) has {len(rows(case))} rows in place of {len(rows(reference))}, or others")
    return found


def sha256(file: Path) -> str | None:
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.exists() else None


def same_content(file: Path, other: Any) -> bool:
    if not file.exists():
        return False
    if file.name == "checkpoint":  # random identifiers of the run and the checkpoint follow
        return file.read_text().splitlines()[:1] == other.read_text().splitlines()[:1]
    if file.name == "time":  # sums of the same steps, rounded as they were added up

        def rounded(text: str) -> str:
            return re.sub(r"value +(\S+);", lambda value: f"value {float(value[1]):.12g};", text)

        return rounded(file.read_text()) == rounded(other.read_text())
    return file.read_bytes() == other.read_bytes()


def rows(case: Any) -> list[Any]:
    """m(t) as text, the parts of a resumed run one after the other."""
    parts = [part / "massInHopper.dat" for part in case_files.start_directories(case, "massInHopper")]
    return [
        line
        for part in parts
        if part.exists()
        for line in part.read_text(errors="replace").splitlines()
        if not line.startswith("#")
    ]
