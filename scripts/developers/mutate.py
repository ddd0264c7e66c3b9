#!/usr/bin/python3
"""Puts one fault after another into the program, each a change of a few words, and looks whether the tests notice.

Usage: mutate [--list] [--only NAME ...] [--json FILE] [--folder FOLDER] [--processes N] [--mutations FILE]

The faults are those of scripts/developers/mutations.yaml. They are put into a clone of the last commit in FOLDER
(default: a temporary folder), which is built there; what is uncommitted is not seen. A FOLDER that is given is kept,
so that the next call compiles only what has changed. First the tests are run without a fault, and all must pass. Then
each fault is put in, its targets are built and its tests are run. It is caught where a test fails.

--json writes the result of each fault to FILE, and a fault that FILE has from the same commit is not tried again.
Exit status 0 where at least 90 % of the faults are caught, 1 where fewer are or one does not compile, 2 where the list
is wrong or the tests fail without a fault. """

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from clepsydra import whole_files
from clepsydra.environment import REPOSITORY

LIST = Path(__file__).resolve().parent / "mutations.yaml"
GOAL = 0.9
ENTRIES = ("name", "file", "text", "replacement", "targets", "tests", "shows")
TOO_LONG = 1800  # s: tests of one fault that run for longer hang

CAUGHT, SURVIVED, DOES_NOT_COMPILE = "caught", "survived", "does not compile"


class Refused(Exception):
    """Why the faults cannot be tried."""


@dataclass(frozen=True)
class Mutation:
    """One fault: in a file, a text that occurs there once is replaced by another one."""

    name: str
    file: str
    text: str
    replacement: str
    targets: list[str]  # to build
    tests: str  # regular expression: names of the tests that should fail
    shows: str  # what goes wrong with this fault

    def problem(self, root: Path) -> str | None:
        """Why the fault cannot be put into the files below this folder; None where it can."""
        if not (root / self.file).is_file():
            return f"{self.name}: there is no file {self.file}"
        count = (root / self.file).read_text().count(self.text)
        if count != 1:
            return f"{self.name}: 'text' occurs {count} times in {self.file}; allowed: once"
        return f"{self.name}: 'replacement' is 'text' itself" if self.text == self.replacement else None


def main() -> int:
    options = read_options()
    try:
        mutations = chosen(read(options.mutations), options.only)
        if options.list:
            print("\n".join(f"{mutation.name:32} {mutation.file:58} {mutation.tests}" for mutation in mutations))
            return 0
        if options.folder:
            options.folder.mkdir(parents=True, exist_ok=True)
            return tried(mutations, Workshop(options.folder.resolve(), options.processes), options.json)
        with tempfile.TemporaryDirectory(prefix="clepsydraMutate.") as folder:
            return tried(mutations, Workshop(Path(folder), options.processes), options.json)
    except Refused as reason:
        print(f"mutate: error: {reason}", file=sys.stderr)
        return 2


def read_options() -> Any:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help="print the faults and end")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="try these faults only")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the results; go on where FILE ends")
    parser.add_argument("--folder", type=Path, metavar="FOLDER", help="of the clone and its build")
    parser.add_argument("--processes", type=int, metavar="N", default=len(os.sched_getaffinity(0)))
    parser.add_argument("--mutations", type=Path, metavar="FILE", default=LIST, help="another list of faults")
    return parser.parse_args()


def read(file: Path) -> list[Mutation]:
    """The faults of a list, each entry of which must be complete."""
    mutations = []
    for entry in yaml.safe_load(file.read_text()):
        if sorted(entry) != sorted(ENTRIES):
            raise Refused(f"{file.name}: entry {entry.get('name')} has {sorted(entry)}; allowed: {sorted(ENTRIES)}")
        mutations.append(Mutation(**entry))
    names = [mutation.name for mutation in mutations]
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated:
        raise Refused(f"{file.name}: the name {repeated[0]} is there twice; allowed: once")
    return mutations


