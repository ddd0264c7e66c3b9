"""What scripts/parameterStudy does with damaged state, a full disk and mistaken files. With the surrogate of
tests/parameterStudy; seconds."""

import errno
import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

import yaml

from clepsydra import parameter_study_results, whole_files
from clepsydra.parameter_studies import executors, task
from clepsydra.parameter_studies.command import copy_program
from clepsydra.parameter_studies.plan import ParameterStudy

REPOSITORY = Path(__file__).resolve().parents[2]
SURROGATE = REPOSITORY / "tests" / "parameterStudy" / "surrogate"


class ParameterStudyFile(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="clepsydra-parameterStudy-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, **settings: Any) -> None:
        (self.folder / "test.yaml").write_text(
            yaml.safe_dump({"case": str(SURROGATE), "steps": ["dry"], "packings": [1], "runs": {"one": {}}, **settings})
        )

    def parameter_study(self) -> Any:
        return ParameterStudy(self.folder / "test.yaml")

    def call(self, command: Any, *arguments: Any) -> Any:
        return subprocess.run(
            [REPOSITORY / "scripts" / "parameterStudy", command, self.folder / "test.yaml", *arguments],
            capture_output=True,
            text=True,
            env={"PATH": os.environ["PATH"], "CLEPSYDRA_BUILD": str(self.folder)},
        )

    def refused(self, command: Any = "check") -> Any:
        outcome = self.call(command)
        self.assertEqual(outcome.returncode, 2, outcome.stdout + outcome.stderr)
        self.assertNotIn("Traceback", outcome.stderr)
        return outcome.stderr


class DamagedState(ParameterStudyFile):
    def attempts(self, text: str) -> Any:
        self.write()
        folder = self.folder / "work/runs/one.1.dry"
        folder.mkdir(parents=True)
        (folder / "attempts").write_text(text)
        return folder

    def test_half_a_line_of_attempts_is_dropped(self) -> None:
        """A kill in the midst of a write leaves half a line: `status` shows the run, and the next attempt begins a line
        of its own. A reader that takes each line for JSON ends with a traceback; a writer that appends spoils its own
        line."""
        start = '{"start": 10.0, "host": "here", "ranks": 1}\n'
        folder = self.attempts(start + '{"end": 20.0, "sta')
        outcome = self.call("status")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        self.assertRegex(outcome.stdout, r"one\.1\.dry +stopped")
        with task.locked(folder / "attempts") as attempts:
            with mock.patch("builtins.print") as said:
                task.drop_half_line(attempts)
            task.note(attempts, {"end": 30.0, "status": 1})
        self.assertIn("dropped half a line", said.call_args[0][0])
        self.assertEqual((folder / "attempts").read_text(), start + '{"end": 30.0, "status": 1}\n')
        self.assertEqual(task.attempts_of(folder), [[10.0, 30.0, 1]])

    def test_other_damage_of_attempts_is_named(self) -> None:
        for line in ("no JSON", "[]", '{"start": "x", "ranks": 1}', '{"end": 1, "status": 0}', "{}"):
            self.attempts(line + "\n")
            self.assertIn(f"attempts:1: {line!r} is no start or end of an attempt", self.refused("status"))
            shutil.rmtree(self.folder / "work")

    def test_a_full_disk_never_leaves_a_half_file(self) -> None:
        """Whatever step of a write fails, the old file is still there, whole, and the failure is known."""
        path = self.folder / "results.json"
        for step in ("fsync", "write", "rename"):
            with self.subTest(step):
                whole_files.write(path, "old\n")
                full = OSError(errno.ENOSPC, "No space left on device")
                with (
                    mock.patch(f"os.{step}", side_effect=full)
                    if step == "fsync"
                    else (
                        mock.patch("pathlib.Path.rename", side_effect=full)
                        if step == "rename"
                        else mock.patch("builtins.open", return_value=open("/dev/full", "w"))
                    )
                ):
                    with self.assertRaises(OSError):
                        whole_files.write(path, "new, and longer\n")
                self.assertEqual(path.read_text(), "old\n")
                self.assertEqual([found.name for found in self.folder.iterdir()], ["results.json"])


class MistakenFiles(ParameterStudyFile):
    def test_an_entry_that_is_there_twice(self) -> None:
        self.write()
        with open(self.folder / "test.yaml", "a") as file:
            file.write("steps: [submerged]\n")
        self.assertIn("entry 'steps' is there twice", self.refused())

    def test_misspelt_words_name_the_nearest(self) -> None:
        self.write(packing=[1])
        self.assertIn("unknown entry 'packing'; allowed: base, case", self.refused())
        self.assertIn("(is 'packings' meant?)", self.refused())
        self.write(parameters={"fricton": 0.1})
        self.assertIn("(is 'friction' meant?)", self.refused())

    def test_what_is_no_list_of_runs_or_no_number_of_times(self) -> None:
        """Before anything is run: these were found while the first run was under way, or ended in a traceback."""
        wrong: list[tuple[dict[str, Any], str]] = [
            ({"runs": {}}, "entry 'runs' is {}; allowed: a list of"),
            ({"runs": {"mu": 5}}, "allowed: a list of"),
            ({"keepTimes": 1}, "entry 'keepTimes' is 1; allowed: all, or a whole number above 1"),
        ]
        for settings, words in wrong:
            self.write(**settings)
            for command in ("check", "run"):
                self.assertIn(words, self.refused(command))

    def test_parameters_of_the_hopper_are_checked_before_anything_is_made(self) -> None:
        """Of every run, also of one of many in a sweep."""
        for values, words in (
            ({"friction": "nan"}, "entry 'friction' is nan; allowed: a number from 0 to 10"),
            ({"particleDiameter": [2e-3, 2]}, "entry 'particleDiameter' is 2; allowed: a number from 1e-05 to 0.1 [m]"),
            ({"orificeDiameter": 1e-3}, "cannot pass orificeDiameter 0.001 m"),
            ({"friction": '0.1; #include "/etc/passwd"'}, "entry 'friction' cannot be"),
            ({"fillMass": "().__class__"}, "'fillMass' is"),
        ):
            self.write(
                case=str(REPOSITORY / "cases" / "tutorials" / "hopperQuick"),
                packings=[100003],
                runs={"one": {"sweep": values}},
            )
            for command in ("check", "run"):
                self.assertIn(words, self.refused(command))
            self.assertFalse((self.folder / "work").exists())

    def test_an_empty_list_is_no_list_of_runs(self) -> None:
        """It makes no run: the command would say that every run has its results, and end with status 0."""
        wrong: list[tuple[dict[str, Any], str]] = [
            ({"runs": {"mu": {"sweep": {"friction": []}}}}, "runs/mu/sweep/friction"),
            ({"runs": {"mu": {"packings": []}}}, "runs/mu/packings"),
            ({"runs": {"mu": {"steps": []}}}, "runs/mu/steps"),
            ({"packings": []}, "packings"),
            ({"steps": []}, "steps"),
        ]
        for settings, entry in wrong:
            self.write(**settings)
            for command in ("check", "run"):
                self.assertIn(f"entry '{entry}' is []; allowed: a value, or a list of one", self.refused(command))

    def test_a_seed_beside_packings_is_refused(self) -> None:
        """Each packing sets the seed: a sweep over it would make equal runs of different names."""
        for own in ({"sweep": {"seed": [1, 2]}}, {"parameters": {"seed": 1}}):
            self.write(packings=[100003], runs={"mu": own})
            self.assertIn("allowed: no seed: `packings` are its values", self.refused("check"))

    def hoppers(self, **settings: Any) -> None:
        self.write(case=str(REPOSITORY / "cases/tutorials/hopperQuick"), packings=[100003], **settings)

    def counts(self, part: str) -> list[float]:
        parameter_study = self.parameter_study()
        tasks = [task for task in parameter_study.tasks.values() if task.part == part]
        return sorted(parameter_study.parameters(task)["particleCount"] for task in tasks)

    def test_a_runs_own_parameter_replaces_a_derived_one_of_all(self) -> None:
        """fillMass sets particleCount, 94 for 1 g. Computed whatever else is there, it would make equal runs of
        different names; a later fillMass replaces an earlier particleCount, too, also that of another file."""
        self.hoppers(parameters={"fillMass": 1e-3}, runs={"one": {}, "n": {"sweep": {"particleCount": [100, 200]}}})
        self.assertEqual(self.counts("dry"), [94, 100, 200])
        self.assertEqual(self.counts("filling"), [94, 100, 200])
        (self.folder / "test.yaml").rename(self.folder / "base.yaml")
        (self.folder / "test.yaml").write_text("base: base.yaml\nparameters: {particleCount: 300}\nruns: {one: {}}\n")
        self.assertEqual(self.counts("dry"), [300])
        self.hoppers(parameters={"particleCount": 300}, runs={"one": {"parameters": {"fillMass": 1e-3}}})
        self.assertEqual(self.counts("dry"), [94])

    def test_a_parameter_and_the_one_that_sets_it_are_not_given_together(self) -> None:
        both: dict[str, Any] = {"fillMass": 1e-3, "particleCount": 100}
        words = "is 'fillMass, particleCount'; allowed: one of them: each sets particleCount"
        self.hoppers(parameters=both, runs={"one": {}})
        self.assertIn(f"entry 'parameters' {words}", self.refused())
        self.hoppers(runs={"one": {"sweep": both}})
        self.assertIn(f"entry 'runs/one/sweep' {words}", self.refused())

    def test_parameters_of_the_filling_count_or_are_refused(self) -> None:
        """A name from which a parameter is derived was dropped, and so was what the filling does not depend on."""
        self.hoppers(runs={"one": {"filling": {"fillMass": 1e-3}}})
        self.assertEqual(self.counts("filling"), [94])
        self.hoppers(runs={"one": {"filling": {"fluidDensity": 900}}})
        self.assertRegex(
            self.refused(),
            "entry 'runs/one/filling' is 'fluidDensity'; allowed: the parameters on which the template's filling "
            "depends, which are particleDiameter, .*, fillMass",
        )

    def test_machines_of_slurm_are_not_this_one(self) -> None:
        """More ranks than this machine can bear are refused here, and are none of its business where Slurm places
        them."""
        self.write(case=str(REPOSITORY / "cases" / "tutorials" / "hopperQuick"), packings=[100003], ranks=100000)
        self.assertIn("100000 ranks; allowed", self.refused())
        outcome = self.call("check", "--executor", "slurm")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)

    def test_a_parameter_study_may_lie_outside_the_repository(self) -> None:
        """A copy of cases/paper/reference.yaml: its base is found, and its work and results lie beside it."""
        shutil.copy(REPOSITORY / "cases/paper/reference.yaml", self.folder / "test.yaml")
        outcome = self.call("check")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        self.assertIn("37596 of 2 mm, 400 g", outcome.stdout)
        self.assertEqual(self.parameter_study().work, self.folder / "work/reference")

    def test_a_space_in_the_path(self) -> None:
        self.write(work="my work")
        self.assertIn("has a space or a quote in it", self.refused())


