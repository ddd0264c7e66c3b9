"""Runs that go on after something around them has changed: the case, the batch system, the file system."""

import functools
import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path
from typing import Any

from developers.fault_kinds.bench import END, STOPPED, Bench, Case, sha256
from developers.fault_kinds.damage import refusal
from developers.fault_kinds.disk import on_small_disk_at, room_again
from developers.fault_kinds.kinds import Wrong, fault
from developers.fault_kinds.stops import ended_and_resumed, last_time

RESUMED = f"Resuming from the checkpoint of time {STOPPED}\n"
DUMP = "dump frames all custom 50 DEM/frames.dump id x y z\n"
PRINT = 'variable t equal step*4e-5\nfix printed all print 50 "${t}" file DEM/printed.txt screen no\n'
AVERAGE = "compute energy all ke\nfix average all ave/time 50 1 50 c_energy file DEM/average.txt\n"
# What the script writes at its start only. The second makes LIGGGHTS initialise its fixes there, in another order.
NOTE = 'print "started" append DEM/starts.txt\nshell rm -f DEM/frames.dump\n'
PACKING = "write_restart DEM/start.restart\n"


def add_to_script(case: Case, text: str) -> Case:
    script = case.folder / "DEM/in.particles"
    script.write_text(script.read_text() + "\n" + text)
    return case


def must_prepare(bench: Bench, command: list[Any], case: Case) -> None:
    outcome = bench.call(command, case.folder, case.folder.with_name("prepare.log"))
    if outcome.status != 0:
        raise SystemExit(f"faults: {command[0]} failed: {outcome.last_words}")


@fault(
    "fields of an earlier run of the case lie where reconstructPar was forgotten",
    "refuses and names reconstructPar; nothing is changed, and with it the run goes on",
)
def fields_of_another_run(bench: Bench) -> list[Any]:
    def forget() -> str:
        case = bench.pile(2)
        case.ranks = 1
        case.must_run()  # of another friction, to the end
        shutil.rmtree(case.folder / "checkpoints")
        case.edit("DEM/in.particles", "0.15 0.15 0.15 0.15", "0.5 0.5 0.5 0.5")
        case.ranks = 2
        case.set(endTime=STOPPED).must_run()
        case.ranks = 1
        case.set(endTime=END)
        said = refusal(case, ["reconstructPar", f"{STOPPED}/uniform/checkpoint"])
        must_prepare(bench, ["reconstructPar"], case)
        if not case.must_run().says(RESUMED):
            raise Wrong("with reconstructPar it does not go on")
        return said + "; reconstructed, it goes on"

    return [forget]


@fault(
    "a run whose DEM script writes a dump and tables goes on, after an end or SIGKILL",
    "dump, tables and what is written at the start are those of an undisturbed run, byte for byte",
)
def script_output(bench: Bench) -> list[Any]:
    def keep_packing() -> str:
        case = add_to_script(bench.pile(endTime=STOPPED), PACKING)
        case.must_run()
        written = sha256(case.folder / "DEM/start.restart")
        if not case.set(endTime=END).must_run().says(RESUMED):
            raise Wrong("begins again")
        if sha256(case.folder / "DEM/start.restart") != written:
            raise Wrong("the restart file of the start has the particles of the checkpoint")
        return "not written again"

    return [*(functools.partial(continue_output, bench, how) for how in ("ended", "killed")), keep_packing]


def continue_output(bench: Bench, how: str) -> str:
    names = ["frames.dump", "printed.txt", "average.txt", "starts.txt"]
    script = NOTE + DUMP + PRINT + AVERAGE
    reference = add_to_script(bench.pile(), script)
    reference.must_run()
    case = add_to_script(bench.pile(), script)
    if how == "ended":
        case.set(endTime=STOPPED).must_run()
    else:
        process = case.start()
        if not case.wait_for("\nTime = 0.075\n", process):
            raise Wrong("ended before the signal")
        process.kill()
        process.wait()
    case.set(endTime=END).must_run()
    for name in names:
        expected, found = ((each.folder / "DEM" / name).read_bytes() for each in (reference, case))
        if found != expected:
            raise Wrong(f"{name} has {len(found)} bytes in place of {len(expected)}, or others")
    case.require_undisturbed(reference.folder)
    return "same end"


