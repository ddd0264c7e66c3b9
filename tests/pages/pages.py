#!/usr/bin/python3
"""Runs the commands of the pages (every *.md of the repository) as a reader does who has just opened a shell.

usage: pages.py table BUILD                 each command of the pages has its row in commands.yaml, each row its
command,
                                            the tests that rows name are tests of BUILD, links within the repository
                                            lead
                                            to files, and README.md has at most 700 words
       pages.py run PAGE BUILD HEADERS [--long]     runs a page's commands; with --long those that take long instead

A command is a line of an indented block, or words in backquotes, that begins with a file of the repository or with a
program (developers/page_text.py). It runs in a copy of the repository, by bash, with HOME, PATH and TERM in its
environment and nothing else. """

import argparse
import json
import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import yaml

from clepsydra.environment import REPOSITORY as ROOT
from developers.page_text import commands, links

TABLE = Path(__file__).with_name("commands.yaml")
WORDS_OF_FRONT_PAGE = 700  # one screen: what is more belongs on the page beside what it describes
KINDS = ("run", "long", "test")
PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    table = commands.add_parser("table")
    table.add_argument("build", type=Path)
    run = commands.add_parser("run")
    run.add_argument("page")
    run.add_argument("build", type=Path)
    run.add_argument("headers", type=Path)
    run.add_argument("--long", action="store_const", const="long", default="run")
    given = parser.parse_args()
    if given.command == "table":
        check_table(given.build)
    else:
        run_page(given.page, given.build, given.headers, given.long)


def pages() -> dict[Any, Any]:
    """Path in the repository -> text. Not the changelog, which names commands of the past."""
    made = re.compile(r"\.dependencies/|build[^/]*/|.*/([^/]*\.work|work|work-quick|runs|steps)/")
    found = sorted(str(path.relative_to(ROOT)) for path in ROOT.rglob("*.md"))
    return {page: (ROOT / page).read_text() for page in found if page != "CHANGELOG.md" and not made.match(page)}


def read_table() -> Any:
    table = yaml.safe_load(TABLE.read_text())
    for page, rows in table.items():
        for command, row in rows.items():
            if len(set(row) & set(KINDS)) != 1:
                raise SystemExit(f"commands.yaml: {page}: '{command}' needs one of {', '.join(KINDS)}")
    return table


def check_table(build: Any) -> None:
    table, wrong = read_table(), []
    registered = registered_tests(build)
    words = len((ROOT / "README.md").read_text().split())
    if words > WORDS_OF_FRONT_PAGE:
        wrong.append(f"README.md: {words} words; allowed: {WORDS_OF_FRONT_PAGE}")
    for page, text in pages().items():
        wrong += [
            f"{page}: its link '{link}' leads to no file"
            for link in links(text)
            if not (ROOT / page).parent.joinpath(link).exists()
        ]
        found, rows = commands(page, text), table.pop(page, {})
        wrong += [f"{page}: '{command}' has no row" for command in found if command not in rows]
        wrong += [f"{page}: '{command}' is not on the page" for command in rows if command not in found]
        wrong += [
            f"{page}: '{command}': there is no test '{test}'"
            for command, row in rows.items()
            for test in row.get("test", [])
            if test not in registered
        ]
    wrong += [f"{page}: is no page" for page in table]
    if wrong:
        raise SystemExit("pages, commands.yaml:\n  " + "\n  ".join(wrong))


def registered_tests(build: Any) -> set[Any]:
    """With those that run in `ctest -C long` only."""
    shown = subprocess.run(
        ["ctest", "--test-dir", build, "-C", "long", "--show-only=json-v1"], check=True, capture_output=True, text=True
    )
    return {test["name"] for test in json.loads(shown.stdout)["tests"]}


def run_page(page: Any, build: Any, headers: Any, kind: Any) -> None:
    rows = read_table()[page]
    with tempfile.TemporaryDirectory(prefix="clepsydra-pages-") as folder:
        home = copy_repository(Path(folder) / "clepsydra")
        link_build(home / "build", build)
        (home / ".dependencies").symlink_to(headers)
        failed = [command for command, row in rows.items() if kind in row and not works(command, row, kind, home, page)]
    if failed:
        raise SystemExit(f"{page}: as documented, these fail: " + "; ".join(failed))


def copy_repository(home: Path) -> Any:
    """The files as they are now, without what git ignores, and a git of their own: some commands ask it what is
    committed."""
    listed = subprocess.run(
        ["git", "-C", ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        check=True,
        capture_output=True,
        text=True,
    ).stdout.split("\0")
    subprocess.run(["git", "clone", "--quiet", "--shared", "--no-checkout", ROOT, home], check=True)
    subprocess.run(["git", "-C", home, "reset", "--quiet"], check=True)
    for name in filter(None, listed):
        if os.path.lexists(ROOT / name):
            (home / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, home / name, follow_symlinks=False)
    return home


def link_build(folder: Path, build: Any) -> None:
    """What was built, as a build that is up to date: scripts/setup must not build again beneath the other tests."""
    folder.mkdir()
    for part in ("bin", "lib"):
        (folder / part).symlink_to(build / part)
    (folder / "CMakeCache.txt").write_text(
        "CMAKE_PROJECT_NAME:STATIC=clepsydra\nCMAKE_GENERATOR:INTERNAL=Ninja\n"
        f"CMAKE_MAKE_PROGRAM:FILEPATH={shutil.which('ninja')}\n"
    )
    (folder / "build.ninja").write_text("build all: phony\nbuild programs: phony\n")
    (folder / "CTestTestfile.cmake").write_text(f'subdirs("{build}")\n')
    (folder / "cmake_install.cmake").touch()  # CMake writes it last: scripts/setup configures where it is missing


def works(command: Any, row: Any, kind: Any, home: Path, page: Any) -> bool:
    """Runs one command: `run`/`long` is the script to run, `{}` in it the command with its `words` replaced."""
    typed = command
    for word, by in row.get("words", {}).items():
        if word not in typed:
            raise SystemExit(f"commands.yaml: {page}: no '{word}' in '{command}'")
        typed = typed.replace(word, by)
    script = row[kind].replace("{}", typed)
    print(f"--- {page}: {command}\n{script}", flush=True)
    outcome = subprocess.run(
        ["bash", "-c", "set -e\n" + script],
        cwd=home / row.get("in", "."),
        text=True,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env={"HOME": os.environ["HOME"], "PATH": PATH, "TERM": "dumb"},
    )
    print(outcome.stdout, flush=True)
    if outcome.returncode != row.get("status", 0):
        print(f"exit status {outcome.returncode}, not {row.get('status', 0)}")
        return False
    if not re.search(row.get("says", ""), outcome.stdout):
        print(f"nothing it says matches '{row['says']}'")
        return False
    return True


if __name__ == "__main__":
    main()
