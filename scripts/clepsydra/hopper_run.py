"""Runs a hopper case: meshes it, fills the hopper, and discharges the same packing in each of the other steps.

A step is a run of pimpleDemFoam in steps/<name>, set up from the case's file step.<name>. The first step fills the
hopper and leaves steps/<first>/packing.restart, from which all others start. A run that was stopped resumes from its
last checkpoint; steps that have ended are not run again. """

from __future__ import annotations

import argparse
import contextlib
import fcntl
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import FrameType

import yaml

from clepsydra import case_files, case_rules, parameter_file

# scripts/environment, which every Allrun sources, names the repository or the package that is used.
CLEPSYDRA = Path(os.environ.get("CLEPSYDRA", Path(__file__).resolve().parents[2]))
SCRIPTS = CLEPSYDRA / "scripts"
SOLVER = "pimpleDemFoam"
SECONDS_BETWEEN_REPORTS = 20
SECONDS_BETWEEN_LOOKS = 0.2
TAIL_LINES = 25
STATUS_OF_SIGNAL = {signal.SIGHUP: 129, signal.SIGINT: 130, signal.SIGTERM: 143}
STOPPED_BY_ITSELF = STATUS_OF_SIGNAL[signal.SIGTERM]
AFTER_STOP = "stopped; the same command resumes the run"
USER_LINKS = ("constant", "system", "DEM")


class Failure(Exception):
    """What is wrong, in words for the user."""


class Stopped(Exception):
    """A signal asked this program to end."""

    def __init__(self, status: int) -> None:
        super().__init__(status)
        self.status = status


# --- programs ---------------------------------------------------------------------------------------------------------


def require_program(name: str) -> None:
    if shutil.which(name) is None:
        raise Failure(f"there is no program '{name}' here: run {SCRIPTS}/setup, which installs and builds it")
    etc = Path(os.environ.get("WM_PROJECT_DIR", "")) / "etc/controlDict"
    if not etc.is_file():
        raise Failure(f"OpenFOAM's etc/ is not in '{os.environ.get('WM_PROJECT_DIR', '')}': run {SCRIPTS}/setup")


def environment_of(folder: Path) -> dict[str, str]:
    """The environment of a program that is started in a folder: OpenFOAM warns where PWD names another one."""
    return {**os.environ, "PWD": str(folder.absolute())}


def run_logged(folder: Path, *command: str) -> None:
    """Runs a program in a folder, with its output in log.<program> there."""
    name = Path(command[0]).name
    require_program(command[0])
    log = folder / f"log.{name}"
    with open(log, "w") as output:
        process = subprocess.Popen(
            command,
            cwd=folder,
            env=environment_of(folder),
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )
        try:
            status = process.wait()
        except BaseException:
            process.terminate()
            process.wait()
            raise
    if status != 0:
        print(tail(log), file=sys.stderr)
        raise Failure(f"{name} failed: see {log}")


def tail(log: Path) -> str:
    return "\n".join(log.read_text(errors="replace").splitlines()[-TAIL_LINES:])


def last_run(log: Path) -> str:
    """The part of a solver's log that its last start wrote; a resumed run appends to the log of the first."""
    text = log.read_text(errors="replace") if log.is_file() else ""
    starts = [found.start() for found in re.finditer(r"(?m)^Exec  *:", text)]
    return text[starts[-1] :] if starts else text


# --- one step ---------------------------------------------------------------------------------------------------------


