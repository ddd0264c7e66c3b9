"""Which folder of coupling/ and identification/ may include which: an arrow that goes back makes two folders one."""

import re
import unittest
from pathlib import Path
from typing import Any, Iterator

REPOSITORY = Path(__file__).resolve().parents[2]
COUPLING = REPOSITORY / "coupling"
IDENTIFICATION = REPOSITORY / "identification"

# From below to above; each may include those before it. Files that lie in no folder stand for themselves.
ORDER = [
    "tokens",
    "openfoam",
    "files",
    "closures",
    "vectorUnits.h",
    "phaseTimers.h",
    "engine",
    "vectors.h",
    "couplingState.h",
    "knownEntries.h",
    "modelLines.h",
    "runTimeSelection.h",
    "ranks.h",
    "rankTotals.h",
    "exchange",
    "distribution",
    "forces",
    "insertionAndRemoval",
    "conservation",
    "couplingStep",
    "checkpoint",
    "functionObjects",
    "output",
    "run",
]

ORDER_OF_IDENTIFICATION = [
    "lists.h",
    "curves",
    "features",
    "effects",
    "study",
    "runner",
    "emulator",
    "decision",
    "nextRuns",
    "heldOut",
    "report",
    "procedure",
    "traceResidual.h",
]


def includes(folder: Path = COUPLING, root: Path = COUPLING) -> Iterator[Any]:
    """Pairs of a file of `folder` and what it includes of `root`, relative to that."""
    for file in sorted(folder.rglob("*")):
        if file.suffix in (".h", ".cpp", ".C"):
            for included in re.findall(r'^#include "([^"]+)"', file.read_text(), re.MULTILINE):
                if (root / included).exists():
                    yield file, included


def part(file: Path) -> str:
    """The folder, or the header of a file that lies in none."""
    first = Path(file).parts[0]
    return first.replace(".cpp", ".h")


class Folders(unittest.TestCase):
    def test_none_includes_what_stands_above_it(self) -> None:
        """In one order for all; a folder that is not in it fails, too. One arrow of each is asked for, because a search
        that finds no includes would let everything pass."""
        for root, order, known in (
            (COUPLING, ORDER, ("couplingStep", "forces")),
            (IDENTIFICATION, ORDER_OF_IDENTIFICATION, ("procedure", "report")),
        ):
            arrows = set()
            for file, included in includes(root, root):
                of, to = part(file.relative_to(root)), part(included)
                self.assertIn(of, order)
                self.assertIn(to, order)
                self.assertGreaterEqual(order.index(of), order.index(to), f"{file} includes {included}")
                arrows.add((of, to))
            self.assertIn(known, arrows)

    def test_only_the_solver_knows_liggghts(self) -> None:
        """Its folder, and the program that chooses it."""
        knowing = {part(file.relative_to(COUPLING)) for file, included in includes() if "liggghts" in included}
        self.assertEqual(knowing, {"engine"})
        self.assertIn("engine/liggghts/liggghtsEngine.h", {to for _, to in includes(REPOSITORY / "solvers")})

    def test_closures_include_themselves_alone(self) -> None:
        """But for the program that prints their values."""
        known = {part(included) for file, included in includes(COUPLING / "closures") if file.suffix == ".h"}
        self.assertEqual(known, {"closures"})


if __name__ == "__main__":
    unittest.main()
