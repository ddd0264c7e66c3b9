"""Tests of scripts/parameterStudy."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from typing import Any

import yaml

REPOSITORY = Path(__file__).resolve().parent.parent.parent
PARAMETER_STUDY = REPOSITORY / "scripts" / "parameterStudy"


class ParameterStudyTest(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="clepsydra-parameterStudy-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, **settings: Any) -> None:
        (self.folder / "test.yaml").write_text(yaml.safe_dump(settings))

    def command(self, *arguments: Any) -> list[Any]:
        return [PARAMETER_STUDY, arguments[0], self.folder / "test.yaml", *arguments[1:]]

    def call(self, *arguments: Any) -> Any:
        return subprocess.run(self.command(*arguments), capture_output=True, text=True)

    def start(self) -> Any:
        runner = subprocess.Popen(
            self.command("run", "--cores", "2"), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        assert runner.stdout
        self.addCleanup(runner.stdout.close)
        return runner

    def work(self, pattern: str) -> list[Any]:
        return sorted((self.folder / "work").glob(pattern))

    def rows(self, name: str) -> list[Any]:
        lines = (self.folder / "results" / f"{name}.csv").read_text().splitlines()[1:]
        return [tuple(map(float, line.split(","))) for line in lines]

    def wait_for(self, condition: Any, what: Any) -> None:
        end = time.time() + 120
        while not condition():
            self.assertLess(time.time(), end, f"{what} did not come within 120 s")
            time.sleep(0.05)


class ParameterStudyOfSurrogates(ParameterStudyTest):
    """The runner alone: surrogate/Allrun takes the place of the solver."""

    def sweep(self, frictions: Any, **more: Any) -> None:
        self.write(
            case=str(Path(__file__).parent / "surrogate"),
            steps=["dry", "submerged"],
            packings=[1, 2],
            runs={"mu": {"sweep": {"friction": frictions}}},
            **more,
        )

    def test_every_run_is_done_and_the_packing_is_shared(self) -> None:
        """Eight runs, two packings, one mesh: 2 fills and not 8, and every run began from the filling of its own seed
        (the surrogate asserts so). A runner that filled for each run would start more; one that ignored the seed fewer.
        """
        self.sweep([0.1, 0.2])
        outcome = self.call("run", "--cores", "2")
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        starts = "".join(path.read_text() for path in self.work("*/*/starts")).split("\n")
        self.assertEqual(
            sorted(line for line in starts if line),
            sorted(["mesh on 1"] + 2 * ["filling on 1"] + 4 * ["dry on 1"] + 4 * ["submerged on 1"]),
        )
        for name in ("mu-0.1.1.dry", "mu-0.2.2.submerged"):
            self.assertEqual([particles for _, _, particles in self.rows(name)], list(range(100, 80, -1)))
        record = json.loads((self.folder / "results" / "mu-0.2.2.submerged.json").read_text())
        self.assertEqual(record["parameters"]["friction"], 0.2)
        self.assertEqual(record["seed"], 2)
        self.assertEqual(record["packing"]["otherParameters"], {"friction": 0.1})
        self.assertEqual(record["code"], ["Clepsydra 0, commit surrogate"])

    def test_a_failure_stops_no_other_run_and_shows_its_log(self) -> None:
        """The surrogate refuses a friction of 2. Its message must reach the user, the others must end."""
        self.sweep([0.1, 2])
        outcome = self.call("run", "--cores", "2")
        self.assertNotEqual(outcome.returncode, 0)
        self.assertIn("the surrogate's own error message", outcome.stderr)
        self.assertEqual(len(list((self.folder / "results").glob("*.csv"))), 4)
        table = self.call("status").stdout
        self.assertRegex(table, r"mu-2\.1\.dry +failed")
        self.assertRegex(table, r"mu-0\.1\.1\.dry +done")
        self.assertIn("7 done, 4 failed", table)

    def test_stopped_or_killed_it_goes_on(self) -> None:
        """Asked to stop, then (the runner and all below it) killed: each time `run` goes on, and every row of m(t) is
        there once. A runner that began again would have its first rows twice."""
        hold = self.folder / "hold"
        hold.touch()
        self.sweep([0.1], parameters={"hold": str(hold)})
        for how in (signal.SIGTERM, signal.SIGKILL):
            before = self.held_runs()
            runner = self.start()
            self.wait_for(lambda: self.held_runs() == before + 2, "a pair of runs")
            if how == signal.SIGTERM:
                self.assertEqual(self.call("stop").returncode, 0)
            else:
                kill_tree(runner.pid)
            runner.communicate()
            self.assertNotEqual(runner.returncode, 0)
            self.assertRegex(self.call("status").stdout, "[1-9] stopped")
        hold.unlink()
        outcome = self.call("run", "--cores", "2")
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        attempts = 0
        for name in ("mu-0.1.1.dry", "mu-0.1.2.dry", "mu-0.1.1.submerged", "mu-0.1.2.submerged"):
            self.assertEqual([particles for _, _, particles in self.rows(name)], list(range(100, 80, -1)), name)
            attempts += json.loads((self.folder / "results" / f"{name}.json").read_text())["cost"]["attempts"]
        self.assertEqual(attempts, 8)

    def held_runs(self) -> Any:
        return sum(path.read_text().count("\n") for path in self.work("runs/*/held"))

    def test_a_long_table_is_thinned_and_has_the_end(self) -> None:
        """5002 rows: every second one, which would miss the last."""
        self.write(
            case=str(Path(__file__).parent / "surrogate"),
            steps=["dry"],
            packings=[1],
            parameters={"time": 50.02},
            runs={"one": {}},
        )
        outcome = self.call("run")
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        times = [time for time, _, _ in self.rows("one.1.dry")]
        self.assertEqual(times, [round(0.02 * row, 2) for row in range(2501)] + [50.01])

    def test_what_is_done_is_not_done_again(self) -> None:
        """Nor is a run that was begun with other parameters mistaken for this one."""
        self.sweep([0.1])
        self.assertEqual(self.call("run").returncode, 0)
        self.assertEqual(self.call("run").returncode, 0)
        self.assertEqual({path.read_text().count("\n") for path in self.work("*/*/starts")}, {1})
        (self.work("runs/mu-0.1.1.dry")[0] / "done").unlink()
        self.sweep([0.1], parameters={"hold": "elsewhere"})
        outcome = self.call("run")
        self.assertNotEqual(outcome.returncode, 0)
        self.assertIn(
            "begun with other parameters than the parameter study's file and the template have now (hold)",
            outcome.stdout + outcome.stderr,
        )

    def test_what_is_done_with_other_parameters_is_refused(self) -> None:
        """All are done; then the run, or the filling alone, gets another value. A runner that trusted its marks would
        leave the results of the earlier one and end with status 0."""
        settings: dict[str, Any] = {"case": str(Path(__file__).parent / "surrogate"), "steps": ["dry"], "packings": [1]}
        self.write(runs={"mu": {"parameters": {"friction": 0.2}}}, **settings)
        self.assertEqual(self.call("run").returncode, 0)
        # what the template lets change makes no other run
        self.write(runs={"mu": {"parameters": {"friction": 0.2, "drawEvery": 2}}}, **settings)
        self.assertEqual(self.call("run").returncode, 0)
        self.assertEqual(len((self.folder / "work/runs/mu.1.dry/starts").read_text().splitlines()), 1)
        for entry, name in (
            ({"parameters": {"friction": 0.3}}, "friction"),
            ({"parameters": {"friction": 0.2}, "filling": {"friction": 0.2}}, "those of its filling"),
        ):
            self.write(runs={"mu": entry}, **settings)
            outcome = self.call("run")
            self.assertEqual(outcome.returncode, 2, outcome.stdout + outcome.stderr)
            self.assertIn("runs/mu.1.dry was begun with other parameters than the parameter study's", outcome.stderr)
            self.assertIn(f"({name}); remove that folder to begin again", outcome.stderr)
            self.assertNotIn("mu.1.dry  done", self.call("status").stdout)
        shutil.rmtree(self.folder / "work/runs/mu.1.dry")
        self.assertEqual(self.call("run").returncode, 0)
        record = json.loads((self.folder / "results" / "mu.1.dry.json").read_text())
        self.assertEqual(record["packing"]["otherParameters"], {})

    def test_a_run_that_is_to_last_longer_goes_on(self) -> None:
        """All are done, then the end time is raised: each run goes on from its end, and its table has every row once. A
        runner that trusted its marks would start none of them; one that began again would have the first rows twice."""
        self.sweep([0.1])
        self.assertEqual(self.call("run").returncode, 0)
        self.sweep([0.1], parameters={"time": 0.3})
        self.assertIn("3 done, 4 stopped", self.call("status").stdout)
        outcome = self.call("run")
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        self.assertEqual([particles for _, _, particles in self.rows("mu-0.1.1.dry")], list(range(100, 70, -1)))
        self.assertEqual(len(self.work("runs/*/starts")), 4)
        self.assertEqual({path.read_text().count("\n") for path in self.work("runs/*/starts")}, {2})
        self.assertEqual({path.read_text().count("\n") for path in self.work("shared/*/starts")}, {1})
        record = json.loads((self.folder / "results" / "mu-0.1.1.dry.json").read_text())
        self.assertEqual((record["parameters"]["time"], record["cost"]["attempts"]), (0.3, 2))

    def test_the_template_may_be_edited_meanwhile(self) -> None:
        """The second run begins after the template got another default (which its program refuses), another parameter
        and another file beside them, as a hopper's surface is: it must be as the first, on the same mesh and filling.
        """
        template = self.folder / "template"
        shutil.copytree(Path(__file__).parent / "surrogate", template)
        (template / "hopper.stl").write_text("as it was")
        self.write(case=str(template), steps=["dry"], packings=[1], runs={"one": {}, "other": {}})
        self.assertEqual(self.call("run", "--only", "one").returncode, 0)
        parameters = template / "parameters"
        parameters.write_text(re.sub(r"(?m)^friction .*;", "friction 2;", parameters.read_text()) + "another 1;\n")
        self.assertIn("friction 2;", parameters.read_text())
        (template / "hopper.stl").write_text("edited")
        outcome = self.call("run")
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        one, other = (
            json.loads((self.folder / "results" / f"{name}.1.dry.json").read_text()) for name in ("one", "other")
        )
        self.assertEqual(other["parameters"], one["parameters"])
        self.assertEqual([path.read_text() for path in self.work("*/*/hopper.stl")], 4 * ["as it was"])
        self.assertEqual(len(self.work("shared/*")), 2)

    def test_only_some_of_the_runs(self) -> None:
        """Of two entries one runs, and the whole parameter study then has the other left to do."""
        self.write(
            case=str(Path(__file__).parent / "surrogate"),
            steps=["dry"],
            packings=[1],
            runs={"one": {}, "other": {"parameters": {"friction": 0.3}}},
        )
        self.assertEqual(self.call("run", "--only", "other").returncode, 0)
        self.assertEqual([path.name for path in (self.folder / "results").glob("*.json")], ["other.1.dry.json"])
        self.assertRegex(self.call("status").stdout, r"one\.1\.dry +waiting")
        self.assertRegex(self.call("run", "--only", "noSuchRun").stderr, "no run 'noSuchRun'; there are: one, other")

    def test_only_runs_without_results(self) -> None:
        """As in a fresh copy of a repository that holds the results of one run, by an earlier program: that one is
        neither run nor written again, and of two fills only the other's is made."""
        self.write(case=str(Path(__file__).parent / "surrogate"), steps=["dry"], packings=[1, 2], runs={"one": {}})
        earlier = self.folder / "results" / "one.1.dry.json"
        earlier.parent.mkdir()
        earlier.write_text('{"parameters": {"seed": 1, "another": 2}}')
        self.assertNotIn("one.1.dry", self.call("status", "--missing").stdout)
        self.assertEqual(self.call("run", "--missing").returncode, 0)
        self.assertEqual([path.name for path in self.work("runs/*")], ["one.2.dry"])
        self.assertEqual(len(self.work("shared/filling-*")), 1)
        self.assertEqual(earlier.read_text(), '{"parameters": {"seed": 1, "another": 2}}')
        outcome = self.call("run", "--missing")
        self.assertEqual((outcome.returncode, outcome.stdout), (0, "parameterStudy: every run has its results\n"))
        self.assertEqual(self.call("run").returncode, 0)
        self.assertEqual(len(self.work("runs/*")), 2)

    def test_wrong_files_are_named_with_what_is_allowed(self) -> None:
        self.sweep([0.1], parameters={"fricton": 1})
        outcome = self.call("run")
        self.assertEqual(outcome.returncode, 2)
        self.assertRegex(outcome.stderr, r"test\.yaml.*fricton.*seed, friction, cellSize")
        self.sweep([0.1], step="dry")
        self.assertRegex(self.call("status").stderr, "unknown entry 'step'; allowed: base, case")
        self.assertFalse((self.folder / "work" / "runs").exists())