class Archive(ParameterStudyFile):
    def publish(self, name: str, mass: float) -> None:
        results = self.folder / "results"
        results.mkdir(exist_ok=True)
        inputs = {"run": name, "step": "dry", "seed": 1, "parameters": {"seed": 1}, "cost": {}}
        (results / f"{name}.json").write_text(json.dumps(inputs))
        (results / f"{name}.csv").write_text(f"time [s],mass [kg],particles [-]\n0,{mass},1\n")

    def masses(self) -> dict[str, float]:
        return {run.name: run.mass[0] for run in parameter_study_results.read(self.folder / "results")}

    def test_later_results_join_the_archive_and_take_the_place_of_earlier_ones(self) -> None:
        """An archive that is written from the start loses the first run; one that appends has two files of one name."""
        self.write(runs={"one": {}, "two": {}})
        self.publish("one.1.dry", 1.0)
        self.assertIn("2 files", self.call("archive").stdout)
        self.publish("one.1.dry", 3.0)
        self.publish("two.1.dry", 2.0)
        self.assertIn("4 files", self.call("archive").stdout)
        self.assertEqual(list((self.folder / "results").iterdir()), [])
        self.assertEqual(self.masses(), {"one.1.dry": 3.0, "two.1.dry": 2.0})
        self.assertIn("every run has its results", self.call("status", "--missing").stdout)

    def test_the_same_results_make_the_same_archive(self) -> None:
        self.write()
        archives = []
        for _ in range(2):
            self.publish("one.1.dry", 1.0)
            self.call("archive")
            archives.append((self.folder / "results.zip").read_bytes())
        self.assertEqual(archives[0], archives[1])

    def test_results_of_other_parameters_are_missing(self) -> None:
        """By name they are there. An entry that only the template has may be another by now."""
        self.write(runs={"one": {}})
        self.publish("one.1.dry", 1.0)
        self.assertIn("every run has its results", self.call("status", "--missing").stdout)
        self.write(runs={"one": {"parameters": {"friction": 0.3}}})
        said = self.call("status", "--missing").stdout
        self.assertIn("results/one.1.dry.json is of other parameters (friction): its run is one of the missing", said)
        self.assertRegex(said, r"one\.1\.dry +waiting")

    def test_what_is_no_json_of_a_run_is_named(self) -> None:
        self.write()
        self.publish("one.1.dry", 1.0)
        for text in ("no JSON", "[]", '{"parameters": 1}'):
            (self.folder / "results/one.1.dry.json").write_text(text)
            outcome = self.call("status", "--missing")
            self.assertEqual(outcome.returncode, 2, outcome.stderr)
            self.assertIn("results/one.1.dry.json: no dictionary 'parameters' in it; allowed: ", outcome.stderr)