@fault(
    "a run goes on whose DEM script makes its particles by replicate and changes its box",
    "nothing is made twice: the same end as undisturbed",
)
def commands_not_repeated(bench: Bench) -> list[Any]:
    def replicated() -> Case:
        case = bench.pile()
        script = case.folder / "DEM/in.particles"
        text = script.read_text().replace("-0.002 0.026 units box", "0 0.012 units box")
        # the lower half, which is then copied upwards
        lines = [line for line in text.splitlines() if not re.match(r"create_atoms .* 0\.01[2-9]\d* units box", line)]
        at = next(i for i, line in enumerate(lines) if line.startswith("create_box"))
        atoms = [line for line in lines if line.startswith(("create_atoms", "set "))]
        others = [line for line in lines[at + 1 :] if line not in atoms]
        made = [*atoms, "replicate 1 1 2 offset 0 0 0.012 shift 0 0 0", "change_box all z final -0.002 0.026 units box"]
        script.write_text("\n".join([*lines[: at + 1], *made, *others]) + "\n")
        return case

    def go_on() -> str:
        reference = replicated()
        reference.must_run()
        case = replicated()
        case.set(endTime=STOPPED).must_run()
        if not case.set(endTime=END).must_run().says(RESUMED):
            raise Wrong("begins again")
        case.require_undisturbed(reference.folder)
        return "same end"

    return [go_on]


@fault(
    "the mesh is another, or has one changed coordinate, when a run goes on",
    "refuses and names the mesh; nothing is changed, and with the mesh back the same end",
)
def other_mesh(bench: Bench) -> list[Any]:
    return [
        functools.partial(change_mesh, bench, change)
        for change in bench.some(["graded", "one coordinate", "finer", "graded, other ranks"], 2)
    ]


def change_mesh(bench: Bench, change: str) -> str:
    case = bench.stopped()
    kept = bench.fresh_folder("kept")
    shutil.copytree(case.folder / "constant/polyMesh", kept, dirs_exist_ok=True)
    if change == "one coordinate":
        points = case.folder / "constant/polyMesh/points"
        text = points.read_bytes()
        at = len(text) // 2
        at = next(i for i in range(at, len(text)) if chr(text[i]) in "12345678")
        points.write_bytes(text[:at] + str(9 - int(chr(text[at]))).encode() + text[at + 1 :])
    else:
        block = case.folder / "system/blockMeshDict"
        before = block.read_text()
        if change.startswith("graded"):
            text, found = re.subn(r"simpleGrading \(1 1 1\)", "simpleGrading (1 1 2)", before)
        else:
            text, found = re.subn(r"7\) \((\d+) (\d+) (\d+)\)", r"7) (\1 \2 1\3)", before)
        if not found:
            raise SystemExit(f"faults: {block} has no grading or cells to change")
        block.write_text(text)
        must_prepare(bench, ["blockMesh"], case)
        block.write_text(before)
    if change.endswith("other ranks"):
        must_prepare(bench, ["decomposePar", "-latestTime"], case)
        case.ranks = 2
        outcome = case.run()
        if outcome.status == 0 or not outcome.says("The mesh is not that of the checkpoint"):
            raise Wrong(f"{change}: status {outcome.status}, {outcome.last_words}")
        case.ranks = 1
        said = "refused"
        for part in case.folder.glob("processor*"):
            shutil.rmtree(part)
    else:
        said = refusal(case, ["The mesh is not that of the checkpoint", "constant/polyMesh"])
    shutil.rmtree(case.folder / "constant/polyMesh")
    shutil.copytree(kept, case.folder / "constant/polyMesh")
    case.settle()
    return said + "; with the mesh back, the same end"


