#!/usr/bin/python3
"""The tutorials as a user of OpenFOAM meets them: copied elsewhere, started by Allrun or by hand. Runs the programs.

usage: tutorialTests.py BUILD [unittest's options] """

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from clepsydra import case_files

REPOSITORY = Path(__file__).resolve().parents[2]
BUILD = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else REPOSITORY / "build"
TUTORIALS = REPOSITORY / "cases/tutorials"
# Of one folder each, by the programs that make their mesh; what they write; how long a run is here.
BY_HAND = {
    "settlingParticle": (["blockMesh"], "postProcessing/particleHeight/0/particleHeight.dat", "0.005"),
    "fluidisedBed": (["blockMesh"], "postProcessing/pressureDrop/0/surfaceFieldValue.dat", "0.005"),
    "gasFluidisedBed": (["blockMesh"], "postProcessing/pressureDrop/0/surfaceFieldValue.dat", "0.005"),
    "spoutedBed": (["blockMesh"], "postProcessing/pressureDrop/0/surfaceFieldValue.dat", "0.005"),
    "wetDrum": (["blockMesh"], "DEM/drum.dump", "0.02"),
    "periodicSettling": (["blockMesh"], "postProcessing/waterVelocity/0/volFieldValue.dat", "0.005"),
    "heatedBed": (["blockMesh"], "postProcessing/outletTemperature/0/surfaceFieldValue.dat", "0.01"),
    "hopperSubmerged": (["blockMesh"], "postProcessing/massInHopper/0/massInHopper.dat", "0.01"),
    "hopperFromSTL": (
        ["surfaceFeatureExtract", "blockMesh", "snappyHexMesh -overwrite"],
        "postProcessing/massInHopper/0/massInHopper.dat",
        "0.01",
    ),
}
MOST_LINES = 25  # of an Allrun


class Tutorials(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="clepsydra-tutorials-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def copied(self, name: str) -> Path:
        """As git has it: without what a run has left in the repository."""
        listed = ["git", "-C", str(TUTORIALS / name), "ls-files", "--cached", "--others", "--exclude-standard"]
        for file in subprocess.run(listed, check=True, capture_output=True, text=True).stdout.split():
            (self.folder / name / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(TUTORIALS / name / file, self.folder / name / file)
        return self.folder / name

    def shortened(self, name: str) -> Path:
        case, end = self.copied(name), BY_HAND[name][2]
        text = (case / "parameters").read_text()
        text, count = re.subn(r"(?m)^endTime +[^;]+;", f"endTime {end};", text)
        self.assertEqual(count, 1)
        (case / "parameters").write_text(re.sub(r"(?m)^writeInterval +[^;]+;", f"writeInterval {end};", text))
        return case

    def typed(self, case: Path, commands: str, sourced: bool = True) -> str:
        first = f". {REPOSITORY}/scripts/environment; " if sourced else ""
        environment = {key: value for key, value in os.environ.items() if key not in ("CLEPSYDRA", "CLEPSYDRA_BUILD")}
        outcome = subprocess.run(
            ["bash", "-c", f"export CLEPSYDRA_BUILD={BUILD}; {first}set -e; {commands}"],
            cwd=case,
            env=environment,
            text=True,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        self.status = outcome.returncode
        return outcome.stdout

    def test_every_tutorial_is_known_here(self) -> None:
        found = {path.parent.name for path in TUTORIALS.glob("*/Allrun")}
        self.assertEqual(found, {*BY_HAND, "hopperQuick"})

    def test_by_hand_in_a_copy(self) -> None:
        """blockMesh (and what else a mesh needs), then pimpleDemFoam: to the end, with a table of the observable."""
        for name, (mesh, table, end) in BY_HAND.items():
            with self.subTest(name):
                case = self.shortened(name)
                said = self.typed(case, "; ".join([*mesh, "pimpleDemFoam"]))
                self.assertEqual(self.status, 0, said[-2000:])
                self.assertAlmostEqual(case_files.balances(case)[-1]["timeEnd"], float(end))
                last = (case / table).read_text().splitlines()[-1].split()
                self.assertTrue(table.endswith(".dump") or float(last[0]) == float(end), last)

    def test_allrun_in_a_copy_and_again(self) -> None:
        """The same by Allrun. Called again it does nothing again, or begins again; Allclean leaves what was copied. The
        hopper is dry: without water there are no fields of later times."""
        for name in ("settlingParticle", "hopperSubmerged"):
            with self.subTest(name):
                case = self.shortened(name)
                if name == "hopperSubmerged":
                    text, count = re.subn(r"(?m)^fluid +[^;]+;", "fluid none;", (case / "parameters").read_text())
                    self.assertEqual(count, 1)
                    (case / "parameters").write_text(text)
                before = sorted(case.rglob("*"))
                for _ in range(2):
                    said = self.typed(case, "./Allrun")
                    self.assertEqual(self.status, 0, said[-2000:])
                self.assertTrue((case / BY_HAND[name][1]).exists())
                self.assertEqual((case / BY_HAND[name][2] / "U").exists(), name != "hopperSubmerged")
                self.typed(case, "./Allclean")
                self.assertEqual(sorted(case.rglob("*")), before)

    def test_check_and_mistakes(self) -> None:
        """`check` makes nothing; a mistake is reported before anything is made, a program that fails with the end of
        its log; without Clepsydra's environment a copy says what to do."""
        for name in BY_HAND:
            with self.subTest(name):
                case = self.copied(name)
                before = sorted(case.rglob("*"))
                said = self.typed(case, "./Allrun check")
                self.assertEqual(self.status, 0, said)
                self.assertIn("; " if name != "settlingParticle" else "vessel: ", said)
                text = (case / "parameters").read_text()
                (case / "parameters").write_text(re.sub(r"(?m)^demStep +[^;]+;", "demStep 1;", text))
                self.assertIn("demStep' is 1; allowed: ", self.typed(case, "./Allrun"))
                self.assertNotEqual(self.status, 0)
                (case / "parameters").write_text(text)
                said = self.typed(case, "./Allrun", sourced=False)
                self.assertIn("source its scripts/environment first", said)
                self.assertEqual(sorted(case.rglob("*")), before)
                if name == "fluidisedBed":
                    (case / "system/blockMeshDict").write_text(
                        "FoamFile { version 2.0; format ascii; class dictionary; }\n"
                    )
                    said = self.typed(case, "./Allrun")
                    self.assertNotEqual(self.status, 0)
                    self.assertIn("FOAM FATAL", said)
                    self.assertIn("failed: see ", said)

    def test_absent_programs_are_named(self) -> None:
        """A machine on which nothing is built yet: every Allrun says what to run, and installs nothing."""
        for name in (*BY_HAND, "hopperQuick"):
            with self.subTest(name):
                said = self.typed(
                    self.copied(name), f"export CLEPSYDRA_BUILD={self.folder}; PATH=/usr/bin:/bin; ./Allrun"
                )
                self.assertNotEqual(self.status, 0)
                self.assertRegex(said, "there is no program 'pimpleDemFoam' here: run .*/scripts/setup")

    def test_allruns_are_short_and_call_no_package_manager(self) -> None:
        for allrun in (REPOSITORY / "cases").rglob("Allrun"):
            with self.subTest(str(allrun)):
                text = allrun.read_text()
                self.assertIsNone(re.search(r"\bapt|^\s*\S*scripts/setup", text, re.MULTILINE))
                if TUTORIALS in allrun.parents:
                    self.assertLessEqual(len(text.splitlines()), MOST_LINES)


if __name__ == "__main__":
    unittest.main()
