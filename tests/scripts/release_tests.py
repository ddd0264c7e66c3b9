#!/usr/bin/python3
"""What surrounds a release agrees with itself: versions, presets, containers, CI, templates, the paper.

usage: release_tests.py [BUILD] [unittest's options]

These files are read by programs that are not here (GitHub, Docker, Apptainer, the paper's typesetter). Each test
reads them as that program does, and fails where a file is missing, empty, or names a script, an option, a preset or
a source that does not exist. With BUILD also the version file that find_package(Clepsydra) reads is tried.

The steps of the containers run for real where CLEPSYDRA_BARE_ROOT names the root of a bare Debian 13 (debootstrap's
minbase, with /proc mounted and a resolv.conf) that may be changed: what is tracked is copied there, and each step runs
by chroot. That takes the time of a whole set-up. """

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 and Path(sys.argv[1]).is_dir() else None
SECTIONS_OF_PAPER = (
    "Summary",
    "Statement of need",
    "State of the field",
    "Software design",
    "Research impact statement",
    "AI usage disclosure",
    "Acknowledgements",
    "References",
)


def read(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def found(pattern: str, name: str) -> str:
    """The first group of the pattern, which the file must hold."""
    match = re.search(pattern, read(name), flags=re.M | re.S)
    if match is None:
        raise AssertionError(f"{name}: nothing matches '{pattern}'")
    return match.group(1)


def project_version() -> str:
    return found(r"project\(Clepsydra\s+VERSION (\S+)", "CMakeLists.txt")


def dockerfile_steps() -> list[str]:
    """The RUN lines, with continued lines joined."""
    joined = re.sub(r"\\\n", " ", re.sub(r"^\s*#.*\n", "", read("Dockerfile"), flags=re.M))
    return re.findall(r"^RUN\s+(.+)$", joined, flags=re.M)


def definition_section(name: str) -> list[str]:
    """Lines of one section of the Apptainer definition, without comments."""
    section = re.search(rf"^%{name}\n((?:(?!%).*\n)*)", read("clepsydra.def"), flags=re.M)
    lines = [line.strip() for line in section.group(1).splitlines()] if section else []
    return [line for line in lines if line and not line.startswith("#")]


def workflow() -> dict:
    return yaml.safe_load(read(".github/workflows/ci.yml"))


def workflow_steps() -> list[str]:
    return [step["run"] for job in workflow()["jobs"].values() for step in job["steps"] if "run" in step]


def scripts_called(step: str) -> list[tuple[str, list[str]]]:
    """(script, its options) of what a step calls from this repository."""
    calls = []
    for command in re.split(r"&&|\|\||;|\n", step):
        typed = shlex.split(command)
        while typed and re.match(r"\w+=", typed[0]):
            typed.pop(0)
        if typed[:1] == ["."]:
            typed.pop(0)
        if typed and re.match(r"(\./)?(scripts|\.ci)/", typed[0]):
            calls.append((typed[0], [word for word in typed[1:] if word.startswith("-")]))
    return calls


class Versions(unittest.TestCase):
    def test_newest_of_changelog_is_the_projects(self) -> None:
        versions = re.findall(
            r"^## \[(\d+\.\d+\.\d+)\] - (unreleased|\d{4}-\d\d-\d\d)$", read("CHANGELOG.md"), flags=re.M
        )
        numbers = [tuple(map(int, version.split("."))) for version, _ in versions]
        self.assertGreater(len(numbers), 1)
        self.assertEqual(numbers, sorted(numbers, reverse=True))
        self.assertEqual(versions[0][0], project_version())
        self.assertNotIn("unreleased", [date for _, date in versions[1:]])

    def test_each_version_says_something(self) -> None:
        for section in read("CHANGELOG.md").split("\n## [")[1:]:
            with self.subTest(section.splitlines()[0]):
                self.assertRegex(section, r"\n### (Added|Changed|Deprecated|Removed|Fixed|Security)\n\n- ")

    def test_citation_is_of_this_version(self) -> None:
        citation = yaml.safe_load(read("CITATION.cff"))
        self.assertEqual(str(citation["version"]), project_version())
        for key in ("cff-version", "message", "title", "authors", "license"):
            self.assertTrue(citation.get(key), key)

    @unittest.skipUnless(BUILD, "no BUILD given")
    def test_python_package_is_of_this_version_and_whole(self) -> None:
        """A module's folder that pyproject.toml does not name would be missing from an installed package."""
        settings = tomllib.loads(read("pyproject.toml"))
        self.assertEqual(found(r'__version__ = "(.*)"', "scripts/clepsydra/__init__.py"), project_version())
        folders = {path.parent.relative_to(ROOT / "scripts") for path in (ROOT / "scripts/clepsydra").rglob("*.py")}
        named = settings["tool"]["setuptools"]["packages"]
        self.assertEqual(sorted(named), sorted(".".join(folder.parts) for folder in folders))

    def test_find_package_takes_newer_minor_versions_only(self) -> None:
        """As find_package reads the version file: the same major version, and at most the installed minor one."""
        major, minor, _ = map(int, project_version().split("."))
        wanted = {f"{major}.0": True, f"{major}.{minor}": True, f"{major}.{minor + 1}": False, f"{major + 1}.0": False}
        if major > 0:
            wanted[f"{major - 1}.9"] = False
        for version, expected in wanted.items():
            with self.subTest(version):
                script = (
                    f'set(PACKAGE_FIND_VERSION {version})\nset(PACKAGE_FIND_VERSION_MAJOR {version.split(".")[0]})\n'
                )
                script += f'set(CMAKE_SIZEOF_VOID_P 8)\ninclude("{BUILD}/generated/ClepsydraConfigVersion.cmake")\n'
                script += 'message(STATUS "compatible:${PACKAGE_VERSION_COMPATIBLE}")\n'
                with tempfile.NamedTemporaryFile("w", suffix=".cmake") as file:
                    file.write(script)
                    file.flush()
                    typed = ["cmake", "-P", file.name]
                    said = subprocess.run(typed, check=True, capture_output=True, text=True).stdout
                self.assertEqual("compatible:TRUE" in said, expected, said)


class Presets(unittest.TestCase):
    def test_cmake_lists_them(self) -> None:
        said = subprocess.run(
            ["cmake", "--list-presets=all"], cwd=ROOT, check=True, capture_output=True, text=True
        ).stdout
        for name in ("release", "developer", "debug", "sanitize"):
            self.assertGreaterEqual(said.count(f'"{name}"'), 2, f"{name} must configure and build")

    def test_options_are_those_of_the_project(self) -> None:
        """A misspelt cache variable is ignored by CMake, with a warning that nobody reads."""
        known = {"CMAKE_BUILD_TYPE"}
        for file in [ROOT / "CMakeLists.txt", *ROOT.glob("cmake/*.cmake"), *ROOT.glob("scripts/cmake/*.cmake")]:
            known |= set(re.findall(r"^option\((\w+)", file.read_text(), flags=re.M))
        presets = {preset["name"]: preset for preset in json.loads(read("CMakePresets.json"))["configurePresets"]}
        for preset in presets.values():
            self.assertLessEqual(set(preset["cacheVariables"]), known, preset["name"])
        self.assertEqual(presets["developer"]["cacheVariables"]["CLEPSYDRA_WERROR"], "ON")
        self.assertEqual(presets["sanitize"]["cacheVariables"]["CLEPSYDRA_SANITIZE"], "ON")
        self.assertEqual(presets["debug"]["cacheVariables"]["CMAKE_BUILD_TYPE"], "Debug")

    def test_git_ignores_their_build_folders(self) -> None:
        for preset in json.loads(read("CMakePresets.json"))["configurePresets"]:
            folder = preset["binaryDir"].replace("${sourceDir}/", "")
            ignored = subprocess.run(["git", "-C", ROOT, "check-ignore", "--quiet", f"{folder}/"])
            self.assertEqual(ignored.returncode, 0, folder)


class Steps(unittest.TestCase):
    """What containers and continuous integration type."""

    def all_calls(self) -> list[tuple[str, str, list[str]]]:
        steps = [("Dockerfile", step) for step in dockerfile_steps()]
        steps += [("clepsydra.def", step) for step in definition_section("post") + definition_section("test")]
        steps += [("ci.yml", step) for step in workflow_steps()]
        return [(file, script, options) for file, step in steps for script, options in scripts_called(step)]

    def test_scripts_exist_and_are_sound(self) -> None:
        calls = self.all_calls()
        self.assertEqual({file for file, *_ in calls}, {"Dockerfile", "clepsydra.def", "ci.yml"})
        for file, script, _ in calls:
            with self.subTest(file=file, script=script):
                path = ROOT / script
                self.assertTrue(path.is_file())
                first = path.read_text(encoding="utf-8").split("\n", 1)[0]
                self.assertTrue(os.access(path, os.X_OK) or path.name == "environment")
                if "python" not in first:
                    subprocess.run(["bash", "-n", path], check=True)

    def test_options_are_known(self) -> None:
        """Each option stands in the script's own --help: a misspelt one would stop the build of an image."""
        options_seen = set()
        for file, script, options in self.all_calls():
            for option in options:
                with self.subTest(file=file, script=script, option=option):
                    said = subprocess.run([ROOT / script, "--help"], check=True, capture_output=True, text=True).stdout
                    self.assertRegex(said, rf"(?<![\w-]){re.escape(option)}(?![\w-])")
                    options_seen.add(option)
        self.assertIn("--programs", options_seen)

    def test_both_containers_set_up_alike(self) -> None:
        docker = [call for step in dockerfile_steps() for call in scripts_called(step)]
        definition = [call for step in definition_section("post") for call in scripts_called(step)]
        self.assertEqual(docker, definition)
        base = found(r"^FROM (\S+)$", "Dockerfile")
        self.assertEqual(base, found(r"^From: (\S+)$", "clepsydra.def"))
        self.assertRegex(base, r"^debian:13\b")

    def test_all_debian_versions_run_what_ci_runs(self) -> None:
        jobs = workflow()["jobs"]
        self.assertEqual(jobs["test"]["strategy"]["matrix"]["debian"], [12, 13])
        self.assertIn(
            ".ci/run", [script for step in jobs["test"]["steps"] for script, _ in scripts_called(step.get("run", ""))]
        )
        for name, job in jobs.items():
            with self.subTest(name):
                self.assertIn("timeout-minutes", job)

    def test_entry_point_of_the_image_starts_programs_in_the_environment(self) -> None:
        """Run here as it stands, with this folder in place of the image's."""
        entry = json.loads(found(r"^ENTRYPOINT (\[[^\n]*\])$", "Dockerfile"))
        entry = [word.replace("/opt/clepsydra", str(ROOT)) for word in entry]
        script = ["bash", "-c", 'echo "$FOAM_ETC|$#|$1"', "x", "two words"]
        said = subprocess.run(
            [*entry, *script], check=True, capture_output=True, text=True, env={"PATH": os.environ["PATH"]}
        ).stdout
        self.assertRegex(said, r"openfoam-1912/etc\|1\|two words")

    def test_docker_leaves_out_what_git_ignores_at_the_top(self) -> None:
        """A build of this machine in the image would be of another path, and CMake would refuse it."""
        ignored = read(".dockerignore").split("\n")
        for folder in (".dependencies", "build", "build-*"):
            self.assertIn(folder, ignored)


@unittest.skipUnless(os.environ.get("CLEPSYDRA_BARE_ROOT"), "CLEPSYDRA_BARE_ROOT is not set")
class InBareRoot(unittest.TestCase):
    """The steps of both containers in a root that has nothing but Debian's minimal packages."""

    root = Path(os.environ.get("CLEPSYDRA_BARE_ROOT", "/nonexistent"))

    def type_in_root(self, step: str) -> str:
        done = subprocess.run(
            ["chroot", self.root, "/bin/sh", "-c", f"cd /opt/clepsydra && {step}"],
            env={"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root"},
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, step + "\n" + done.stdout[-3000:] + done.stderr[-3000:])
        return done.stdout

    def test_steps_build_programs_that_start(self) -> None:
        target = self.root / "opt/clepsydra"
        for name in filter(
            None,
            subprocess.run(
                ["git", "-C", ROOT, "ls-files", "-z"], check=True, capture_output=True, text=True
            ).stdout.split("\0"),
        ):
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target / name, follow_symlinks=False)
        for step in dockerfile_steps():
            self.type_in_root(step)
        # What the image did is what the other container's steps do; its folder is there already.
        self.assertIn("nothing was missing", self.type_in_root("scripts/setup --programs"))
        self.assertIn("DiFeliceDrag", self.type_in_root("; ".join(definition_section("test"))))


