#!/usr/bin/python3
"""scripts/validate on two surrogates of cases, which write the rows that a test asks for.

A finding is a row that is known not to agree with its reference. It holds while it is found again, and only then: a
table that let every finding hold, as it once did, passes neither of the tests of a change. """

import json
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from typing import Any

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
ALLRUN = """#!/usr/bin/python3
import json, os, sys
from pathlib import Path
os.chdir(Path(__file__).parent)
from clepsydra import validation
asked = json.loads(Path("asked.json").read_text())
if isinstance(asked, int):
    sys.exit(asked)
validation.write([validation.row("v", "m/s", 2, "a formula", "computed", **asked)] if asked else [])
"""
# 10 % above the reference of 2, known to .5 % of it from one repeat to the next
FINDING = {"ours": 2.2, "uncertainty": 0.3, "repeats": 0.01, "tolerance_percent": 5, "finding": "soft particles"}
AGREEING = {"ours": 2.01, "uncertainty": 0.01, "tolerance_percent": 5}


class Findings(unittest.TestCase):
    def setUp(self) -> None:
        root = Path(tempfile.mkdtemp(prefix="clepsydra-validation-"))
        self.addCleanup(shutil.rmtree, root)
        self.cases = root / "cases" / "validation"
        (root / "scripts").mkdir()
        shutil.copy(SCRIPTS / "validate", root / "scripts")
        shutil.copytree(SCRIPTS / "clepsydra", root / "scripts" / "clepsydra")
        self.program = root / "scripts" / "validate"
        for name in ("one", "other"):
            (self.cases / name).mkdir(parents=True)
            (self.cases / name / "Allrun").write_text(ALLRUN)
            (self.cases / name / "Allrun").chmod(0o755)
        self.ask(one=FINDING, other=AGREEING)

    def ask(self, **rows: Any) -> None:
        for case, asked in rows.items():
            (self.cases / case / "asked.json").write_text(json.dumps(asked))

    def validate(self, *arguments: Any) -> Any:
        return subprocess.run([self.program, "--quick", *arguments], capture_output=True, text=True)

    def record(self) -> None:
        outcome = self.validate("--record")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)

    def assert_fails(self, pattern: str) -> None:
        outcome = self.validate()
        self.assertEqual(outcome.returncode, 1, outcome.stdout)
        self.assertRegex(outcome.stderr, pattern)

    def test_a_finding_holds_once_it_is_recorded(self) -> None:
        self.assert_fails(r"one, v: \+10\.00 % is more than the 5 % allowed, and this finding is not recorded")
        self.record()
        again = self.validate()
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertRegex(again.stdout, r"one +v .*\+10\.00 \+- 2\.121 +finding")
        self.assertRegex(again.stdout, r"other +v .*\+0\.00 \+- 5 +yes")

    def test_a_finding_that_changes_is_news(self) -> None:
        """By three standard errors of the two repeats, 2.1 %, and not of the reference, which would allow 60 %."""
        self.record()
        self.ask(one=FINDING | {"ours": 2.24})
        self.assertEqual(self.validate().returncode, 0)
        for changed in (2.25, 2.15, 3, 1):
            self.ask(one=FINDING | {"ours": changed})
            self.assert_fails(r"one, v: .* % is not the finding that is recorded, \+10\.00 \+- 2\.12 %")

    def test_a_finding_that_agrees_at_last_is_news(self) -> None:
        self.record()
        self.ask(one=FINDING | {"ours": 2})
        self.assert_fails(r"one, v: \+0\.00 % is not the finding")

    def test_a_row_that_no_longer_agrees_fails(self) -> None:
        self.record()
        self.ask(other=AGREEING | {"ours": 2.2})
        self.assert_fails("other, v: .* nothing explains it")
        self.ask(other=FINDING)
        self.assert_fails("other, v: .* this finding is not recorded")

    def test_a_row_that_is_no_longer_compared_is_missed(self) -> None:
        self.record()
        self.ask(other={})
        self.assert_fails("other, v: is recorded, but was not compared")

    def test_a_case_without_recorded_rows_fails(self) -> None:
        """Rows of it that are no longer compared could not be missed, and a case may compare nothing at all."""
        self.ask(one=AGREEING)
        self.assert_fails("one: none of its rows is recorded")
        self.record()
        self.assertEqual(self.validate().returncode, 0)
        self.ask(one={})
        self.assertEqual(self.validate("--record").returncode, 1)

    def test_what_nothing_explains_is_not_recorded(self) -> None:
        self.ask(other=AGREEING | {"ours": 3})
        self.assertEqual(self.validate("--record").returncode, 1)
        self.assertFalse((self.cases / "quickResults.json").exists())

    def test_the_record_of_a_case_that_did_not_run_stays(self) -> None:
        self.record()
        self.ask(one=77)
        self.assertEqual(self.validate("--record").returncode, 0)
        self.ask(one=FINDING)
        self.assertEqual(self.validate().returncode, 0)

    def test_a_case_that_fails_fails_and_one_left_out_does_not(self) -> None:
        self.record()
        self.ask(one=77)
        self.assertEqual(self.validate().returncode, 0)
        self.assertEqual(self.validate("one").returncode, 77)
        self.ask(one=1)
        self.assert_fails("one did not run to its end")

    def test_each_case_has_recorded_rows(self) -> None:
        """Of its quick version, but for what needs another program that automated builds lack."""
        cases = SCRIPTS.parent / "cases" / "validation"
        known = {path.parent.name for path in cases.glob("*/Allrun")}
        recorded = {
            name: {found["case"] for found in json.loads((cases / name).read_text())}
            for name in ("results.json", "quickResults.json")
        }
        for name, named in recorded.items():
            self.assertEqual(named - known, set(), f"{name} has rows of a case that there is not")
        self.assertEqual(known - recorded["quickResults.json"] - {"besideLammps"}, set())

    def test_what_is_committed_explains_each_row_that_does_not_agree(self) -> None:
        for name in ("results.json", "quickResults.json"):
            for found in json.loads((SCRIPTS.parent / "cases" / "validation" / name).read_text()):
                self.assertTrue(found["holds"] and (found["agrees"] or "finding" in found), (name, found["quantity"]))
                self.assertEqual(
                    found["agrees"], abs(found["errorPercent"]) <= found["tolerancePercent"], found["quantity"]
                )


unittest.main()
