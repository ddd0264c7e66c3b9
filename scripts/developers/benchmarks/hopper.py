"""cases/tutorials/hopperQuick in a folder of its own, filled once; every comparison starts from this packing."""

import functools
import json
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from clepsydra import parameter_file
from clepsydra.environment import REPOSITORY

from . import timing

# The hopper of the measurements: 13,900 particles of 2 mm in 5 cm.
FULL_SIZE = {
    "particleCount": "13900",
    "hopperDiameter": "0.05",
    "hopperHeight": "0.095",
    "orificeDiameter": "0.02",
    "tankDiameter": "0.12",
    "tankDepth": "0.06",
    "fillingTime": "1.4",
}


class Hopper:
    def __init__(self, folder: Path, quick: bool, repository: Any = REPOSITORY, **parameters: Any) -> None:
        self.folder = folder
        self.case = folder / "cases" / "tutorials" / "hopperQuick"
        self.quick = quick
        shutil.copytree(case_of(repository), self.case, ignore=shutil.ignore_patterns("steps", "results", "polyMesh"))
        for name in ("meshes", "scripts"):
            (folder / name).symlink_to(repository / name)
        self.set_parameters(self.case / "parameters", parameters if quick else {**FULL_SIZE, **parameters})
        self.parameters = parameter_file.parameters(self.case / "parameters")
        self._filled = False

    @functools.cache
    def quick_one(self) -> Any:
        """The hopper of 3000 particles: this one, or another."""
        return self if self.quick else Hopper(self.folder / "quickOne", quick=True)

    @functools.cache
    def with_cells(self, cell_size: Any) -> Any:
        """The same packing in another mesh."""
        other = Hopper(self.folder / f"cells{cell_size}", self.quick, cellSize=cell_size)
        other.allrun("mesh")
        shutil.copy(self.packing, other.case / "steps" / "filling")
        other._filled = True
        return other

    def validation_case(self, name: str) -> Any:
        """A copy of that case that may be run in, with the folders that it refers to."""
        cases = self.folder / "cases" / "validation"
        for part in (name, "common"):
            shutil.copytree(
                REPOSITORY / "cases" / "validation" / part,
                cases / part,
                dirs_exist_ok=True,
                ignore=shutil.ignore_patterns("runs", "results"),
            )
        return cases / name

    def run(self, template: Any, name: str, duration: Any, ranks: int = 1, **entries: Any) -> Any:
        """A timing.Run of such a step, its result what the conservation check says."""
        folder = self.step(template, name, duration, ranks, **entries)
        return timing.Run(
            solver(ranks), folder, prepare=lambda: forget_results(folder), result=lambda: conservation(folder)
        )

    def step(self, template: Any, name: str, duration: Any, ranks: int = 1, **entries: Any) -> Any:
        """A step like `dry` or `submerged`, from the packing, that ends after `duration` [s]; its folder."""
        self._pour()
        folder = self.case / "steps" / name
        shutil.rmtree(folder, ignore_errors=True)
        self.allrun("-prepare", template, ranks=ranks)
        shutil.copytree(self.case / "steps" / template, folder, symlinks=True)
        entries = {"stepEndTime": duration, **entries}
        with open(folder / "step", "a") as step:
            step.writelines(f"{entry} {value};\n" for entry, value in entries.items())
        if ranks > 1:
            self.in_folder(folder, "decomposePar > log.decomposePar 2>&1")
        return folder

    @property
    def packing(self) -> Path:
        self._pour()
        return self.case / "steps" / "filling" / "packing.restart"

    def allrun(self, *arguments: Any, ranks: int = 1) -> None:
        self.in_folder(self.case, shlex.join(["./Allrun", "-np", str(ranks), *arguments]))

    @staticmethod
    def in_folder(folder: Path, commands: Any) -> Any:
        done = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", commands],
            cwd=folder,
            capture_output=True,
            text=True,
            preexec_fn=timing.priority(),
        )
        if done.returncode != 0:
            sys.exit(f"{done.stdout[-2000:]}{done.stderr[-2000:]}\nbenchmark: failed in {folder}: {commands}")
        return done.stdout

    def _pour(self) -> None:
        if not self._filled:
            self.allrun("mesh", "filling")
            self._filled = True

    @staticmethod
    def set_parameters(file: Path, values: Any) -> None:
        file.write_text(
            parameter_file.with_parameters(file.read_text(), {name: str(value) for name, value in values.items()})
        )


def case_of(repository: Any) -> Any:
    """The case, also of an earlier version."""
    case = repository / "cases/tutorials/hopperQuick"
    return case if case.exists() else repository / "cases/hopperQuick"


def solver(ranks: int = 1) -> Any:
    command = ["pimpleDemFoam"]
    return command if ranks == 1 else ["mpirun", "-np", str(ranks), *command, "-parallel"]


def conservation(folder: Path) -> Any:
    """What the run in this folder wrote at its end: particles, errors, seconds of each phase, bytes exchanged."""
    return json.loads((folder / "postProcessing" / "conservation" / "0" / "summary.json").read_text())


def forget_results(folder: Path) -> None:
    """Lets a step begin again: it would go on from its last checkpoint."""
    for pattern in ("checkpoints", "postProcessing", "VTK", "[0-9]*", "processor*/[0-9]*"):
        for path in folder.glob(pattern):
            if path.name != "0":
                shutil.rmtree(path)
