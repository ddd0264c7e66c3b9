#!/usr/bin/python3
"""What is made of a run to look at: film, animation, report.

usage: picture_tests.py BUILD [unittest's options] """

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

import matplotlib.image
import numpy as np

REPOSITORY = Path(__file__).resolve().parents[2]
BUILD = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else REPOSITORY / "build"
SCRIPTS = REPOSITORY / "scripts"

TIMES = 5  # written while the water flows: .5 s, one each .1 s


def setUpModule() -> None:
    """One run of the hopper, dry and under water, for all that is made of it."""
    folder = tempfile.TemporaryDirectory(prefix="clepsydra-pictures-")
    unittest.addModuleCleanup(folder.cleanup)
    Pictures.folder = Path(folder.name)
    case = Pictures.folder / "cases/tutorials/hopperQuick"
    shutil.copytree(
        REPOSITORY / "cases/tutorials/hopperQuick", case, ignore=shutil.ignore_patterns("steps", "results", "polyMesh")
    )
    for name in ("scripts", "meshes", "tests"):
        (Pictures.folder / name).symlink_to(REPOSITORY / name)
    subprocess.run(
        ["bash", "-ec", ". tests/pages/smallHopper; cases/tutorials/hopperQuick/Allrun mesh filling dry submerged"],
        cwd=Pictures.folder,
        check=True,
        stdout=subprocess.DEVNULL,
        env={**os.environ, "CLEPSYDRA_BUILD": str(BUILD)},
    )
    Pictures.dry, Pictures.submerged = (case / "steps" / step for step in ("dry", "submerged"))


