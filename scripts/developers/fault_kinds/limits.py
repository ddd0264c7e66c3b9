"""Too little memory, too few open files, too small a file; and numbers that no run can go on with."""

import functools
import signal
import subprocess
from pathlib import Path
from typing import Any, Callable

from developers.fault_kinds.bench import Bench
from developers.fault_kinds.disk import judged_where_engines_crash
from developers.fault_kinds.kinds import Wrong, fault

STOPS = (
    "ends with a message, by the signal that the system sends or by the crash of an engine; "
    "without the limit the same command goes on to the same end"
)


# What the program, the loader, MPI and the C++ library call a lack of it.
OF_LIMIT = {
    "--as": ("memory", "alloc", "map", "pthread_create", "Resource temporarily unavailable"),
    "--fsize": ("File too large", "is the disk full", "could not be", "Cannot write"),
    "--nofile": ("Too many open files", "open", "pipe", "socket", "file descriptor"),
}


def limited(bench: Bench, option: Any) -> Any:
    case = bench.stopped()
    outcome = case.run(["prlimit", option])
    said = "went on; same end"
    if outcome.status != 0:
        # OpenFOAM crashes while it prints its message where it cannot open the files of its own libraries.
        crashed = outcome.status in (-signal.SIGSEGV, -signal.SIGABRT)
        # SIGXFSZ, as documented in setrlimit(2)
        if not (outcome.explains(*OF_LIMIT[option.partition("=")[0]]) or crashed or outcome.status == -25):
            raise Wrong(f"{option}: status {outcome.status} without a message: {outcome.last_words}")
        said = f"{'an engine crashed' if crashed else 'ended with a message or by SIGXFSZ'}, then the same end"
    case.settle()
    return said


@fault("address space limited to so many MB", STOPS)
def memory_limit(bench: Bench) -> list[Any]:
    return [
        functools.partial(limited, bench, f"--as={size * 1000000}")
        for size in bench.some((50, 100, 150, 200, 250, 300, 350, 400, 450, 500, 550, 600, 700, 800), quick=2)
    ]


@fault("address space limited in the midst of a run", STOPS, in_quick=False)
def memory_gone(bench: Bench) -> list[Any]:
    return [functools.partial(take_memory, bench, spare) for spare in (0, 1, 4, 16)]


def take_memory(bench: Bench, spare: Any) -> Any:
    case = bench.pile()
    process = case.start()
    case.wait_for("\nTime = 0.03", process)
    with open(f"/proc/{process.pid}/statm") as sizes:
        used = int(sizes.read().split()[0]) * 4096
    subprocess.run(["prlimit", f"--pid={process.pid}", f"--as={used + spare * 1000000}"], stderr=subprocess.DEVNULL)
    outcome = bench.finished(process, case.log)
    said = judged_where_engines_crash(outcome)
    case.settle()
    return said


@fault("files limited to so many bytes (ulimit -f)", STOPS, in_quick=False)
def file_size_limit(bench: Bench) -> list[Any]:
    return [functools.partial(limited, bench, f"--fsize={size}") for size in (0, 1000, 5000, 11430, 50000, 90000)]


@fault("so many files may be open at once", STOPS, in_quick=False)
def open_files_limit(bench: Bench) -> list[Any]:
    return [functools.partial(limited, bench, f"--nofile={count}") for count in (10, 16, 20, 22, 23, 24, 25, 26, 28)]


@fault(
    (
        "numbers that no run can go on with: "
        "NaN in a field, a time step or a particle far too fast, a liquid without density"
    ),
    "stops with a message",
)
def numerical_faults(bench: Bench) -> list[Any]:
    return [
        functools.partial(unstable, bench, *change)
        for change in bench.some(
            (
                ("0/p", "uniform 0;", "uniform nan;", "0/p"),
                ("0/U", r"uniform \(0 0 0\);", "uniform (0 nan 0);", "0/U"),
                ("DEM/in.particles", "^timestep .*", "timestep 2e-4", "Rayleigh"),
                (
                    "DEM/in.particles",
                    "^fix motion",
                    "velocity all set 0 0 -1000 units box\nfix motion",
                    "outside the box",
                ),
                ("DEM/in.particles", "peratomtype 5e6 5e6", "peratomtype 5e12 5e12", "youngsModulus"),
                ("constant/transportProperties", r"1000;", "-1000;", "'rho' is -1000"),
                ("constant/transportProperties", r"1000;", "nan;", "transportProperties.rho"),
                ("constant/transportProperties", r"1e-6;", "-1e-6;", "'nu' is -1e-06"),
                ("constant/g", r"-9.81\)", "nan)", "constant/g"),
            ),
            quick=3,
        )
    ]


def unstable(bench: Bench, file: Path, pattern: str, replacement: Any, named: str) -> str:
    case = bench.pile()
    case.edit(file, pattern, replacement)
    outcome = case.run()
    if outcome.status == 0 or not outcome.explains(named):
        raise Wrong(f"{replacement!r} in {file}: status {outcome.status}, {outcome.last_words}")
    return "stopped with a message"


@fault(
    "the packing that a run starts from is cut, emptied, gone or has a bit flipped",
    "refuses and names it; with the packing back it runs",
    in_quick=False,
)
def packing_damaged(bench: Bench) -> list[Any]:
    from developers.fault_kinds.damage import cut, delete, empty, flip_bit

    return [functools.partial(damage_packing, bench, damage) for damage in (cut, empty, delete, flip_bit)]


def damage_packing(bench: Bench, damage: Callable[..., Any]) -> str:
    filled = bench.pile(endTime=0.02)
    filled.edit(
        "constant/couplingProperties", '"DEM/in.particles";', '"DEM/in.particles";\n    writeRestart packing.restart;'
    )
    filled.must_run()
    case = bench.pile(endTime=0.02)
    script = case.folder / "DEM/in.particles"
    lines = [line for line in script.read_text().splitlines() if not line.startswith(("create_", "set "))]
    packing = filled.folder / "packing.restart"
    lines = [f"read_restart {packing}" if line.startswith("region") else line for line in lines]
    script.write_text("\n".join(lines) + "\n")
    content = packing.read_bytes()
    damage(packing)
    outcome = case.run()
    if outcome.status == 0 or not outcome.says("packing.restart"):
        raise Wrong(f"{damage.__name__}: status {outcome.status}, {outcome.last_words}")
    packing.write_bytes(content)
    case.must_run()
    return "refused; with the packing back it runs"