class Program(ParameterStudyFile):
    def test_libraries_in_folders_are_copied_with_the_program(self) -> None:
        """lib/openfoam has the library without which OpenFOAM decomposes by a stub; what is no library stays."""
        self.write(case=str(SURROGATE))
        for name in ("bin/pimpleDemFoam", "lib/libcoupling.so", "lib/libtests.a", "lib/openfoam/libscotchDecomp.so"):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).touch()
        with mock.patch.dict(os.environ, {"CLEPSYDRA_BUILD": str(self.folder)}):
            copy_program(self.parameter_study())
        program = self.folder / "work/program"
        self.assertEqual(
            sorted(str(path.relative_to(program)) for path in program.rglob("*") if path.is_file()),
            ["bin/pimpleDemFoam", "lib/libcoupling.so", "lib/openfoam/libscotchDecomp.so"],
        )


class Shell(ParameterStudyFile):
    def test_no_name_reaches_a_shell_or_make_as_code(self) -> None:
        """The parameter study's file lies in a folder whose name make, or the shell, would run: the task must get it as
        it is."""
        work, command = self.folder / "work", self.folder / "command"
        command.write_text(f'#!/bin/sh\nprintf %s "$2" > {self.folder}/received\n')
        command.chmod(0o755)
        self.folder = self.folder / "$(shell touch made);touch made;`touch made`"
        self.folder.mkdir()
        self.write(work=str(work))
        work.mkdir()
        with mock.patch.object(executors, "COMMAND", str(command)), mock.patch("signal.signal"):
            executors.local(self.parameter_study(), 1)
        self.assertEqual(list(work.parent.rglob("made")), [])
        self.assertEqual((work.parent / "received").read_text(), str(self.folder / "test.yaml"))


if __name__ == "__main__":
    unittest.main()
