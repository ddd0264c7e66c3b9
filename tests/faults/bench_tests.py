"""What scripts/faults takes for a try that shows something, without a run: a bench that lets everything hold shows
nothing."""

import types
import unittest
from typing import Any

from developers.fault_kinds import report
from developers.fault_kinds.bench import Outcome

KIND = types.SimpleNamespace(name="someFault", done="something", expected="nothing is lost")
# A run that was killed in the midst of it: it speaks of errors, and has none.
LOG = """Conservation: momentum error 1.2e-16, continuity error 0
cannot be better: an Error of zero
"""


class Rows(unittest.TestCase):
    def holds(self, seen: dict[str, int], wrong: list[str], skipped: str | None = None) -> Any:
        return report.row(KIND, seen, wrong, 1.0, skipped)["holds"]

    def test_a_kind_holds_where_each_try_does(self) -> None:
        self.assertIs(self.holds({"same end": 3}, []), True)
        self.assertIs(self.holds({"same end": 3}, ["another end"]), False)

    def test_a_kind_that_was_skipped_neither_holds_nor_fails(self) -> None:
        self.assertIs(self.holds({}, [], "there is no strace here"), None)

    def test_a_kind_without_a_try_does_not_hold(self) -> None:
        """As that of failing syncs, if the program made none any more."""
        row = report.row(KIND, {}, [], 0.0)
        self.assertIs(row["holds"], False)
        self.assertEqual(row["tries"], 0)
        self.assertIn("no try was made", row["observed"])


class Messages(unittest.TestCase):
    def test_the_word_error_explains_nothing(self) -> None:
        outcome = Outcome(1, LOG)
        self.assertEqual(outcome.message, "")
        self.assertFalse(outcome.explains("error", "cannot", "Error"))

    def test_an_error_explains_what_it_names(self) -> None:
        error = "--> FOAM FATAL ERROR: (openfoam-1912)\nCannot write 0.06/p: No space left on device\n"
        outcome = Outcome(1, LOG + error)
        self.assertTrue(outcome.explains("No space left on device"))
        self.assertFalse(outcome.explains("Read-only file system"), "another reason")
        self.assertFalse(outcome.explains("momentum"), "that was said before")

    def test_errors_of_others_count_too(self) -> None:
        for error in (
            "pimpleDemFoam: error while loading shared libraries: libm.so.6: failed to map segment\n",
            '[0] pimpleDemFoam: cannot open case directory "/tmp/processor0"\n',
            "terminate called after throwing an instance of 'std::bad_alloc'\n",
        ):
            self.assertTrue(Outcome(1, LOG + error).explains("map segment", "case directory", "alloc"), error)


if __name__ == "__main__":
    unittest.main()
