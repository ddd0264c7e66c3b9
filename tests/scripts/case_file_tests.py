"""clepsydra.case_files: fields as OpenFOAM writes them."""

import tempfile
import unittest
from pathlib import Path

from clepsydra import case_files


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


if __name__ == "__main__":
    unittest.main()