class Pictures(unittest.TestCase):
    folder: Path
    dry: Path
    submerged: Path

    def runs(self, script: Any, *arguments: Any, **options: Any) -> Any:
        return subprocess.run(
            [SCRIPTS / script, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, **options
        )

    def makes(self, script: Any, *arguments: Any) -> Any:
        done = self.runs(script, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def copied(self, name: str) -> Any:
        """A run whose files a test may change."""
        case = self.folder / name
        shutil.copytree(self.submerged, case, symlinks=True)
        for link in ("constant", "system", "DEM"):
            (case / link).unlink()
            (case / link).symlink_to((self.submerged / link).resolve())
        return case

    def pictures(self, film: Any) -> int:
        """How many a film or an animation has, by decoding it."""
        counted = subprocess.run(
            [
                "ffprobe",
                "-v",
                "error",
                "-count_frames",
                "-show_entries",
                "stream=nb_read_frames",
                "-of",
                "csv=p=0",
                film,
            ],
            check=True,
            capture_output=True,
            text=True,
        )
        return int(counted.stdout.strip().strip(","))


class Film(Pictures):
    def test_one_picture_for_each_time(self) -> None:
        said = self.makes("movie", self.submerged, "film.mp4", "film.webm", "film.gif", "film.apng", "film.webp")
        self.assertIn(f"film.mp4: {TIMES} pictures", said)
        for file in ("film.mp4", "film.webm", "film.gif", "film.apng"):
            self.assertEqual(self.pictures(self.folder / file), TIMES, file)
        # Debian's ffmpeg writes animated WebP, but does not read it: one chunk for each picture
        webp = (self.folder / "film.webp").read_bytes()
        self.assertEqual((webp[8:12], webp.count(b"ANMF")), (b"WEBP", TIMES))

    def test_particles_at_rest_are_not_black(self) -> None:
        """The end of the dry run: 47 particles lie in the hopper and nothing else is drawn there."""
        self.makes("movie", "--view", -5.5, 5.5, 0.3, 3, self.dry, "dry.apng")
        subprocess.run(
            ["ffmpeg", "-loglevel", "error", "-y", "-i", "dry.apng", "-update", "1", "last.png"],
            check=True,
            cwd=self.folder,
        )
        picture = matplotlib.image.imread(self.folder / "last.png")[:, :, :3]
        left = picture[:, : picture.shape[1] // 2]  # without the curve of the mass
        dark = (left.max(axis=2) < 0.35).mean()
        pale = ((left[:, :, 0] > 0.9) & (left[:, :, 2] > 0.5) & (left[:, :, 2] < 0.9)).mean()
        self.assertLess(dark, 0.06)
        self.assertGreater(pale, 0.02)

    def test_of_a_running_case(self) -> None:
        """The newest time may be half written until its checkpoint is complete."""
        running = self.copied("running")
        (running / "checkpoints/0.5/complete").unlink()
        (running / "0.5/U").write_text("FoamFile { half")
        self.assertIn(f"film.gif: {TIMES - 1} pictures", self.makes("movie", running, "film.gif"))

    def test_every_other(self) -> None:
        self.assertIn("film.gif: 3 pictures", self.makes("movie", "--every", 2, self.submerged, "film.gif"))

    def test_a_part_of_the_run(self) -> None:
        self.assertIn("film.gif: 2 pictures", self.makes("movie", "--between", 0.15, 0.35, self.submerged, "film.gif"))

    def test_says_what_it_cannot_do(self) -> None:
        for arguments, complaint in (
            ((self.submerged, "film.avi"), "allowed: .mp4"),
            ((self.folder, "film.mp4"), "has no VTK/particles.pvd"),
            (("--view", 3, 1, 0, 1, self.submerged, "film.mp4"), "--view is X0 < X1"),
            (("--between", 0.2, 0.1, self.submerged, "film.mp4"), "--between is T0 < T1"),
        ):
            done = self.runs("movie", *arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn(complaint, done.stderr)

    def test_without_ffmpeg(self) -> None:
        done = self.runs("movie", self.submerged, "none.mp4", env={"PATH": "/nowhere"})
        self.assertIn("apt-get install ffmpeg", done.stderr)
        self.assertFalse((self.folder / "none.mp4").exists())


class OnTwoRanks(Pictures):
    def test_draws_particles_and_water(self) -> None:
        """The dry run has no field of the water, and that of the other one is in parts, one for each rank."""
        case = self.folder / "cases/tutorials/hopperOnTwoRanks"
        shutil.copytree(self.submerged.parents[1], case, ignore=shutil.ignore_patterns("steps", "results"))
        subprocess.run(
            [case / "Allrun", "-np", "2"],
            check=True,
            stdout=subprocess.DEVNULL,
            env={**os.environ, "CLEPSYDRA_BUILD": str(BUILD)},
        )
        self.assertTrue((case / "results/particles.png").is_file())
        submerged = case / "steps/submerged"
        whole = [time for time in submerged.glob("0.[1-9]*") if (time / "U").is_file()]
        self.assertGreater(len(whole), 1)
        for time in whole:
            shutil.rmtree(time)
        self.assertIn("reconstructPar", self.runs("movie", submerged, "film.gif").stderr)


class Report(Pictures):
    def page(self, case: Any) -> str:
        self.makes("runReport", case, "report.html")
        return (self.folder / "report.html").read_text()

    def test_says_what_the_run_wrote(self) -> None:
        page = self.page(self.submerged)
        balances = json.loads((self.submerged / "postProcessing/conservation/0/summary.json").read_text())
        self.assertIn("<h1>submerged: ended at t = 0.5 s</h1>", page)
        self.assertIn("100 particles at the start, 100 at the end, none lost", page)
        self.assertIn(f"{balances['momentumError']:.2e}", page)
        # A heap of 100 particles is low for the smoothing bandwidth.
        self.assertIn("1 warnings", page)
        self.assertIn("is within a smoothing bandwidth of clear fluid", page)
        phases = dict(re.findall(r"<tr><td>(\w+)</td><td class=number>([.\d]+) s</td>", page))
        self.assertEqual(phases, {name: f"{seconds:.1f}" for name, seconds in balances["phaseSeconds"].items()})
        for said in (
            "Clepsydra 1.0.0, commit",
            "LIGGGHTS-PUBLIC 3.8.0",
            "DiFeliceDrag: fluid density",
            "Rayleigh time",
            "couplingTimeStep        2e-3;",
        ):
            self.assertIn(said, page)
        self.assertEqual(page.count("<svg"), 1)

    def test_needs_nothing_beside_it(self) -> None:
        page = self.page(self.submerged)
        self.assertNotRegex(re.sub(r"<svg.*?</svg>", "", page, flags=re.S), r"<(link|script|img|iframe)|url\(")
        self.assertEqual(set(re.findall(r'(?:xlink:href|href|src)="([^#"][^"]*)"', page)), set())

    def test_says_what_was_not_read_and_what_failed(self) -> None:
        case = self.copied("warned")
        path = case / "log.pimpleDemFoam"
        path.write_text(re.sub(r"--> FOAM Warning.*?(?=\nTime = )", "", path.read_text(), flags=re.S))
        self.assertIn("No warnings.", self.page(case))
        with open(path, "a") as log:
            log.write("--> FOAM Warning : Unless a function object does, is unknown the field pp\n\n" * 2)
        page = self.page(case)
        self.assertIn("1 warnings", page)
        self.assertIn("is unknown the field pp\n(2 times)", page)
        with open(case / "log.pimpleDemFoam", "a") as log:
            log.write("--> FOAM FATAL ERROR:\nlost <particles> & more\n\n    From somewhere\n\nFOAM exiting\n")
        page = self.page(case)
        self.assertIn("ended by an error at t = 0.5 s", page)
        self.assertIn("lost &lt;particles&gt; &amp; more", page)

    def test_of_a_run_that_has_not_ended(self) -> None:
        case = self.copied("unfinished")
        log = case / "log.pimpleDemFoam"
        log.write_text(log.read_text().split("\nTime = 0.31")[0])
        shutil.rmtree(case / "postProcessing/conservation")
        page = self.page(case)
        self.assertIn("has not ended: at t = 0.308 s", page)
        self.assertIn("No conservation check", page)

    def test_counts_over_all_parts_of_a_run(self) -> None:
        case = self.copied("resumed")
        balances = json.loads((case / "postProcessing/conservation/0/summary.json").read_text())
        (case / "postProcessing/conservation/0.3").mkdir()
        (case / "postProcessing/conservation/0.3/summary.json").write_text(
            json.dumps(balances | {"particlesLost": 3, "momentumError": 2.5e-3, "particlesEnd": 97})
        )
        page = self.page(case)
        for said in ("97 at the end", "3 lost", "2.50e-03"):
            self.assertIn(said, page)

    def test_says_of_which_time_there_are_no_balances(self) -> None:
        """Killed after .3 s, it went on from the checkpoint at .25 s; before that, a stop at .2 s wrote balances."""
        self.assertNotIn("are missing", self.page(self.submerged))
        case = self.copied("killed")
        conservation = case / "postProcessing/conservation"
        balances = json.loads((conservation / "0/summary.json").read_text())
        (conservation / "0/summary.json").write_text(json.dumps(balances | {"timeEnd": 0.2}))
        (conservation / "0.25").mkdir()
        (conservation / "0.25/summary.json").write_text(json.dumps(balances | {"timeStart": 0.25}))
        self.assertIn("The balances of 0.2 to 0.25 s are missing", self.page(case))

    def test_without_a_run(self) -> None:
        done = self.runs("runReport", self.folder, "report.html")
        self.assertEqual(done.returncode, 2)
        self.assertIn("has no log.pimpleDemFoam", done.stderr)


class Studies(Pictures):
    def test_what_no_fit_has_seen(self) -> None:
        """Measured in black, the model before and after in red and blue; a study that held nothing out has no
        picture."""
        self.makes("studies", "--picture", "studies.png", "particlesInTwoLiquids")
        red, green, blue = np.moveaxis(matplotlib.image.imread(self.folder / "studies.png")[:, :, :3], 2, 0)
        for drawn in (red > blue + 0.4, blue > red + 0.4, red + green + blue < 0.1):
            self.assertGreater(drawn.sum(), 20)
        refused = self.runs("studies", "--picture", "none.png", "sphereInBoxCurves")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("nothing to draw", refused.stderr)


@unittest.skipUnless(
    shutil.which("pvpython"),
    "there is no pvpython here (Debian's python3-paraview cannot be installed beside python3-vtk9, which we need)",
)
class ParaView(Pictures):
    def test_state_with_particles_and_water(self) -> None:
        display = [] if "DISPLAY" in os.environ else ["xvfb-run", "--auto-servernum"]
        subprocess.run(
            [*display, "pvpython", SCRIPTS / "paraviewState", self.submerged, "state.png"],
            check=True,
            cwd=self.folder,
            capture_output=True,
        )
        state = (self.submerged / "run.pvsm").read_text()
        for part in ("particles.pvd", "run.foam", "SphereSource", "velocity"):
            self.assertIn(part, state)
        picture = matplotlib.image.imread(self.folder / "state.png")[:, :, :3]
        left = picture[:, : int(0.75 * picture.shape[1])]  # without the colour bars
        particles = (left[:, :, 0] > 0.5) & (left[:, :, 2] < 0.75 * left[:, :, 0])
        water = left[:, :, 2] > 1.1 * left[:, :, 0]
        self.assertGreater(particles.mean(), 0.002)
        self.assertGreater(water.mean(), 0.01)


if __name__ == "__main__":
    unittest.main()