def chosen(mutations: list[Mutation], names: list[str] | None) -> list[Mutation]:
    unknown = sorted(set(names or []) - {mutation.name for mutation in mutations})
    if unknown:
        raise Refused(f"there is no fault {', '.join(unknown)}; --list prints all")
    return [mutation for mutation in mutations if not names or mutation.name in names]


class Workshop:
    """A clone of the last commit and its build, in which faults are put in and taken out."""

    def __init__(self, folder: Path, processes: int, repository: Path = REPOSITORY) -> None:
        self.source = folder / "source"
        self.build = folder / "build"
        self.processes = str(processes)
        self.said = ""
        self.commit = output(["git", "-C", str(repository), "rev-parse", "HEAD"])
        if not (self.source / ".git").exists():
            run(["git", "clone", "--quiet", "--shared", "--no-checkout", str(repository), str(self.source)])
        run(["git", "-C", str(self.source), "fetch", "--quiet", str(repository), "HEAD"])
        run(["git", "-C", str(self.source), "checkout", "--quiet", "--force", "--detach", self.commit])
        # What the environment of this checkout has set must not lead the tests to its own build.
        self.environment = os.environ | {"CLEPSYDRA": str(self.source), "CLEPSYDRA_BUILD": str(self.build)}
        dependencies = os.environ.get("CLEPSYDRA_DEPENDENCIES", str(repository / ".dependencies"))
        self.environment["CLEPSYDRA_DEPENDENCIES"] = dependencies

    def configure(self) -> None:
        command: list[str | Path] = [
            "cmake",
            "-G",
            "Ninja",
            "-S",
            self.source,
            "-B",
            self.build,
            "-D",
            "CMAKE_BUILD_TYPE=Release",
        ]
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        if done.returncode != 0:
            raise Refused("cmake fails in the clone: " + done.stderr[-2000:])

    def compiles(self, targets: list[str]) -> bool:
        if not targets:  # a script; without a target ninja would build everything
            return True
        command: list[str | Path] = ["ninja", "-C", self.build, "-j", self.processes, *targets]
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        if done.returncode != 0 and "unknown target" in done.stderr:
            raise Refused(done.stderr.strip())
        self.said = done.stdout[-3000:]
        return done.returncode == 0

    def has_tests(self, tests: str) -> bool:
        command: list[str | Path] = ["ctest", "--test-dir", self.build, "--show-only", "-R", tests]
        listed = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        return "Total Tests: 0" not in listed.stdout

    def failing_tests(self, tests: str) -> list[str]:
        """Names of the tests that fail, by ctest and, where one is a whole program of GoogleTest, by that."""
        command: list[str | Path] = ["ctest", "--test-dir", self.build, "-j", self.processes, "-R", tests]
        command += ["--no-tests=error", "--output-on-failure"]
        try:
            done = subprocess.run(
                command, env=self.environment, capture_output=True, text=True, errors="replace", timeout=TOO_LONG
            )
        except subprocess.TimeoutExpired:
            return [f"none of {tests} has ended within {TOO_LONG} s"]
        return failures(done.stdout) if done.returncode != 0 else []

    def with_fault(self, mutation: Mutation) -> dict[str, Any]:
        """Puts a fault in, tests, and takes it out again."""
        file = self.source / mutation.file
        original = file.read_text()
        began = time.monotonic()
        try:
            file.write_text(original.replace(mutation.text, mutation.replacement))
            failed = self.failing_tests(mutation.tests) if self.compiles(mutation.targets) else None
        finally:
            file.write_text(original)
        result = DOES_NOT_COMPILE if failed is None else CAUGHT if failed else SURVIVED
        return {
            "name": mutation.name,
            "file": mutation.file,
            "shows": mutation.shows,
            "result": result,
            "by": failed or [],
            "seconds": round(time.monotonic() - began, 1),
            "commit": self.commit,
        }


