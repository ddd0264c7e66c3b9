"""The faults of scripts/mutate can be put into the program as it is, every unit has some, and the tool tells a fault
that is noticed from one that is not.

Whoever changes a line that a fault is put into has to change the fault, too: otherwise it would be lost in silence, and
the share of faults that are caught would be that of an old program. """

import contextlib
import dataclasses
import io
import json
import re
import subprocess
import tempfile
import unittest
from pathlib import Path
from typing import Any

from developers import mutate

REPOSITORY = Path(__file__).resolve().parents[2]

FAULTS = """
- {name: noticed, file: value, text: good, replacement: bad, targets: [built], tests: looks, shows: a test looks}
- {name: unnoticed, file: remark, text: nice, replacement: ugly, targets: [built], tests: looks, shows: none looks}
- {name: broken, file: value, text: word, replacement: wrod, targets: [built], tests: looks, shows: it is not built}
"""
PROJECT = """
cmake_minimum_required(VERSION 3.22)
project(small NONE)
enable_testing()
add_custom_target(built COMMAND grep -q word ${PROJECT_SOURCE_DIR}/value)
add_test(NAME looks COMMAND grep -q good ${PROJECT_SOURCE_DIR}/value)
"""


class ListOfFaults(unittest.TestCase):
    def setUp(self) -> None:
        self.mutations = mutate.read(mutate.LIST)

    def test_each_can_be_put_in(self) -> None:
        problems = [problem for mutation in self.mutations if (problem := mutation.problem(REPOSITORY))]
        self.assertEqual(problems, [])

    def test_each_names_targets_that_there_are_and_tests(self) -> None:
        """A regular expression that matches no test would be an error after a long build only."""
        texts = [file.read_text() for file in REPOSITORY.glob("[cist]*/**/CMakeLists.txt") if "build" not in file.parts]
        targets = set(re.findall(r"add_(?:executable|library)\((\w+)", "\n".join(texts)))
        for mutation in self.mutations:
            self.assertLessEqual(set(mutation.targets), targets, mutation.name)
            self.assertTrue(re.compile(mutation.tests).pattern, mutation.name)
            self.assertTrue(mutation.shows.strip(), mutation.name)

    def test_each_unit_has_some(self) -> None:
        """A unit is a folder of coupling or identification that holds C++."""
        units = {
            str(file.parent.relative_to(REPOSITORY))
            for root in ("coupling", "identification")
            for file in (REPOSITORY / root).rglob("*.cpp")
            if file.parent != REPOSITORY / root
        }
        self.assertGreater(len(units), 20)
        without = units - {str(Path(mutation.file).parent) for mutation in self.mutations}
        self.assertEqual(sorted(without), [])

    def test_problems_are_found(self) -> None:
        """Without this, the first test could not fail."""
        whole = self.mutations[0]
        cases: tuple[tuple[dict[str, Any], str], ...] = (
            ({"file": "coupling/none.cpp"}, "no file"),
            ({"text": "no such text anywhere"}, "0 times"),
            ({"text": "\n"}, "times"),
            ({"replacement": whole.text}, "itself"),
        )
        for changes, expected in cases:
            problem = dataclasses.replace(whole, **changes).problem(REPOSITORY)
            self.assertIn(expected, problem or "")


class SmallProject(unittest.TestCase):
    """The tool itself, on a project of two files."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.repository = self.folder / "repository"
        self.repository.mkdir()
        for name, text in (("CMakeLists.txt", PROJECT), ("value", "a good word\n"), ("remark", "nice\n")):
            (self.repository / name).write_text(text)
        self.git("init", "--quiet")
        self.commit()
        (self.folder / "faults.yaml").write_text(FAULTS)
        self.mutations = mutate.read(self.folder / "faults.yaml")

    def git(self, *words: str) -> None:
        who = ["-c", "user.name=none", "-c", "user.email=none"]
        subprocess.run(["git", "-C", self.repository, *who, *words], check=True)

    def commit(self) -> None:
        self.git("add", ".")
        self.git("commit", "--quiet", "--message", "state")

    def run_tool(self, mutations: list[mutate.Mutation]) -> tuple[int, str, Any]:
        workshop = mutate.Workshop(self.folder, 1, self.repository)
        file = self.folder / "results.json"
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(io.StringIO()):
            status = mutate.tried(mutations, workshop, file)
        return status, said.getvalue(), json.loads(file.read_text())

    def test_tells_what_is_caught(self) -> None:
        status, said, results = self.run_tool(self.mutations)
        found = {row["name"]: (row["result"], row["by"]) for row in results["mutations"]}
        expected = {
            "noticed": (mutate.CAUGHT, ["looks"]),
            "unnoticed": (mutate.SURVIVED, []),
            "broken": (mutate.DOES_NOT_COMPILE, []),
        }
        self.assertEqual(found, expected)
        self.assertEqual((results["caught"], results["of"], results["share"]), (1, 3, 0.3333))
        self.assertEqual(status, 1)
        self.assertIn("1 of 3 faults are caught (33 %, goal 90 %); not caught: unnoticed, broken", said)
        # Taken out again.
        self.assertEqual((self.folder / "source/value").read_text(), "a good word\n")
        self.assertEqual((self.folder / "source/remark").read_text(), "nice\n")

    def test_goes_on_with_the_same_commit_only(self) -> None:
        status, said, _ = self.run_tool(self.mutations[:1])
        self.assertEqual(status, 0)
        status, said, results = self.run_tool(self.mutations[:2])
        self.assertEqual([line.split()[0] for line in said.splitlines()[:-1]], ["unnoticed"])
        self.assertEqual(results["of"], 2)
        (self.repository / "remark").write_text("nice indeed\n")
        self.commit()
        status, said, results = self.run_tool(self.mutations[:1])
        self.assertEqual([line.split()[0] for line in said.splitlines()[:-1]], ["noticed"])
        self.assertEqual(results["of"], 1)

    def test_refuses_what_would_count_as_caught(self) -> None:
        """Tests that fail without a fault, tests that are not there, texts that are not there once."""
        with self.assertRaisesRegex(mutate.Refused, "no test has a name like nothing"):
            self.run_tool([dataclasses.replace(self.mutations[0], tests="nothing")])
        with self.assertRaisesRegex(mutate.Refused, "'text' occurs 2 times in value"):
            self.run_tool([dataclasses.replace(self.mutations[0], text="d")])
        (self.repository / "value").write_text("a better word, no godo one\n")
        self.commit()
        with self.assertRaisesRegex(mutate.Refused, "tests fail without a fault: looks"):
            self.run_tool([dataclasses.replace(self.mutations[0], text="better")])


if __name__ == "__main__":
    unittest.main()