class ParameterStudyOnSlurm(ParameterStudyTest):
    """The same list as job arrays of a real Slurm, which the test starts on this machine."""

    def setUp(self) -> None:
        super().setUp()
        if not all(map(shutil.which, ("munged", "slurmctld", "slurmd"))) or os.geteuid() != 0:
            self.skipTest("needs the packages slurm-wlm and munge, and root")
        on_loopback = REPOSITORY / "scripts" / "slurm" / "onLoopback"
        self.addCleanup(lambda: subprocess.run([on_loopback, "stop", self.folder / "slurm"]))
        subprocess.run([on_loopback, "start", self.folder / "slurm", "2"], check=True, stdout=subprocess.DEVNULL)
        os.environ["SLURM_CONF"] = str(self.folder / "slurm" / "slurm.conf")

    def test_job_arrays_cancelled_and_submitted_again(self) -> None:
        """Cancelled in the midst of its runs, all four of them go on where they were when the list is submitted again;
        what was done by then is not submitted."""
        hold = self.folder / "hold"
        hold.touch()
        self.write(
            case=str(Path(__file__).parent / "surrogate"),
            steps=["dry", "submerged"],
            packings=[1, 2],
            ranks=2,
            parameters={"hold": str(hold)},
            runs={"mu": {}},
        )
        first = self.call("run", "--executor", "slurm", "--", "--time=20")
        self.assertRegex(first.stdout, r"submitted as jobs \d+, \d+, \d+;", first.stderr)
        self.wait_for(lambda: self.work("runs/*/held"), "a run")
        subprocess.run(["scancel", "--name=test"], check=True)
        self.wait_for(lambda: not self.queue(), "the end of the cancelled jobs")
        self.assertRegex(self.call("status").stdout, "3 done, 1 stopped, 3 waiting")
        hold.unlink()
        second = self.call("run", "--executor", "slurm")
        self.assertRegex(second.stdout, r"submitted as jobs \d+;", second.stderr)
        self.wait_for(lambda: not self.queue(), "the end of the jobs")
        self.assertIn("7 done", self.call("status").stdout)
        for name in ("mu.1.dry", "mu.1.submerged", "mu.2.dry", "mu.2.submerged"):
            self.assertEqual([particles for _, _, particles in self.rows(name)], list(range(100, 80, -1)), name)
        self.assertIn("dry on 2\n", self.work("runs/mu.1.dry/starts")[0].read_text())

    def queue(self) -> Any:
        return subprocess.run(["squeue", "--noheader"], check=True, capture_output=True, text=True).stdout