def failures(text: str) -> list[str]:
    """Names of failed tests in the output of ctest."""
    of_ctest = re.findall(r"^\s*\d+ - (\S+) \([^)]+\)", text, re.M)
    of_googletest = re.findall(r"^\s*(?:\d+: )?\[  FAILED  \] ([\w/]+\.[\w/]+)", text, re.M)
    return list(dict.fromkeys(of_ctest + of_googletest)) or ["ctest itself"]


def tried(mutations: list[Mutation], workshop: Workshop, file: Path | None) -> int:
    problems = [problem for mutation in mutations if (problem := mutation.problem(workshop.source))]
    if problems:
        raise Refused("\n".join(["faults cannot be put into the last commit", *problems]))
    rows = finished(file, workshop.commit)
    left = [mutation for mutation in mutations if mutation.name not in {row["name"] for row in rows}]
    if left:
        workshop.configure()
        require_that_tests_pass(workshop, left)
    for mutation in left:
        rows.append(workshop.with_fault(mutation))
        print(line(rows[-1]), flush=True)
        if rows[-1]["result"] == DOES_NOT_COMPILE:
            print(workshop.said, file=sys.stderr)
        if file:  # after each: the run may be interrupted
            write(file, workshop.commit, rows)
    print(summary(rows))
    names = {mutation.name for mutation in mutations}
    return 0 if is_enough([row for row in rows if row["name"] in names]) else 1


def require_that_tests_pass(workshop: Workshop, mutations: list[Mutation]) -> None:
    """A test that fails anyway would count as one that has caught every fault."""
    if not workshop.compiles(sorted({target for mutation in mutations for target in mutation.targets})):
        raise Refused("the last commit does not compile: " + workshop.said)
    tests = sorted({mutation.tests for mutation in mutations})
    for one in tests:
        if not workshop.has_tests(one):
            raise Refused(f"no test has a name like {one}")
    failed = workshop.failing_tests("|".join(tests))
    if failed:
        raise Refused("tests fail without a fault: " + ", ".join(failed))


def finished(file: Path | None, commit: str) -> list[dict[str, Any]]:
    """Results of an earlier call on the same commit."""
    if not file or not file.exists():
        return []
    return [row for row in json.loads(file.read_text())["mutations"] if row["commit"] == commit]


def write(file: Path, commit: str, rows: list[dict[str, Any]]) -> None:
    content = {
        "commit": commit,
        "caught": count(rows, CAUGHT),
        "of": len(rows),
        "share": share(rows),
        "mutations": rows,
    }
    whole_files.write(file, json.dumps(content, indent=1) + "\n")


def count(rows: list[dict[str, Any]], result: str) -> int:
    return sum(row["result"] == result for row in rows)


def share(rows: list[dict[str, Any]]) -> float:
    return round(count(rows, CAUGHT) / max(1, len(rows)), 4)


def is_enough(rows: list[dict[str, Any]]) -> bool:
    return share(rows) >= GOAL and count(rows, DOES_NOT_COMPILE) == 0


def line(row: dict[str, Any]) -> str:
    by = row["by"][:3] + ["..."] * (len(row["by"]) > 3)
    return f"{row['name']:32} {row['result']:17}{row['seconds']:7.1f} s  {', '.join(by)}"


def summary(rows: list[dict[str, Any]]) -> str:
    survived = [row["name"] for row in rows if row["result"] != CAUGHT]
    text = (
        f"{count(rows, CAUGHT)} of {len(rows)} faults are caught ({100 * share(rows):.0f} %, goal {100 * GOAL:.0f} %)"
    )
    return text + (f"; not caught: {', '.join(survived)}" if survived else "")


def run(command: list[str]) -> None:
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise Refused(f"{' '.join(command)}: {done.stderr.strip()}")


def output(command: list[str]) -> str:
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


if __name__ == "__main__":
    sys.exit(main())
