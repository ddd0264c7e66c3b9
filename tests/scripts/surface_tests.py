"""meshes/hopperFromSurface: a surface of the user's own becomes the walls of particles and water, or is refused in
words."""

import struct
import subprocess
import tempfile
import unittest
from collections import Counter
from pathlib import Path
from typing import Any

from clepsydra import parameter_file
from clepsydra.meshes import hopper_walls

REPOSITORY = Path(__file__).resolve().parents[2]
MESHES = REPOSITORY / "meshes"


def corners(file: Path) -> list[Any]:
    points = [
        tuple(map(float, line.split()[1:])) for line in file.read_text().splitlines() if line.split()[0] == "vertex"
    ]
    return list(zip(points[::3], points[1::3], points[2::3]))


class Surface(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="clepsydra-surface-")
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name)
        (self.case / "system").mkdir()
        self.parameters = self.case / "parameters"
        self.parameters.write_text((REPOSITORY / "cases/tutorials/hopperQuick/parameters").read_text())
        self.file = self.case / "hopper.stl"
        self.file.write_text(self.cone())

    def cone(self, angle: Any = "30") -> Any:
        return subprocess.run(
            [MESHES / "coneSurface", self.parameters, angle], check=True, capture_output=True, text=True
        ).stdout

    def made(self) -> Any:
        return subprocess.run(
            [MESHES / "hopperFromSurface", self.parameters, self.case], capture_output=True, text=True
        )

    def expect_refused(self, words: Any) -> None:
        done = self.made()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(words, done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def write(self, triangles: Any) -> None:
        self.file.write_text(hopper_walls.stl("hopper", triangles))

    def test_particles_and_water_have_the_same_walls(self) -> None:
        """And those of the particles, plugged, are open at the rim only: an edge of one triangle elsewhere would be a
        leak."""
        self.assertEqual(self.made().returncode, 0)
        wall, plate, plug = (
            corners(self.case / f"DEM/meshes/{name}.stl") for name in ("hopperWall", "hopperPlate", "plug")
        )
        self.assertEqual(sorted(corners(self.case / "constant/triSurface/hopper.stl")), sorted(wall + plate))
        self.assertEqual(len(wall), 2 * hopper_walls.PARTICLE_CORNERS)
        edges = Counter(frozenset((triangle[i - 1], triangle[i])) for triangle in wall + plate + plug for i in range(3))
        height = parameter_file.parameters(self.parameters)["hopperHeight"]
        alone = [edge for edge, count in edges.items() if count != 2]
        self.assertEqual(len(alone), hopper_walls.PARTICLE_CORNERS)
        self.assertEqual({point[2] for edge in alone for point in edge}, {height})

    def test_binary_files_as_other_programs_write_them(self) -> None:
        """In single precision, with a header that begins like a text file's."""
        triangles = corners(self.file)
        self.made()
        from_text = corners(self.case / "DEM/meshes/hopperPlate.stl")
        self.file.write_bytes(
            b"solid".ljust(80)
            + struct.pack("<I", len(triangles))
            + b"".join(struct.pack("<12fH", 0, 0, 0, *sum(triangle, ()), 0) for triangle in triangles)
        )
        done = self.made()
        self.assertEqual(done.returncode, 0, done.stderr)
        from_binary = corners(self.case / "DEM/meshes/hopperPlate.stl")
        self.assertEqual(len(from_binary), len(from_text))
        for one, other in zip(sum(sum(from_binary, ()), ()), sum(sum(from_text, ()), ())):
            self.assertAlmostEqual(one, other, delta=1e-8)

    def test_what_is_refused(self) -> None:
        whole = corners(self.file)
        self.write(whole[:40] + whole[41:])
        self.expect_refused("hopper.stl has a hole at (")
        self.write([tuple(tuple(1e3 * part for part in point) for point in triangle) for triangle in whole])
        self.expect_refused("Are its lengths in metres?")
        a, b = whole[0][:2]
        self.write(whole + [(a, b, tuple((one + other) / 2 for one, other in zip(a, b)))])
        self.expect_refused("has a triangle of three points in line")
        self.write(whole + [(whole[100][0], whole[100][1], (0, 0, 0.03))])
        self.expect_refused("has an edge of 3 triangles")
        for angle in ("steep", "90"):
            refused = subprocess.run([MESHES / "coneSurface", self.parameters, angle], capture_output=True, text=True)
            self.assertEqual(refused.returncode, 1)
            self.assertIn(f"coneSurface: ANGLE is {angle}; allowed: ", refused.stderr)
        self.file.write_text("a hopper")
        self.expect_refused("is no STL file")
        self.file.unlink()
        self.expect_refused("hopper.stl: No such file")
        self.file.write_text(self.cone())
        self.parameters.write_text(
            parameter_file.with_parameters(self.parameters.read_text(), {"orificeDiameter": "8e-3"})
        )
        self.expect_refused("has an orifice of the area of a circle of 0.01 m; allowed: orificeDiameter 0.008 m")

    def test_an_exit_below_the_floor_is_refused(self) -> None:
        values = {"tankDepth": "0.03", "landHeight": "0.029", "bevelHeight": "1e-3", "mesher": "hopperBySnappy"}
        self.parameters.write_text(parameter_file.with_parameters(self.parameters.read_text(), values))
        done = subprocess.run([MESHES / "hopperBySnappy", self.parameters, self.case], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("landHeight + bevelHeight < tankDepth must hold", done.stderr)


if __name__ == "__main__":
    unittest.main()