class ParameterStudyOfHoppers(ParameterStudyTest):
    def test_the_quick_hopper_through_the_real_program(self) -> None:
        """300 particles, one packing, two frictions, dry; stopped on the way. Both frictions must start from the very
        same mass, the smoother particles must leave faster, and no row may be lost or doubled by the stop."""
        self.write(
            case=str(REPOSITORY / "cases" / "tutorials" / "hopperQuick"),
            steps="dry",
            keepTimes=2,
            parameters={
                "particleCount": 300,
                "hopperDiameter": 0.015,
                "orificeDiameter": 0.009,
                "hopperHeight": 0.04,
                "tankDiameter": 0.04,
                "tankDepth": 0.025,
                "waterAboveRim": 0.01,
                "fillingTime": 0.7,
                "dryTime": 1.5,
            },
            runs={"mu": {"sweep": {"friction": [0.1, 0.5]}}},
        )
        runner = self.start()
        tables = "runs/mu-0.1*/steps/dry/postProcessing/massInHopper/0/massInHopper.dat"
        self.wait_for(lambda: any(path.read_text().count("\n") > 20 for path in self.work(tables)), "the discharge")
        runner.terminate()
        said, _ = runner.communicate()
        self.assertIn("stopped", said)
        outcome = self.call("run")
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        low, high = self.rows("mu-0.1.100003.dry"), self.rows("mu-0.5.100003.dry")
        self.assertEqual(low[0], high[0])
        self.assertEqual(low[0][2], 300)
        # 0.2 s after the start: what stays on the bottom at the end is chance
        self.assertLess(low[100][2], high[100][2])
        for rows in (low, high):
            times = [time for time, _, _ in rows]
            steps = [later - earlier for earlier, later in zip(times, times[1:])]
            self.assertLess(max(steps), 0.0021)
            self.assertGreater(min(steps), 0.0019)
        records = [json.loads(path.read_text()) for path in (self.folder / "results").glob("*.json")]
        self.assertGreater(sum(record["cost"]["attempts"] for record in records), 2)
        self.assertEqual([record["summary"]["particles_lost"] for record in records], [0, 0])
        self.assertEqual(len(self.work("runs/mu-0.1*/steps/dry/checkpoints/*/complete")), 2)


def kill_tree(process: Any) -> None:
    """SIGKILL to a process and all its descendants, parents first, as a power cut would."""
    children = subprocess.run(["pgrep", "-P", str(process)], capture_output=True, text=True).stdout.split()
    os.kill(process, signal.SIGKILL)
    for child in children:
        kill_tree(int(child))


if __name__ == "__main__":
    result = unittest.main(exit=False).result
    # 77 is ctest's SKIP_RETURN_CODE
    nothing_ran = len(result.skipped) == result.testsRun
    sys.exit(1 if not result.wasSuccessful() else 77 if nothing_ran else 0)