class Step:
    """A run of the solver in a folder of its own, on a number of ranks that may change from start to start."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.name = folder.name
        self.log = folder / f"log.{SOLVER}"

    def was_stopped(self) -> bool:
        """True where the solver ended early, because a signal or maxClockTime asked it to."""
        return re.search(r"(?m)^Asked to stop", last_run(self.log)) is not None

    def last_row(self) -> list[str]:
        """Time, mass, particles and rate as the step wrote them last; empty before it has begun."""
        tables = list((self.folder / "postProcessing/massInHopper").glob("[0-9]*/massInHopper.dat"))
        if not tables:
            return []
        lines = max(tables, key=lambda table: float(table.parent.name)).read_text().splitlines()
        last = lines[-1].split() if lines else []
        return last if len(last) > 2 and last[0][:1].isdigit() else []

    def checkpoints(self) -> list[str]:
        """The times of the whole checkpoints, the last one at the end."""
        found = [marker.parent.name for marker in (self.folder / "checkpoints").glob("*/complete")]
        return sorted(found, key=float)

    def write_ranks(self, ranks: int) -> None:
        """Splits mesh and particles into boxes side by side, one for each rank; none above another.

        `fix balance` of the DEM scripts gives them equal numbers of particles. Boxes above one another could not follow
        the particles that lie on the tank's floor, in a layer thinner than the distance within which they see each
        other."""
        along_y = max(number for number in range(1, math.isqrt(ranks) + 1) if ranks % number == 0)
        entries = {"ranks": ranks, "ranksAlongX": ranks // along_y, "ranksAlongY": along_y, "ranksAlongZ": 1}
        path = self.folder / "step"
        kept = [line for line in path.read_text().splitlines() if not line.startswith("ranks")]
        unfinished = self.folder / "step.new"
        unfinished.write_text("\n".join([*kept, *(f"{name:<15} {value};" for name, value in entries.items())]) + "\n")
        unfinished.rename(path)

    def redistribute(self, ranks: int) -> None:
        """Brings fields and mesh of the last checkpoint from the ranks of the last start onto those of the next. Fields
        of earlier times, which decomposePar would remove with the folders of the old ranks, are put together as well.
        """
        note = self.folder / "ranksOnDisk"
        said = note.read_text().strip() if note.is_file() else "1"
        if not re.fullmatch("[1-9][0-9]*", said):
            raise Failure(f"{note} is damaged: it says '{said}'; allowed: the number of ranks of the last start")
        before = int(said)
        if before == ranks:
            return
        times = self.checkpoints()
        if before != 1 and times:
            split = [time for time in times[:-1] if not (self.folder / time).is_dir()] + times[-1:]
            run_logged(self.folder, "reconstructPar", "-time", ",".join(split))
        self._note_ranks(1)
        if ranks != 1:
            run_logged(self.folder, "decomposePar", "-force", "-time", times[-1] if times else "0")
        self._note_ranks(ranks)

    def _note_ranks(self, ranks: int) -> None:
        unfinished = self.folder / "ranksOnDisk.new"
        unfinished.write_text(f"{ranks}\n")
        unfinished.rename(self.folder / "ranksOnDisk")

    def start(self, ranks: int, lock: int | None = None) -> subprocess.Popen[bytes]:
        """Starts the solver, or resumes it, in a session of its own, so that Ctrl-C reaches this program alone, which
        asks for a checkpoint. `lock`: a file descriptor that the solver keeps open."""
        require_program(SOLVER)
        command = [SOLVER] if ranks == 1 else ["mpirun", "-np", str(ranks), SOLVER, "-parallel"]
        with open(self.log, "a") as output:
            return subprocess.Popen(
                command,
                cwd=self.folder,
                env=environment_of(self.folder),
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                pass_fds=[] if lock is None else [lock],
            )


def ask_to_stop(process: subprocess.Popen[bytes]) -> None:
    """Asks a solver to write a checkpoint and end.

    mpirun itself must not be asked: it would stop to forward the ranks' output, and then kill them."""
    ranks = subprocess.run(["pkill", "-TERM", "-P", str(process.pid), "-x", SOLVER])
    if ranks.returncode != 0 and process.poll() is None:
        process.terminate()