class Community(unittest.TestCase):
    def test_issue_forms_are_such_as_github_takes(self) -> None:
        forms = sorted((ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml"))
        self.assertGreaterEqual(len(forms), 3)
        for path in forms:
            form = yaml.safe_load(path.read_text(encoding="utf-8"))
            if path.name == "config.yml":
                self.assertIn("blank_issues_enabled", form)
                continue
            with self.subTest(path.name):
                self.assertTrue(form["name"] and form["description"])
                ids = [element["id"] for element in form["body"] if element["type"] != "markdown"]
                self.assertTrue(ids)
                self.assertEqual(len(ids), len(set(ids)))
                for element in form["body"]:
                    self.assertIn(element["type"], ("markdown", "textarea", "input", "dropdown", "checkboxes"))
                    self.assertTrue(element["attributes"].get("value") or element["attributes"].get("label"))

    def test_guide_names_files_that_exist(self) -> None:
        """Each file to copy or to edit is there; one that the reader makes is called my... or own..."""
        named = re.findall(r"`((?:coupling|identification|tests|solvers|\.github)/[\w./-]+)`", read("CONTRIBUTING.md"))
        existing = [name for name in named if not re.match(r"(my|own)[A-Z]", Path(name).name) or (ROOT / name).exists()]
        self.assertGreater(len(existing), 15)
        for name in existing:
            with self.subTest(name):
                self.assertTrue((ROOT / name).exists())

    def test_guide_tells_how_to_add_each_kind(self) -> None:
        for kind in ("Add a drag law", "Add a force", "Add an effect", "Add a function object"):
            section = found(rf"^## {kind}.*?\n(.*?)(?=^## )", "CONTRIBUTING.md")
            steps = re.findall(r"^\d+\. ", section, flags=re.M)
            self.assertTrue(5 <= len(steps) <= 10, f"{kind}: {len(steps)} steps")


class Paper(unittest.TestCase):
    """The form that the Journal of Open Source Software asks for."""

    def setUp(self) -> None:
        _, header, self.body = read("paper/paper.md").split("---\n", 2)
        self.header = yaml.safe_load(header)
        self.body = re.sub(r"<!--.*?-->", "", self.body, flags=re.S)

    def test_header(self) -> None:
        for key in ("title", "tags", "authors", "affiliations", "date", "bibliography"):
            self.assertTrue(self.header.get(key), key)
        indices = {str(affiliation["index"]) for affiliation in self.header["affiliations"]}
        for author in self.header["authors"]:
            self.assertLessEqual(set(re.split(r",\s*", str(author["affiliation"]))), indices)
        self.assertTrue((ROOT / "paper" / self.header["bibliography"]).is_file())

    def test_sections_and_length(self) -> None:
        sections = re.findall(r"^# (.+)$", self.body, flags=re.M)
        self.assertLessEqual(set(SECTIONS_OF_PAPER), set(sections))
        words = len(self.body.split())
        self.assertTrue(750 <= words <= 1750, f"{words} words")

    def test_each_reference_is_cited_and_has_a_doi(self) -> None:
        bibliography = read("paper/paper.bib")
        entries = dict(re.findall(r"^@\w+\{(\w+),\n(.*?)^\}", bibliography, flags=re.M | re.S))
        self.assertEqual(set(re.findall(r"@(\w+)", self.body)), set(entries))
        for key, fields in entries.items():
            with self.subTest(key):
                self.assertRegex(fields, r"doi\s*=\s*\{10\.\d{4,}/\S+\}")


if __name__ == "__main__":
    unittest.main()
