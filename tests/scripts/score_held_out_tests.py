#!/usr/bin/python3
"""scoreHeldOut with a program in place of traceResidual: an existing report stays as it is, and a stop is no traceback.
"""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

STUDY = """
study: s
conditions:
  - { name: a, role: training }
  - { name: b, role: candidate }
"""

REPORT = {"study": "s", "decision": "named", "name": "x", "heldOut": {}}


class Scored(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp())
        (self.folder / "study.yaml").write_text(STUDY)
        (self.folder / "b.csv").write_text("t,m\n0,1\n")
        (self.folder / "report.json").write_text(json.dumps(REPORT))
        self.program('mkdir -p "$3"; cp "${0%/*}/../report.json" "$3"; cp "$4" "${0%/*}/../given.yaml"')

    def program(self, script: str) -> None:
        (self.folder / "bin").mkdir(exist_ok=True)
        program = self.folder / "bin/traceResidual"
        program.write_text(f"#!/bin/sh\n{script}\n")
        program.chmod(0o755)

    def start(self, *more: str) -> "subprocess.Popen[str]":
        code = (
            "import sys; from clepsydra import environment, score_held_out;"
            "environment.load = lambda *_: None; raise SystemExit(score_held_out.main())"
        )
        return subprocess.Popen(
            [sys.executable, "-c", code, str(self.folder / "study.yaml"), f"b={self.folder / 'b.csv'}", *more],
            env={
                **os.environ,
                "PYTHONPATH": str(ROOT / "scripts"),
                "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}",
            },
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )

    def test_a_report_is_not_overwritten(self) -> None:
        """The first call writes a report, with the candidate held out. The second one refuses and leaves it alone; with
        another folder it runs. A script that always ran would exit with 0."""
        first = self.start()
        self.assertIn("s: named x", first.communicate()[0])
        self.assertIn("heldOut", (self.folder / "given.yaml").read_text())
        report = self.folder / "results/heldOut/report.json"
        report.write_text("old")
        second = self.start()
        self.assertIn("exists already and is not overwritten", second.communicate()[1])
        self.assertNotEqual(second.returncode, 0)
        self.assertEqual(report.read_text(), "old")
        third = self.start("--output", str(self.folder / "other"))
        self.assertIn("s: named x", third.communicate()[0])

    def test_a_stop_is_no_traceback(self) -> None:
        """SIGINT while the program runs: the program gets it too and is waited for."""
        self.program(
            'trap \'sleep 0.3; touch "${0%/*}/ended"; exit 1\' INT; touch "${0%/*}/begun"; while :; do sleep 0.05; done'
        )
        running = self.start()
        while not (self.folder / "bin/begun").exists():
            time.sleep(0.02)
        running.send_signal(signal.SIGINT)
        error = running.communicate(timeout=20)[1]
        self.assertEqual(running.returncode, 130)
        self.assertNotIn("Traceback", error)
        self.assertIn("stopped", error)
        self.assertTrue((self.folder / "bin/ended").exists())


if __name__ == "__main__":
    unittest.main()
