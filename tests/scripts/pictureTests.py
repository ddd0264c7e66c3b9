#!/usr/bin/python3
"""What is made of a run to look at: film, animation.

usage: pictureTests.py BUILD [unittest's options]
"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
REPOSITORY = Path(__file__).resolve().parents[2]
BUILD = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else REPOSITORY / "build"
SCRIPTS = REPOSITORY / "scripts"
sys.path.insert(0, str(SCRIPTS))
import matplotlib.image
import numpy as np

TIMES = 5               # written while the water flows: .5 s, one each .1 s


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="clepsydra-pictures-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        case = cls.folder / "cases/hopperQuick"
        shutil.copytree(REPOSITORY / "cases/hopperQuick", case, ignore=shutil.ignore_patterns("stages", "results", "polyMesh"))
        for name in ("scripts", "meshes", "tests"):
            (cls.folder / name).symlink_to(REPOSITORY / name)
        subprocess.run(["bash", "-ec", ". tests/pages/smallHopper; cases/hopperQuick/Allrun mesh pour dry submerged"], cwd=cls.folder, check=True,
                       stdout=subprocess.DEVNULL, env={**os.environ, "CLEPSYDRA_BUILD": str(BUILD)})
        cls.dry, cls.submerged = (case / "stages" / stage for stage in ("dry", "submerged"))

    def runs(self, script, *arguments, **options):
        return subprocess.run([SCRIPTS / script, *map(str, arguments)], capture_output=True, text=True, cwd=self.folder, **options)

    def makes(self, script, *arguments):
        done = self.runs(script, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def pictures(self, film):
        """How many a film or an animation has, by decoding it."""
        counted = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames", "-of", "csv=p=0", film],
                                 check=True, capture_output=True, text=True)
        return int(counted.stdout.strip().strip(","))


class Film(Pictures):
    def testOnePictureForEachTime(self):
        said = self.makes("movie", self.submerged, "film.mp4", "film.webm", "film.gif", "film.apng", "film.webp")
        self.assertIn(f"film.mp4: {TIMES} pictures", said)
        for file in ("film.mp4", "film.webm", "film.gif", "film.apng"):
            self.assertEqual(self.pictures(self.folder / file), TIMES, file)
        # Debian's ffmpeg writes animated WebP, but does not read it: one chunk for each picture
        webp = (self.folder / "film.webp").read_bytes()
        self.assertEqual((webp[8:12], webp.count(b"ANMF")), (b"WEBP", TIMES))

    def testBeadsAtRestAreNotBlack(self):
        """The end of the dry run: 47 beads lie in the hopper and nothing else is drawn there."""
        self.makes("movie", "--view", -5.5, 5.5, 0.3, 3, self.dry, "dry.apng")
        subprocess.run(["ffmpeg", "-loglevel", "error", "-y", "-i", "dry.apng", "-update", "1", "last.png"], check=True, cwd=self.folder)
        picture = matplotlib.image.imread(self.folder / "last.png")[:, :, :3]
        left = picture[:, :picture.shape[1] // 2]           # without the curve of the mass
        dark = (left.max(axis=2) < 0.35).mean()
        pale = ((left[:, :, 0] > 0.9) & (left[:, :, 2] > 0.5) & (left[:, :, 2] < 0.9)).mean()
        self.assertLess(dark, 0.06)
        self.assertGreater(pale, 0.02)

    def testOfARunningCase(self):
        """The newest time may be half written until its checkpoint is complete."""
        running = self.folder / "running"
        shutil.copytree(self.submerged, running, symlinks=True)
        for link in ("constant", "system", "DEM"):
            (running / link).unlink()
            (running / link).symlink_to((self.submerged / link).resolve())
        (running / "checkpoints/0.5/complete").unlink()
        (running / "0.5/U").write_text("FoamFile { half")
        self.assertIn(f"film.gif: {TIMES - 1} pictures", self.makes("movie", running, "film.gif"))

    def testEveryOther(self):
        self.assertIn("film.gif: 3 pictures", self.makes("movie", "--every", 2, self.submerged, "film.gif"))

    def testSaysWhatItCannotDo(self):
        for arguments, complaint in (((self.submerged, "film.avi"), "allowed: .mp4"), ((self.folder, "film.mp4"), "has no VTK/beads.pvd"),
                                     (("--view", 3, 1, 0, 1, self.submerged, "film.mp4"), "--view is X0 < X1")):
            done = self.runs("movie", *arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn(complaint, done.stderr)

    def testWithoutFfmpeg(self):
        done = self.runs("movie", self.submerged, "none.mp4", env={"PATH": "/nowhere"})
        self.assertIn("apt-get install ffmpeg", done.stderr)
        self.assertFalse((self.folder / "none.mp4").exists())


if __name__ == "__main__":
    unittest.main()
