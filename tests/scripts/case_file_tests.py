"""clepsydra.case_files: fields as OpenFOAM writes them. clepsydra.dpm_foam: what DPMFoam reads, and what it and
pimpleDemFoam left."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from clepsydra import case_files, dpm_foam


class Fields(unittest.TestCase):
    def read(self, internal_field: str) -> list[list[float]]:
        with tempfile.TemporaryDirectory(prefix="clepsydra-fields-") as folder:
            (Path(folder) / "1").mkdir()
            (Path(folder) / "1/T").write_text(
                f"dimensions [0 0 0 1 0 0 0];\n\ninternalField {internal_field};\n\nboundaryField\n{{\n}}\n"
            )
            found: list[list[float]] = case_files.field(folder, "1", "T").tolist()
            return found

    def test_lists_in_one_line_and_in_several(self) -> None:
        """OpenFOAM writes up to ten scalars in one line: one row for each, not one row with all of them."""
        self.assertEqual(self.read("nonuniform List<scalar> 3(1 2 -3e-4)"), [[1], [2], [-3e-4]])
        self.assertEqual(self.read("nonuniform List<scalar> \n3\n(\n1\n2\n3\n)\n"), [[1], [2], [3]])
        self.assertEqual(self.read("nonuniform List<vector> \n2\n(\n(1 2 3)\n(4 5 6)\n)\n"), [[1, 2, 3], [4, 5, 6]])
        self.assertEqual(self.read("nonuniform List<vector> 1((1 2 3))"), [[1, 2, 3]])

    def test_uniform(self) -> None:
        self.assertEqual(self.read("uniform 5"), [[5]])
        self.assertEqual(self.read("uniform (1 2 3)"), [[1, 2, 3]])

    def test_binary_is_refused(self) -> None:
        with self.assertRaisesRegex(SystemExit, "no internalField in ascii"):
            self.read("nonuniform List<scalar> 3(\x01\x02")


class BesideDpmFoam(unittest.TestCase):
    PARAMETERS = "width 2;\ndepth 0.5;\nheight 4;\ncellsUp 2;\nparticleCount 10;\nfluidDensity 1;\n"
    OUR_LOG = """
Time = 0.5
Time = 0.75
Time = 1

Wall time by phase, and processor time (this rank)
             DEM 9 s     90 % 3 s
          output 1 s     10 % 0.5 s

End
"""
    THEIR_LOG = """
Time = 0.1
    Current number of parcels       = 10
ExecutionTime = 20 s  ClockTime = 90 s
Time = 0.2
    Current number of parcels       = 7
ExecutionTime = 40.5 s  ClockTime = 99 s
"""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="clepsydra-dpmFoam-")
        self.addCleanup(folder.cleanup)
        self.run_folder = Path(folder.name)
        (self.run_folder / "DPMFoam/postProcessing/bottomPressure/0").mkdir(parents=True)
        (self.run_folder / "parameters").write_text(self.PARAMETERS)
        (self.run_folder / "log.pimpleDemFoam").write_text(self.OUR_LOG)
        (self.run_folder / "DPMFoam/log.DPMFoam").write_text(self.THEIR_LOG)

    def test_times_and_lost_particles_are_those_of_the_logs(self) -> None:
        """The first step of a part begins one time step before it; DPMFoam's last number of particles counts."""
        ours, theirs = dpm_foam.Ours(self.run_folder), dpm_foam.Theirs(self.run_folder)
        self.assertEqual([ours.processor_seconds(), ours.simulated_seconds()], [3.5, 0.75])
        self.assertEqual(theirs.processor_seconds(), 40.5)
        self.assertAlmostEqual(theirs.simulated_seconds(), 0.2)
        self.assertEqual(theirs.lost_particles(), 3)

    def test_pressure_of_dpm_foam_has_its_hydrostatic_part_taken_off(self) -> None:
        """Two kinematic pressures at the bottom of a column 4 m high: that of fluid at rest, and 5 m2/s2 more."""
        (self.run_folder / "DPMFoam/postProcessing/bottomPressure/0/surfaceFieldValue.dat").write_text(
            f"# Time areaAverage(p)\n0.1 {4 * 9.81}\n0.2 {4 * 9.81 + 5}\n"
        )
        _, drop = dpm_foam.Theirs(self.run_folder).pressure_drop()
        self.assertAlmostEqual(drop[0], 0)
        self.assertAlmostEqual(drop[1], 5)

    def test_centre_of_mass_of_layers(self) -> None:
        """Solid fractions 0.4 and 0.2 in the layers about 1 and 3 m."""
        ours = dpm_foam.Ours(self.run_folder)
        self.assertAlmostEqual(ours.centre_of_mass(np.array([0.6, 0.6, 0.8, 0.8])), (2 * 1 + 1 * 3) / 3)
        self.assertEqual(ours.column.area, 1)

    def test_places_are_those_of_the_first_entry(self) -> None:
        """Of two entries of a dump; DPMFoam gets no other columns."""
        head = (
            "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z vx\n"
        )
        dump, places = self.run_folder / "places.dump", self.run_folder / "places"
        dump.write_text(
            head.format(100) + "1 0.1 0.2 0.3 7\n2 0.4 0.5 0.6 7\n" + head.format(200) + "1 9 9 9 7\n2 9 9 9 7\n"
        )
        dpm_foam.write_places(str(dump), places)
        self.assertIn("class vectorField;", places.read_text())
        self.assertTrue(places.read_text().endswith("\n(\n(0.1 0.2 0.3)\n(0.4 0.5 0.6)\n)\n"))


if __name__ == "__main__":
    unittest.main()
