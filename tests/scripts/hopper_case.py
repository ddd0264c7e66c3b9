"""cases/tutorials/hopperQuick in a copy of the repository's layout, with surrogates for solver, mesh programs and
pictures."""

import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path
from typing import Any

from clepsydra import parameter_file

REPOSITORY = Path(__file__).resolve().parents[2]
SURROGATE = Path(__file__).resolve().parent / "surrogate"
MESH_PROGRAMS = ("blockMesh", "topoSet", "createBaffles", "checkMesh")


class HopperCase(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="clepsydra-scripts-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.lay_out(self.folder)

    def lay_out(self, root: Any) -> None:
        self.case = root / "cases" / "tutorials" / "hopperQuick"
        shutil.copytree(
            REPOSITORY / "cases" / "tutorials" / "hopperQuick",
            self.case,
            ignore=shutil.ignore_patterns("steps", "results", "polyMesh", "*.png"),
        )
        (root / "meshes").symlink_to(REPOSITORY / "meshes")
        (root / "scripts").mkdir()
        for path in (REPOSITORY / "scripts").iterdir():
            (root / "scripts" / path.name).symlink_to(path)
        for name in ("plotFlow", "renderFlow"):
            self.program(root / "scripts" / name, "#!/bin/sh\n")
        # No Allrun may install or build anything.
        self.program(root / "scripts" / "setup", f"#!/bin/sh\ntouch {root}/setupWasCalled\nexit 1\n")
        self.program(self.case / "summarise", "#!/bin/sh\nmkdir -p results; touch results/summary.json\n")
        for name in MESH_PROGRAMS:
            self.program(root / "bin" / name, (SURROGATE / "meshTool").read_text())
        self.program(root / "bin" / "pimpleDemFoam", (SURROGATE / "pimpleDemFoam").read_text())
        self.program(root / "bin" / "xvfb-run", "#!/bin/sh\n")
        version = (REPOSITORY / "scripts" / "openfoamVersion").read_text().strip()
        etc = root / "dependencies" / f"openfoam-{version}" / "etc"
        etc.mkdir(parents=True)
        (etc / "controlDict").touch()
        # only what a machine has, and the surrogates
        self.environment = {
            "PATH": "/usr/bin:/bin",
            "CLEPSYDRA_BUILD": str(root),
            "CLEPSYDRA_DEPENDENCIES": str(etc.parents[1]),
        }

    @staticmethod
    def program(path: Path, text: str) -> None:
        path.parent.mkdir(exist_ok=True)
        path.unlink(missing_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def allrun(self, *arguments: Any) -> Any:
        return subprocess.run(
            [self.case / "Allrun", *arguments],
            env=self.environment,
            capture_output=True,
            text=True,
            stdin=subprocess.DEVNULL,
            timeout=60,
        )

    def succeeds(self, *arguments: Any) -> Any:
        outcome = self.allrun(*arguments)
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        return outcome.stdout

    def refuses(self, *arguments: Any) -> Any:
        """What it says; it must end with a failure, without a traceback."""
        outcome = self.allrun(*arguments)
        said = outcome.stdout + outcome.stderr
        self.assertGreater(outcome.returncode, 0, said)
        self.assertNotIn("Traceback", said)
        return said

    def interrupted(self, *arguments: Any, by: Any, steps: Any) -> tuple[Any, Any]:
        """Its exit status and words, after a signal, in the midst of steps, to all that a terminal would send it to."""
        (self.case / "hold").touch()
        process = subprocess.Popen(
            [self.case / "Allrun", *arguments],
            env=self.environment,
            text=True,
            start_new_session=True,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        end = time.time() + 60
        for step in steps:
            table = self.table(step)
            while not (table.exists() and table.read_text().count("\n") >= 10):
                self.assertLess(time.time(), end, f"step {step} did not come to its midst")
                time.sleep(0.05)
        os.killpg(process.pid, by) if by == signal.SIGINT else process.send_signal(by)
        said, _ = process.communicate(timeout=30)
        (self.case / "hold").unlink()
        return process.returncode, said

    def set(self, **values: Any) -> None:
        parameter_file.change(self.case / "parameters", {name: str(value) for name, value in values.items()})

    def starts(self) -> list[str]:
        return (self.case / "starts").read_text().split()

    def rows(self, step: Any) -> int:
        return len(self.table(step).read_text().splitlines())

    def table(self, step: Any) -> Path:
        return self.case / "steps" / step / "postProcessing/massInHopper/0/massInHopper.dat"