@fault(
    "DEM script, a file that it includes, couplingProperties or transportProperties is changed when a run goes on",
    "a warning names each changed file, and no other; the run goes on",
)
def other_inputs(bench: Bench) -> list[Any]:
    def change() -> str:
        case = bench.pile()
        script = case.folder / "DEM/in.particles"
        script.write_text(script.read_text() + "\ninclude DEM/in.more\n")
        more = case.folder / "DEM/in.more"
        more.write_text("neigh_modify delay 0\n")
        case.set(endTime=STOPPED).must_run()
        case.set(endTime="0.07")
        unchanged = case.must_run()
        if unchanged.says("WARNING"):
            raise Wrong("a warning though nothing has changed: " + unchanged.output[:400])
        more.write_text("neigh_modify delay 0\n# changed\n")
        case.edit("DEM/in.particles", "0.15 0.15 0.15 0.15", "0.9 0.9 0.9 0.9")
        case.edit("constant/couplingProperties", "bandwidth .*;", "bandwidth 7e-3;")
        case.set(endTime="0.08")
        outcome = case.must_run()
        for name in ("constant/couplingProperties", "DEM/in.particles", "DEM/in.more"):
            if not outcome.says(f"\n    {name} has changed"):
                raise Wrong(f"{name} is not named: {outcome.output[:600]}")
        if outcome.says("transportProperties has changed"):
            raise Wrong("names a file that has not changed")
        return "each is named"

    return [change]


@fault(
    "the disk is full where the DEM script's dumps, or OpenFOAM's probes, are",
    "stops with the file's name; with room again the same command goes on",
)
def disk_full_for_other_output(bench: Bench) -> list[Any]:
    def fill(folder: str, room: int, prepare: Any) -> str:
        case = prepare(bench.pile())
        reference = prepare(bench.pile())
        reference.must_run()
        (case.folder / folder).parent.mkdir(exist_ok=True)
        disk = on_small_disk_at(bench, case.folder / folder, room)
        outcome = case.run()
        # LIGGGHTS keeps no error number of a write that has failed between two of its flushes.
        explained = outcome.says("No space left") or outcome.says("is the disk full?")
        if outcome.status == 0 or not explained or not re.search(rf"annot write \S*{folder}/", outcome.output):
            raise Wrong(f"{folder}: status {outcome.status}, {outcome.last_words}")
        room_again(bench, disk)
        case.must_run()
        case.require_undisturbed(reference.folder)
        for dump in (case.folder / "post").glob("*.dump"):
            if dump.read_bytes() != (reference.folder / "post" / dump.name).read_bytes():
                raise Wrong(f"{dump.name} is not that of an undisturbed run")
        return "stopped with the file's name, then the same end"

    def dumps(case: Case) -> Case:
        (case.folder / "post").mkdir()
        return add_to_script(case, "dump frames all custom 10 post/frames.dump id x y z vx vy vz\n")

    def pictures(case: Case) -> Case:
        (case.folder / "post").mkdir()
        return add_to_script(case, "dump pictures all custom/vtk 100 post/particles*.vtk id x y z vx vy vz\n")

    def probes(case: Case) -> Case:
        entries = "probes { type probes; libs (sampling); fields (p U); probeLocations ((.006 .006 .01)); }"
        return case.edit("system/controlDict", r"^functions\s*\{", "functions\n{\n" + entries)

    places = [("post", 64, dumps), ("post", 64, pictures), ("postProcessing/probes", 8, probes)]
    return [functools.partial(fill, *place) for place in bench.some(places, quick=2)]


@fault(
    "the file system has no symbolic links, no rename, no fsync (EPERM, ENOSYS, EIO)",
    "refuses at the start, before the first step; on another file system the same end",
)
def file_system_without(bench: Bench) -> list[Any]:
    bench.needs("strace", "strace")
    return [
        functools.partial(refuse_file_system, bench, call, error)
        for call, error in bench.some([("symlink", "EPERM"), ("rename", "EPERM"), ("fsync", "EIO")], 1)
    ]


