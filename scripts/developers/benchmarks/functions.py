"""Where the processor time of a run is, by function: perf samples programs that are built as users have them."""

import re
import shutil
import subprocess
from collections import defaultdict
from pathlib import Path

from clepsydra.environment import REPOSITORY
from developers.benchmarks.hopper import Hopper, forget_results, solver

from . import timing

# What a function does, by its name; the first that fits counts.
PARTS = {
    "contacts of particles": "HertzPairStyle|evaluateHertz",
    "contacts with walls": "MeshWalls|LAMMPS_NS::.*Mesh|FixWallGran|ContactModels|Walls::|PrimitiveWall",
    "search for neighbours": "NeighbourLists|markNear|S::Neighbor|FixContactHistory::|S::Comm|S::Atom",
    "motion": "FixNVE|FixGravity|LAMMPS_NS::",
    "smoothing": r"sweep<|CellDiffusion::apply",
    "cells and shares": "CellSlabs|HalfSpace|SphereInBox|Neighbourhood|Distribution|CellDiffusion",
    "forces": "Force|Drag|forces|_ZGV|__ieee754|FluidAtParticles|closures|clepsydra::",
    "linear solvers": "GaussSeidel|lduMatrix|GAMG|PCG|sumProd|smoothSolver|procLduInterface",
    "fields of the fluid": "Foam::",
    "messages": "MPI_|mca_|opal_|ompi_|uct_|ucp_|sched_yield|poll",
    "memory": "memset|memmove|memcpy|malloc|free|unlink_chunk|page",
}


def largest_function(hopper: Hopper, repetitions: int) -> timing.Figure:
    if not shutil.which("perf"):
        raise timing.Skipped("there is no perf: Debian's package linux-perf has it")
    runs = {
        "dry": hopper.run("dry", "dryProfile", 0.3),
        "dry, two ranks": hopper.run("dry", "dryProfile2", 0.3, 2),
        "submerged": hopper.run("submerged", "submergedProfile", 0.2),
        "submerged, two ranks": hopper.run("submerged", "submergedProfile2", 0.2, 2),
        "gas bed": gas_bed(hopper.folder, 0.3),
        "gas bed, two ranks": gas_bed(hopper.folder, 0.3, 2),
    }
    shares = {name: sampled(run) for name, run in runs.items()}
    return timing.Figure(
        [max(largest_of(shares["submerged"]).values())],
        meaning="% of the processor time of a submerged run in its largest function, by perf",
        details={name: {part: sum(of.values()) for part, of in parts.items()} for name, parts in shares.items()}
        | {f"{name}, functions": largest_of(parts) for name, parts in shares.items()},
    )


def gas_bed(parent: Path, duration: float, ranks: int = 1) -> timing.Run:
    """The flat bed of cases/tutorials/gasFluidisedBed until `duration` [s]; two ranks have half of its width each."""
    folder = parent / f"gasBed{ranks}"
    tutorial = REPOSITORY / "cases" / "tutorials" / "gasFluidisedBed"
    shutil.copytree(tutorial, folder, ignore=shutil.ignore_patterns("processor*"))
    forget_results(folder)
    Hopper.set_parameters(folder / "parameters", {"endTime": duration})
    Hopper.in_folder(folder, "blockMesh > log.blockMesh 2>&1")
    if ranks > 1:
        script = folder / "DEM" / "in.bed"
        script.write_text(f"processors {ranks} 1 1\n{script.read_text()}")
        (folder / "system" / "decomposeParDict").write_text(
            "FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }\n"
            f"numberOfSubdomains {ranks};\nmethod simple;\nsimpleCoeffs {{ n ({ranks} 1 1); }}\n"
        )
        Hopper.in_folder(folder, "decomposePar > log.decomposePar 2>&1")
    return timing.Run(solver(ranks), folder, prepare=lambda: forget_results(folder))


def sampled(run: timing.Run) -> dict[str, dict[str, float]]:
    """Percent of each function, by the part that it belongs to; the mean of the ranks."""
    folder = run.folder
    for old in folder.glob("perf.*.data"):
        old.unlink()
    record = 'perf record -q -e cpu-clock -F 999 -o "perf.${OMPI_COMM_WORLD_RANK:-0}.data" pimpleDemFoam "$@"'
    program = run.command.index("pimpleDemFoam")
    run.command[program : program + 1] = ["bash", "-c", record, "perf"]
    timing.timed(run)
    files = sorted(folder.glob("perf.*.data"))
    parts: dict[str, dict[str, float]] = {part: defaultdict(float) for part in [*PARTS, "other"]}
    for file in files:
        for name, percent in functions(file).items():
            part = next((part for part, names in PARTS.items() if re.search(names, name)), "other")
            parts[part][name] += percent / len(files)
    return parts


def functions(file: Path) -> dict[str, float]:
    report = subprocess.run(
        ["perf", "report", "-i", str(file), "--no-children", "--stdio", "-F", "overhead,symbol", "-t", ";"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    found: dict[str, float] = defaultdict(float)
    for line in report.splitlines():
        if match := re.match(r"\s*([\d.]+)%\s*;\s*\[.\]\s*(.*\S)", line):
            found[match[2]] += float(match[1])
    return found


def largest_of(parts: dict[str, dict[str, float]], count: int = 12) -> dict[str, float]:
    together = [item for of in parts.values() for item in of.items()]
    return dict(sorted(together, key=lambda item: -item[1])[:count])
