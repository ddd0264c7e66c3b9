"""The JSON file of scripts/benchmark, without a measurement."""

import argparse
import json
import tempfile
import unittest
from pathlib import Path

from developers.benchmarks import report


class Report(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="clepsydra-benchmark-")
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name) / "results.json"
        self.options = argparse.Namespace(quick=True, realTime=False)

    def measured(self, **figures: str) -> None:
        report.write(self.file, report.earlier_entries(self.file, self.options), figures, self.options)

    def test_an_entry_that_is_measured_leaves_the_others(self) -> None:
        """Of a file of the same machine, commit and options: written from the start, it would have the last alone."""
        self.measured(one="first", other="first")
        self.measured(other="second", third="second")
        found = json.loads(self.file.read_text())
        self.assertEqual(
            {name: entry["skipped"] for name, entry in found["entries"].items()},
            {"one": "first", "other": "second", "third": "second"},
        )
        self.assertRegex(found["machine"], r", \d+ cores, \d{4}-\d\d-\d\d, load ")

    def test_results_of_other_conditions_are_not_mixed(self) -> None:
        """Before anything is measured, and with the file as it was."""
        self.measured(one="first")
        good = json.loads(self.file.read_text())
        for name, value in (
            ("machine", "Abacus, 2 cores, 2026-11-27, load 1.5 (mean of the last 15 minutes)"),
            ("commit", "another"),
            ("quick", False),
            ("realTime", True),
        ):
            self.file.write_text(json.dumps(good | {name: value}))
            with self.assertRaises(SystemExit) as problem:
                report.earlier_entries(self.file, self.options)
            self.assertIn(f"results.json: entry '{name}' is ", str(problem.exception))
            self.assertIn("allowed: another FILE", str(problem.exception))
        for text in ("no JSON", "[]", "{}"):
            self.file.write_text(text)
            with self.assertRaises(SystemExit) as problem:
                report.earlier_entries(self.file, self.options)
            self.assertIn("no file of results", str(problem.exception))


if __name__ == "__main__":
    unittest.main()