def refuse_file_system(bench: Bench, call: str, error: str) -> str:
    case = bench.pile()
    outcome = case.run(["strace", "-f", "-o", "/dev/null", "-e", f"inject={call}:error={error}"])
    if outcome.status == 0 or not outcome.says("cannot hold a checkpoint") or outcome.says("\nTime = "):
        raise Wrong(f"{call}: status {outcome.status}, {outcome.last_words}")
    case.settle()
    return "refused at the start, then the same end"


@fault("the file system has no locks (ENOLCK)", "a warning; the same end")
def no_locks(bench: Bench) -> list[Any]:
    bench.needs("strace", "strace")

    def run() -> str:
        case = bench.pile()
        outcome = case.run(["strace", "-f", "-o", "/dev/null", "-e", "inject=flock:error=ENOLCK"])
        if outcome.status != 0 or not outcome.says("has no locks"):
            raise Wrong(f"status {outcome.status}: {outcome.last_words}")
        case.require_undisturbed()
        return "warned; same end"

    return [run]


@fault(
    "standard input, output and error are closed, as for a daemon",
    "no message gets into a file of the run; the same end",
)
def streams_closed(bench: Bench) -> list[Any]:
    def run() -> str:
        case = bench.pile()
        outcome = bench.call(["sh", "-c", "exec pimpleDemFoam <&- >&- 2>&-"], case.folder)
        lock = (case.folder / ".pimpleDemFoam.lock").read_text(errors="replace")
        if outcome.status != 0 or not re.fullmatch(r"process \d+ on host \S+", lock):
            raise Wrong(f"status {outcome.status}; the lock holds {lock[:100]!r}")
        case.require_undisturbed()
        return "same end"

    return [run]


@fault(
    "SIGUSR1, SIGUSR2 or SIGXCPU, twice, as batch systems announce the end of a job",
    "status 0 with a checkpoint; then the end of a run that ended there by its endTime",
)
def announced(bench: Bench) -> list[Any]:
    signals = [signal.SIGUSR1, signal.SIGXCPU, signal.SIGUSR2]
    return [functools.partial(announce, bench, how) for how in bench.some(signals, quick=1)]


def announce(bench: Bench, how: signal.Signals) -> str:
    case = bench.pile()
    process = case.start()
    if not case.wait_for("\nTime = 0.03", process):
        raise Wrong("ended before the signal")
    process.send_signal(how)
    process.send_signal(how)
    outcome = bench.finished(process, case.log)
    if outcome.status != 0 or not outcome.stopped:
        raise Wrong(f"{how.name}: status {outcome.status}, {outcome.last_words}")
    stopped_at = last_time(outcome)
    case.must_run()
    case.require_undisturbed(ended_and_resumed(bench, stopped_at).folder)
    return "checkpoint written, same end"


@fault("SIGINT to a run that was started to ignore it, as by a shell in the background", "goes on to the same end")
def interrupt_ignored(bench: Bench) -> list[Any]:
    def run() -> str:
        case = bench.pile()
        process = case.start(preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
        if not case.wait_for("\nTime = 0.03", process):
            raise Wrong("ended before the signal")
        process.send_signal(signal.SIGINT)
        outcome = bench.finished(process, case.log)
        if outcome.status != 0 or outcome.stopped:
            raise Wrong(f"status {outcome.status}, {outcome.last_words}")
        case.require_undisturbed()
        return "same end"

    return [run]


# From the 60th call on a day later; OpenFOAM's clock uses time().
LATER = """#define _GNU_SOURCE
#include <time.h>
time_t time(time_t *result) {
    static int calls;
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    time_t value = now.tv_sec + (++calls > 60 ? 86400 : 0);
    if (result) *result = value;
    return value;
}
"""
# The clock of one rank alone is an hour ahead from the 500th call on.
AHEAD = """#define _GNU_SOURCE
#include <stdlib.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
int clock_gettime(clockid_t clock, struct timespec *now) {
    static int calls;
    const char *rank = getenv("OMPI_COMM_WORLD_RANK");
    int result = syscall(SYS_clock_gettime, clock, now);
    if (clock == CLOCK_MONOTONIC && rank && rank[0] == '1' && ++calls > 500) now->tv_sec += 3600;
    return result;
}
"""


def preloaded(bench: Bench, text: str) -> Path:
    bench.needs("cc", "gcc")
    folder = bench.fresh_folder("clock")
    (folder / "clock.c").write_text(text)
    library = folder / "clock.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-o", library, folder / "clock.c"], check=True)
    return library