class Signals:
    """What SIGHUP, SIGINT and SIGTERM do: end this program, or, while solvers run, ask these to write a checkpoint."""

    def __init__(self) -> None:
        self.status = 0
        self.solvers: list[subprocess.Popen[bytes]] | None = None

    def install(self) -> None:
        for number in STATUS_OF_SIGNAL:
            # What nohup has switched off stays so.
            if signal.getsignal(number) != signal.SIG_IGN:
                signal.signal(number, self._handle)

    def _handle(self, number: int, _: FrameType | None) -> None:
        self.status = STATUS_OF_SIGNAL[signal.Signals(number)]
        if self.solvers is None:
            raise Stopped(self.status)
        for solver in self.solvers:
            ask_to_stop(solver)


# --- a case -----------------------------------------------------------------------------------------------------------


class HopperCase:
    """The case in a folder. steps: their names, the first of which fills the hopper.

    The case's template.yaml says which parameters mesh and packing depend on, and which may change after a stop."""

    def __init__(self, folder: Path, steps: Sequence[str], ranks: int, signals: Signals) -> None:
        self.folder = folder
        self.steps = list(steps)
        self.filling = self.steps[0]
        self.ranks = ranks
        self.signals = signals
        self.lock: int | None = None
        self.began = time.monotonic()
        template = yaml.safe_load((folder / "template.yaml").read_text())
        self.of_mesh = set(template["shared"]["mesh"]["dependsOn"])
        self.of_packing = set(template["shared"]["filling"]["ofPacking"])
        self.may_change = {*template["mayChange"], *template["steps"].values()}

    # --- what the command line asks for ---

    def run_all(self, fresh: bool) -> None:
        if fresh:
            self.take()
            self.clean()
        else:
            self.take()
            self.require_same_parameters("mesh", *self.steps)
            self.require_same_surface()
        for program in ("blockMesh", SOLVER):
            require_program(program)
        if not (self.folder / "constant/polyMesh/madeFrom").is_file():
            self.make_mesh()
        self.write_sizes()
        self.run_unless_ended(self.filling)
        self.require_packing()
        discharges = self.steps[1:]
        if self.ranks == 1:
            self.run_unless_ended(*discharges)  # side by side, one core each
        else:
            for step in discharges:
                self.run_unless_ended(step)
        self.show_results()

    def run_parts(self, parts: Sequence[str]) -> None:
        self.require_same_surface()
        for part in parts:
            if part == "mesh":
                self.take()
                self.make_mesh()
            elif part == self.filling:
                self.take()
                self.require_mesh()
                self.require_same_parameters("mesh", part)
                self.write_sizes()
                self.run_unless_ended(part)
                self.require_packing()
            else:
                self.take(shared=True)
                self.require_mesh()
                self.require_same_parameters("mesh", "packing", part)
                self.require_packing()
                self.run_unless_ended(part)

    def prepare(self, steps: Sequence[str]) -> None:
        """The folders of steps, for a start by hand."""
        for step in steps:
            self.step_folder(step)
            self.say(f"steps/{step} is ready: start {SOLVER} there")

    def check(self) -> None:
        """Starts each step with -dryRun in a copy elsewhere, so that nothing is left here."""
        if not (self.folder / "constant/polyMesh").is_dir():
            self.say("there is no mesh yet: after './Allrun mesh' this checks more")
            return
        require_program(SOLVER)
        ended = self.has_ended(self.filling)
        with tempfile.TemporaryDirectory() as name:
            steps = [f"step.{step}" for step in self.steps]
            for part in ("0", "constant", "system", "DEM", "parameters", "template.yaml", *steps):
                (Path(name) / part).symlink_to(self.folder / part)
            copy = HopperCase(Path(name), self.steps, 1, self.signals)  # one rank, whatever it will run on
            (copy.folder / "steps").mkdir()
            for step in self.steps if ended else [self.filling]:
                folder = copy.step_folder(step).folder
                if step != self.filling:
                    (copy.folder / "steps" / self.filling).symlink_to(self.folder / "steps" / self.filling)
                self.say(f"step {step}")
                tried = subprocess.run(
                    [SOLVER, "-dryRun"], cwd=folder, env=environment_of(folder), capture_output=True, text=True
                )
                if tried.returncode != 0:
                    print(tried.stdout + tried.stderr, file=sys.stderr)
                    raise Failure(f"step {step} cannot run as it is")
                print(tried.stdout, end="")
                filling = copy.folder / "steps" / self.filling
                if filling.is_symlink():
                    filling.unlink()
                else:
                    shutil.rmtree(filling)

    # --- what is here from earlier runs ---

    def take(self, shared: bool = False) -> None:
        """One Allrun at a time, but discharges side by side. The solvers hold the lock, too."""
        if self.lock is not None:
            os.close(self.lock)
        self.lock = os.open(self.folder, os.O_RDONLY)
        try:
            fcntl.flock(self.lock, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Failure("another Allrun, or a solver that it has started, is at work here") from None

    def clean(self) -> None:
        subprocess.run(["./Allclean"], cwd=self.folder, check=True)

    def require_same_parameters(self, *parts: str) -> None:
        """Each part keeps the parameters that it was begun with: another run must not resume it unnoticed."""
        for part in parts:
            if part == "mesh":
                record = "constant/polyMesh/madeFrom"
                self._refuse_changed("the mesh", record, self.of_mesh, "'./Allrun mesh' makes another")
            elif part == "packing":
                record = f"steps/{self.filling}/parameters"
                self._refuse_changed("the packing", record, self.of_packing, f"remove steps/{self.filling} for another")
            else:
                record = f"steps/{part}/parameters"
                self._refuse_changed(f"step {part}", record, None, f"remove steps/{part} to begin it again")

    def _refuse_changed(self, what: str, record: str, names: set[str] | None, other_way: str) -> None:
        """names: the parameters that count; None for all but those that may change."""
        if not (self.folder / record).is_file():
            return
        changed = [
            line
            for name, line in self.differences(record).items()
            if (name in names if names is not None else name not in self.may_change)
        ]
        if changed:
            raise Failure(
                f"parameters have changed since {what} was begun ({'; '.join(changed)}). Put them back and the same "
                "command resumes; or begin all again by './Allrun -fresh' (removes steps and results); "
                f"or {other_way}"
            )

    def differences(self, record: str) -> dict[str, str]:
        before = parameter_file.parameters(self.folder / record)
        now = parameter_file.parameters(self.folder / "parameters")
        changed = {}
        for name in parameter_file.changed_names(before, now):
            old, new = (parameter_file.shown(values.get(name, "(none)")) for values in (before, now))
            changed[name] = f"{name} {old} -> {new}"
        return changed

    def require_same_surface(self) -> None:
        """Mesh, packing and runs belong to one surface, where the case has one (mesher hopperFromSurface)."""
        used = self.folder / "constant/polyMesh/hopper.stl"
        own = self.folder / "hopper.stl"
        if used.is_file() and not (own.is_file() and own.read_bytes() == used.read_bytes()):
            raise Failure(
                "hopper.stl is not the one that the mesh was made from. Put it back and the same command resumes; "
                "or begin all again by './Allrun -fresh' (removes steps and results)"
            )

    def require_mesh(self) -> None:
        """The mesh of a parameter study lies elsewhere, and was made to its end."""
        mesh = self.folder / "constant/polyMesh"
        if not ((mesh / "madeFrom").is_file() or mesh.is_symlink()):
            raise Failure("there is no whole mesh here: './Allrun mesh' makes it")

    def has_ended(self, step: str) -> bool:
        """The solver writes the restart file once a step has come to its end, and not before."""
        folder = self.folder / "steps" / step
        return (folder / self.restart(step)).is_file() and not Step(folder).was_stopped()

    def restart(self, step: str) -> str:
        return "packing.restart" if step == self.filling else "end.restart"

    def run_unless_ended(self, *steps: str) -> None:
        left = []
        for step in steps:
            record = f"steps/{step}/parameters"
            if self.has_ended(step) and (self.folder / record).is_file() and not self.differences(record):
                self.say(f"{step}: done before")
            else:
                left.append(step)
        if left:
            self.run_steps(left)

    def require_packing(self) -> None:
        if not self.has_ended(self.filling):
            raise Failure(f"the filling has not come to its end: './Allrun {self.filling}' resumes it")
        row = Step(self.folder / "steps" / self.filling).last_row()
        filled = int(float(row[2])) if row else 0
        if filled != int(float(self.parameter("particleCount"))):
            raise Failure(
                f"{filled} particles lie in the hopper, not particleCount: is hopperHeight or fillingTime too small?"
            )

    # --- parts ---

    def step_folder(self, name: str) -> Step:
        """Makes the folder of a step, unless it is there from an earlier start."""
        step = Step(self.folder / "steps" / name)
        if not step.folder.is_dir():
            source = self.folder / f"step.{name}"
            if not source.is_file():
                raise Failure(f"there is neither step.{name} nor steps/{name} here")
            unfinished = step.folder.with_name(f"{name}.new")
            shutil.rmtree(unfinished, ignore_errors=True)
            unfinished.mkdir(parents=True)
            for part in USER_LINKS:
                (unfinished / part).symlink_to(Path("../..") / part)
            shutil.copytree(self.folder / "0", unfinished / "0")
            shutil.copy(source, unfinished / "step")
            unfinished.rename(step.folder)
        step.write_ranks(self.ranks)
        return step

    def make_mesh(self) -> None:
        """One mesh for all steps: they share the folder constant/."""
        self.say("mesh")
        step = self.step_folder(self.filling)
        mesh = self.folder / "constant/polyMesh"
        for name in ("madeFrom", "hopper.stl"):
            (mesh / name).unlink(missing_ok=True)
        mesher = self.parameter("mesher")
        if subprocess.run([CLEPSYDRA / "meshes" / mesher, "parameters", "."], cwd=self.folder).returncode != 0:
            raise Failure(f"meshes/{mesher} made no mesh")
        for line in (self.folder / "system/meshSteps").read_text().splitlines():
            run_logged(step.folder, *line.split())
        run_logged(step.folder, "checkMesh")
        said = (step.folder / "log.checkMesh").read_text()
        if not re.search("(?m)^Mesh OK", said):
            raise Failure(f"checkMesh found faults: see steps/{self.filling}/log.checkMesh")
        for cells in re.findall(r"(?m)^ *cells: *(.*)$", said):
            print(f"  cells: {cells}", flush=True)
        if mesher == "hopperFromSurface":
            shutil.copy(self.folder / "hopper.stl", mesh)
        shutil.copy(self.folder / "parameters", mesh / "madeFrom")

    def write_sizes(self) -> None:
        """The sizes of particles for DEM/in.filling, where they differ."""
        sizes = self.folder / "DEM/in.sizes"
        deviation = self.parameter("diameterDeviation")
        sizes.unlink(missing_ok=True)
        if deviation != "0":
            mean = self.parameter("particleDiameter")
            command = [str(SCRIPTS / "sizeDistribution"), "--mean", mean, "--relativeDeviation", deviation]
            made = subprocess.run([*command, "--density", "${particleDensity}"], stdout=subprocess.PIPE, text=True)
            if made.returncode != 0:
                raise Failure("scripts/sizeDistribution made no DEM/in.sizes")
            sizes.write_text(made.stdout)

    def run_steps(self, names: Sequence[str]) -> None:
        """Starts steps, or resumes them from their checkpoints, waits for them all, and reports progress.

        Ctrl-C and SIGTERM reach the solvers, which write a checkpoint; then this program ends with status 130 or 143.
        """
        self.say(" ".join(names))
        require_program(SOLVER)
        since = time.monotonic()
        steps = [self.step_folder(name) for name in names]
        for step in steps:
            shutil.copy(self.folder / "parameters", step.folder)
            for restart in ("packing.restart", "end.restart"):  # they say that the step has come to its end
                for path in (step.folder / restart, step.folder / f"{restart}.sha256"):
                    path.unlink(missing_ok=True)
            step.redistribute(self.ranks)
        stopped = self._wait_for(steps)
        self.report_progress(steps)
        print(f"  {time.monotonic() - since:.0f} s", flush=True)
        if stopped:
            raise Stopped(stopped)

    def _wait_for(self, steps: Sequence[Step]) -> int:
        """0, or the status with which to end because the steps were asked to stop."""
        stopped = 0
        reported = time.monotonic()
        running: dict[str, tuple[Step, subprocess.Popen[bytes]]] = {}
        self.signals.solvers = []
        try:
            for step in steps:
                process = step.start(self.ranks, self.lock)
                running[step.name] = step, process
                self.signals.solvers.append(process)
            if self.signals.status:  # a signal that came before the last solver was on the list
                for process in self.signals.solvers:
                    ask_to_stop(process)
            while running:
                time.sleep(SECONDS_BETWEEN_LOOKS)
                for step, process in list(running.values()):
                    if process.poll() is None:
                        continue
                    del running[step.name]
                    stopped = stopped or self.signals.status
                    if process.returncode != 0 and not stopped:
                        self.fail_step(step)
                    if step.was_stopped() and not stopped:
                        stopped = STOPPED_BY_ITSELF
                if time.monotonic() - reported > SECONDS_BETWEEN_REPORTS:
                    self.report_progress(steps)
                    reported = time.monotonic()
        finally:
            # A failure must not leave the others behind.
            for _, process in running.values():
                ask_to_stop(process)
            self.signals.solvers = None
        return stopped or self.signals.status

    def report_progress(self, steps: Sequence[Step]) -> None:
        rows = [(step.name, step.last_row()) for step in steps]
        line = "".join(
            f"  {name}: {float(row[0]):.2f} s, {row[2]} particles in the hopper" for name, row in rows if row
        )
        if line:
            print(line, flush=True)

    def fail_step(self, step: Step) -> None:
        print("\n".join(last_run(step.log).splitlines()[-TAIL_LINES:]), file=sys.stderr)
        raise Failure(f"step {step.name} failed: see {step.log}")

    def show_results(self) -> None:
        self.say("results")
        discharges = [f"steps/{name}" for name in self.steps[1:]]
        commands: list[list[str | Path]] = [[SCRIPTS / "plotFlow", "results", *discharges], ["./summarise"]]
        if self.parameter("drawParticles") != "off":
            for discharge in discharges:
                if case_files.is_divided(self.folder / discharge, "U"):
                    run_logged(self.folder / discharge, "reconstructPar", "-fields", "(U)")
            picture = ["results/particles.png", *discharges]
            commands.append([SCRIPTS / "renderFlow", *picture])
        for command in commands:
            if subprocess.run(command, cwd=self.folder).returncode != 0:
                raise Failure(f"{Path(command[0]).name} failed")
        results = self.folder / "results"
        self.say(f"{results}: {' '.join(sorted(path.name for path in results.iterdir()))}")
        self.say(f"{time.monotonic() - self.began:.0f} s in all")

    # --- small things ---

    def parameter(self, name: str) -> str:
        found = parameter_file.parameters(self.folder / "parameters")
        if name not in found:
            raise Failure(f"parameters: entry '{name}' is missing")
        return str(parameter_file.shown(found[name]))

    def say(self, words: str) -> None:
        print(f"{self.folder.name}: {words}", flush=True)


def run_here(folder: Path, ranks: int, signals: Signals) -> None:
    """The step in a folder by itself, or its rest; Stopped where it was asked to stop."""
    step = Step(folder)
    step.write_ranks(ranks)
    step.redistribute(ranks)
    process = step.start(ranks)
    signals.solvers = [process]
    if signals.status:  # a signal that came before the solver was on the list
        ask_to_stop(process)
    process.wait()
    if signals.status or step.was_stopped():
        raise Stopped(signals.status or STOPPED_BY_ITSELF)
    if process.returncode != 0:
        raise Failure(f"the solver failed: see {step.log}")


# --- command line -----------------------------------------------------------------------------------------------------


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="Allrun",
        description="Meshes, fills and discharges a hopper. After a stop the same command resumes the run.",
        epilog="PART: mesh; the name of a step; check (whether parameters and case are right; makes nothing)",
        allow_abbrev=False,
    )
    parser.add_argument("--steps", metavar="FILLING,DISCHARGE,...", default="", help=argparse.SUPPRESS)
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)  # the step whose folder this is
    parser.add_argument(
        "-np", dest="ranks", metavar="RANKS", help="MPI ranks of each step (default: entry 'ranks' of parameters)"
    )
    parser.add_argument("-fresh", action="store_true", help="remove what is here from earlier runs first")
    parser.add_argument(
        "-prepare", action="store_true", help="only make the folders of the steps named, for a start by hand"
    )
    parser.add_argument("parts", metavar="PART", nargs="*", help="only these; all of it where none is given")
    options = parser.parse_args(arguments)
    options.steps = options.steps.split(",")
    if options.here != (options.steps == [""]) or (options.here and not options.ranks):
        parser.error("either --steps FILLING,DISCHARGE,... or --here -np RANKS")
    known = ["mesh", "check", *options.steps]
    for part in options.parts:
        # A variant of a step, whose folder the user made.
        if part not in known and not Path("steps", part, "step").is_file():
            parser.error(f"there is no part '{part}'; allowed: {', '.join(known)}")
    if "check" in options.parts and len(options.parts) > 1:
        parser.error("'check' stands alone")
    if options.fresh and options.parts:
        parser.error("-fresh stands alone")
    if options.prepare and (not options.parts or set(options.parts) & {"mesh", "check"}):
        parser.error("-prepare needs the names of steps")
    return options