@fault(
    "the system's clock is set a day forward in a run with maxClockTime, or the clock of one of two ranks is ahead",
    "the first goes on to the same end; the second stops on both ranks with a checkpoint",
    in_quick=False,
)
def clock_set(bench: Bench) -> list[Any]:
    def limited(ranks: int) -> Case:
        case = bench.pile(ranks)
        control_dict = case.folder / "system/controlDict"
        control_dict.write_text(control_dict.read_text() + "maxClockTime 3000;\n")
        return case

    def set_forward() -> str:
        case = limited(1)
        outcome = case.run(["env", f"LD_PRELOAD={preloaded(bench, LATER)}"])
        if outcome.status != 0 or outcome.stopped:
            raise Wrong(f"status {outcome.status}: {outcome.last_words}")
        case.require_undisturbed()
        return "same end"

    def one_ahead() -> str:
        case = limited(2)
        case.set(endTime=1000, writeInterval=500)
        outcome = case.run(["env", f"LD_PRELOAD={preloaded(bench, AHEAD)}"])
        if outcome.status != 0 or not outcome.stopped:
            raise Wrong(f"status {outcome.status}: {outcome.last_words}")
        times = [float(last_time(outcome))]
        for rank in range(2):
            part = case.folder / f"processor{rank}"
            times += [max(float(folder.name) for folder in part.glob("[0-9]*"))]
        if len(set(times)) != 1:
            raise Wrong(f"the ranks ended at {times}")
        return "both ranks stopped with a checkpoint"

    return [set_forward, one_ahead]


@fault(
    "purgeWrite 1 or writeCompression on is written into controlDict during a run",
    "a warning; what was allowed stays: the same end",
    in_quick=False,
)
def controls_edited(bench: Bench) -> list[Any]:
    entries = ["purgeWrite 1;", "writeCompression on;"]
    return [functools.partial(edit_controls, bench, entry) for entry in bench.some(entries, quick=1)]


def edit_controls(bench: Bench, entry: str) -> str:
    # Binary files are not compressed at all.
    reference = bench.pile(writeFormat="ascii")
    reference.must_run()
    case = bench.pile(runTimeModifiable="yes", writeFormat="ascii")
    process = case.start()
    if not case.wait_for("\nTime = 0.03", process):
        raise Wrong("ended before the edit")
    process.send_signal(signal.SIGSTOP)
    control_dict = case.folder / "system/controlDict"
    control_dict.write_text(control_dict.read_text() + entry + "\n")
    later = time.time() + 60  # OpenFOAM heeds a file that is younger by some seconds
    os.utime(control_dict, (later, later))
    process.send_signal(signal.SIGCONT)
    outcome = bench.finished(process, case.log)
    name = entry.split()[0]
    if outcome.status != 0 or not outcome.says(f"WARNING: entry '{name}'"):
        raise Wrong(f"{entry} status {outcome.status}: {outcome.last_words}")
    case.require_undisturbed(reference.folder)
    return "warned; same end"


@fault(
    "the power fails when a checkpoint has become complete: all that was not synced by then is lost",
    "every file of the manifest, every table and every folder with their names was synced before",
)
def power_lost(bench: Bench) -> list[Any]:
    bench.needs("strace", "strace")
    return [functools.partial(lose_power, bench, ranks) for ranks in bench.some((2, 1), quick=1)]