def read_ranks(said: str | None) -> int:
    text = (
        said
        if said is not None
        else str(parameter_file.shown(parameter_file.parameters("parameters").get("ranks", 1.0)))
    )
    if not re.fullmatch("[1-9][0-9]{0,5}", text):
        raise Failure(f"the number of ranks is a whole number above 0, not '{text}'")
    return int(text)


def require_plain_paths(*folders: Path) -> None:
    """OpenFOAM takes such characters out of paths without asking, and then finds no file."""
    for folder in folders:
        if re.search(r"[\s\"']", str(folder)):
            raise Failure(f"'{folder}' has a space or a quote in it, which OpenFOAM cannot bear; move it")


def check_parameters(ranks: int, part: str, report: bool) -> None:
    if case_rules.report(Path("parameters"), ranks, part, report) != 0:
        raise Failure("nothing was run")


@contextlib.contextmanager
def reported(name: str) -> Iterator[None]:
    """Failures end the program with a line, and a stop with the status of its signal."""
    try:
        yield
    except Failure as problem:
        sys.exit(f"{name}: {problem}")
    except Stopped as stop:
        print(f"{name}: {AFTER_STOP}", flush=True)
        sys.exit(stop.status)


def main(arguments: Sequence[str]) -> None:
    folder = Path.cwd()
    signals = Signals()
    with reported(folder.name):
        require_plain_paths(folder, SCRIPTS)
        options = parse(arguments)
        signals.install()
        ranks = read_ranks(options.ranks)
        if options.here:
            run_here(folder, ranks, signals)
            return
        case = HopperCase(folder, options.steps, ranks, signals)
        if options.prepare:
            case.prepare(options.parts)
        elif options.parts == ["check"]:
            check_parameters(ranks, "all", report=True)
            case.check()
        elif options.parts:
            # A mesh or a filling alone may serve runs that differ in all else.
            largest = next((part for part in ("mesh", case.filling) if set(options.parts) <= {"mesh", part}), "all")
            check_parameters(ranks, largest, report=False)
            case.run_parts(options.parts)
        else:
            check_parameters(ranks, "all", report=False)
            case.run_all(options.fresh)


if __name__ == "__main__":
    main(sys.argv[1:])