CALL = re.compile(r"^(\d+) +(\w+)\((.*)\) += (-?\d+)")
UNFINISHED = re.compile(r"^(\d+) +(\w+)\((.*) <unfinished \.\.\.>$")
RESUMED_CALL = re.compile(r"^(\d+) +<\.\.\. (\w+) resumed>(.*)\) += (-?\d+)")
DESCRIPTOR = re.compile(r"^\d+<(/[^>]*)>")


def lose_power(bench: Bench, ranks: int) -> str:
    case = add_to_script(bench.pile(ranks, endTime="0.04"), DUMP + PRINT)
    trace = bench.fresh_folder("trace") / "trace"
    traced = "trace=fsync,fdatasync,write,writev,pwrite64,rename,mkdir,openat"
    outcome = case.run(["strace", "-f", "-y", "-s", "300", "-o", trace, "-e", traced])
    if outcome.status != 0:
        raise Wrong("does not run under strace: " + outcome.last_words)
    synced: dict[Path, int] = {}
    changed: dict[Path, int] = {}
    complete = 0
    for number, (name, arguments) in enumerate(calls(trace.read_text(errors="replace"))):
        descriptor = DESCRIPTOR.match(arguments)
        paths = [case.folder / path for path in re.findall(r'"([^"]*)"', arguments)]
        if name in ("fsync", "fdatasync") and descriptor:
            synced[Path(descriptor[1])] = number
        elif name in ("write", "writev", "pwrite64") and descriptor:
            changed[Path(descriptor[1])] = number
        elif name == "openat" and "O_CREAT" in arguments and paths and paths[0] not in changed:
            changed[paths[0]] = number
            # The manifest's own name is synced after it has been renamed.
            if not paths[0].name.startswith("complete"):
                changed[paths[0].parent] = number
        elif name == "mkdir" and paths:
            changed[paths[0].parent] = changed[paths[0]] = number
        elif name == "rename" and len(paths) == 2:
            synced[paths[1]] = synced.get(paths[0], -1)
            changed[paths[1]] = changed.get(paths[0], number)
            if paths[1].name == "complete":
                complete += 1
                require_synced(case, paths[1].parent.name, synced, changed)
            changed[paths[1].parent] = number
    if complete != 2:
        raise Wrong(f"saw {complete} checkpoints in place of 2")
    return "all was synced before"


def calls(trace: str) -> Any:
    """Name and arguments of each call of a trace of several threads, where it ends."""
    begun: dict[tuple[str, str], str] = {}
    for line in trace.splitlines():
        if found := CALL.match(line):
            if int(found[4]) >= 0:
                yield found[2], found[3]
        elif found := UNFINISHED.match(line):
            begun[found[1], found[2]] = found[3]
        elif found := RESUMED_CALL.match(line):
            arguments = begun.pop((found[1], found[2]), "") + found[3]
            if int(found[4]) >= 0:
                yield found[2], arguments


def require_synced(case: Case, time_name: str, synced: dict[Path, int], changed: dict[Path, int]) -> None:
    needed = {case.folder, case.folder / "checkpoints", case.folder / "checkpoints" / time_name}
    parts = [case.folder] if case.ranks == 1 else sorted(case.folder.glob("processor*"))
    for part in parts:
        needed |= {part, part / time_name, *(path for path in (part / time_name).rglob("*"))}
    needed |= set((case.folder / "postProcessing").rglob("*"))
    needed |= {case.folder / "DEM/frames.dump", case.folder / "DEM/printed.txt"}
    # What exists in the end and was not changed by then does not count.
    seen = [case.folder / name for name in case.manifest(time_name) if "uniform" not in name]
    if unseen := [path.name for path in seen if path not in changed]:
        raise Wrong("the trace does not show who wrote " + ", ".join(unseen[:5]))
    late = [
        str(path.relative_to(case.folder))
        for path in sorted(needed)
        if path in changed and synced.get(path, -1) < changed[path]
    ]
    if late:
        raise Wrong(f"not synced when {time_name} was complete: " + ", ".join(late[:5]))
