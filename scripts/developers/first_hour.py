#!/usr/bin/python3
"""Types the commands of the first pages on a bare Debian, line by line, and times each line.

Usage: firstHour --json FILE [--quick] [--page PAGE] [--suite NAME] [--keep FOLDER] [--mirror URL]
       firstHour --list [--quick] [--page PAGE]

Needs root and debootstrap (apt-get install debootstrap). Two systems with Debian's smallest set of packages are
made in folders: one with a clone of this repository's last commit, and one in which only the Debian package is
installed that was built in the first. What a reader does besides the lines is in tests/pages/firstHour.yaml. FILE
receives a list of step, command, seconds and ok, in order. Exit status 1 if a line failed. """

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import yaml

from clepsydra import whole_files
from clepsydra.environment import REPOSITORY, commit
from developers import page_text, shell_typing

TABLE = REPOSITORY / "tests/pages/firstHour.yaml"
KEYS = {"left", "full", "in", "words", "before", "answer"}
# Run in a mount and a process namespace of its own: what is mounted and what is left running goes with it.
ENTER = """set -e
mount -t proc proc "$0/proc"
mount --rbind /dev "$0/dev"
mount --rbind /sys "$0/sys"
cp --dereference --remove-destination /etc/resolv.conf "$0/etc/resolv.conf"
exec chroot "$0" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb \\
    DEBIAN_FRONTEND=noninteractive ${CLEPSYDRA_JOBS:+CLEPSYDRA_JOBS=$CLEPSYDRA_JOBS} "$@"
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", type=Path, metavar="FILE", help="what was typed and how long it took")
    parser.add_argument("--list", action="store_true", help="only say what would be typed")
    parser.add_argument("--quick", action="store_true", help="a small quick hopper; without the lines that take long")
    parser.add_argument("--page", metavar="PAGE", help="only the lines of this page, as README.md")
    parser.add_argument("--suite", default="bookworm", metavar="NAME", help="of Debian, as trixie (%(default)s)")
    parser.add_argument(
        "--keep",
        type=Path,
        metavar="FOLDER",
        help="make the systems in this folder, and keep them there with their logs",
    )
    parser.add_argument(
        "--mirror", default="http://deb.debian.org/debian", metavar="URL", help="where Debian comes from (%(default)s)"
    )
    given = parser.parse_args()
    if given.list == bool(given.json):
        parser.error("either --list or --json FILE")
    parts = [part for part in read_parts(given.quick) if given.page in (None, part["page"])]
    if not parts:
        parser.error(f"--page {given.page}: {TABLE} has no such page")
    if given.list:
        for part in parts:
            print(f"--- {part['page']}, in the {part['root']}'s root, {part['folder']}")
            print(
                "\n".join(
                    line["command"] if "left" not in line else f"# {line['command']}: left out, {line['left']}"
                    for line in part["lines"]
                )
            )
        return
    require_means()
    folder = given.keep or Path(tempfile.mkdtemp(prefix="clepsydra-firstHour-"))
    folder.mkdir(parents=True, exist_ok=True)
    try:
        steps = Hour(folder, given).work(parts)
    finally:
        if not given.keep:
            shutil.rmtree(folder)
    sys.exit(0 if all(step["ok"] for step in steps) else 1)


def read_parts(quick: bool) -> Any:
    """The table's parts with their pages' lines. Exits where the table speaks of a line that its page has not."""
    parts = []
    for part in yaml.safe_load(TABLE.read_text()):
        rows = dict(part.get("rows", {}))
        typed = page_text.typed_lines((REPOSITORY / part["page"]).read_text())
        commands = [command for command, _ in typed]
        for name in (*rows, *filter(None, (part.get("from"), part.get("before")))):
            if name not in commands:
                sys.exit(f"{TABLE}: {part['page']} has no line '{name}'")
        begin = commands.index(part["from"]) if "from" in part else 0
        end = commands.index(part["before"]) if "before" in part else len(commands)
        lines = [line(command, comment, rows.get(command, {}), quick) for command, comment in typed[begin:end]]
        parts.append({"page": part["page"], "root": part["root"], "folder": part["folder"], "lines": lines})
    return parts


def line(command: str, comment: str, row: Any, quick: bool) -> Any:
    unknown = set(row) - KEYS
    if unknown:
        sys.exit(f"{TABLE}: '{command}': unknown '{min(unknown)}'; allowed: {', '.join(sorted(KEYS))}")
    made = {"command": command, "pageSays": comment} | {
        key: value for key, value in row.items() if key not in ("words", "full")
    }
    if quick and "full" in row:
        made["left"] = row["full"]
    for word, by in row.get("words", {}).items():
        if word not in made["command"]:
            sys.exit(f"{TABLE}: no '{word}' in '{command}'")
        made["command"] = made["command"].replace(word, by)
    return made


def require_means() -> None:
    if os.geteuid() != 0:
        sys.exit("firstHour: needs root, which alone may make a root of its own")
    for program, package in (("debootstrap", "debootstrap"), ("git", "git"), ("unshare", "util-linux")):
        if not shutil.which(program):
            sys.exit(f"firstHour: there is no {program} here: apt-get install {package}")


class Hour:
    def __init__(self, folder: Path, given: argparse.Namespace) -> None:
        self.folder, self.given = folder, given
        self.steps: list[dict[str, Any]] = []
        self.roots = {name: folder / name for name in ("repository", "package")}

    def work(self, parts: list[dict[str, Any]]) -> Any:
        self.make_roots()
        for number, part in enumerate(parts):
            if part["root"] == "package" and not (self.roots["package"] / "root/packed").exists():
                self.hand_over()
            with open(self.folder / f"{number}.log", "w") as log:
                enter = [
                    "unshare",
                    "--mount",
                    "--pid",
                    "--fork",
                    "--kill-child",
                    "bash",
                    "-c",
                    ENTER,
                    str(self.roots[part["root"]]),
                ]
                before = len(self.steps)
                for line, seconds, ok in shell_typing.type_lines(enter, part["folder"], part["lines"], log):
                    self.note(part["page"], line["command"], seconds, ok, line)
            if not all(step["ok"] for step in self.steps[before:]):
                print(
                    f"firstHour: what {part['page']}'s lines said:\n"
                    + (self.folder / f"{number}.log").read_text()[-4000:],
                    flush=True,
                )
        return self.steps

    def make_roots(self) -> None:
        suite, root = self.given.suite, self.roots["repository"]
        command = ["debootstrap", "--variant=minbase", suite, root, self.given.mirror]
        start = time.monotonic()
        with open(self.folder / "debootstrap.log", "w") as log:
            ok = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT).returncode == 0
        self.note("a bare Debian", " ".join(map(str, command[:3])), time.monotonic() - start, ok)
        if not ok:
            sys.exit(
                f"firstHour: debootstrap made no root from {self.given.mirror}; is there a network, and a mirror that"
                " answers (--mirror)? It said:\n"
                + "".join((self.folder / "debootstrap.log").read_text().splitlines(keepends=True)[-5:])
            )
        subprocess.run(["cp", "-a", root, self.roots["package"]], check=True)
        self.put_repository(root / "root/clepsydra")

    def put_repository(self, target: Path) -> None:
        start = time.monotonic()
        subprocess.run(["git", "clone", "--quiet", "--no-hardlinks", REPOSITORY, target], check=True)
        self.note(
            "this folder",
            f"git clone, commit {commit()} of {time.strftime('%Y-%m-%d')}, on {os.cpu_count()} cores",
            time.monotonic() - start,
            True,
        )
        if self.given.quick:
            subprocess.run(["bash", "-ec", ". tests/pages/smallHopper"], cwd=target, check=True)

    def hand_over(self) -> None:
        """The package, to the machine that has nothing else."""
        packed = self.roots["repository"] / "root/clepsydra/packed"
        (self.roots["package"] / "root/packed").mkdir()
        for package in packed.glob("clepsydra_*.deb"):
            shutil.copy(package, self.roots["package"] / "root/packed")

    def note(self, step: str, command: str, seconds: float, ok: bool, line: Any = None) -> None:
        entry = {"step": step, "command": command, "seconds": round(seconds, 1), "ok": ok}
        entry |= {key: line[key] for key in ("pageSays", "before", "left") if line and line.get(key)}
        self.steps.append(entry)
        print(
            (
                f"{'left out' if line and 'left' in line else 'ok' if ok else 'FAILED':8} {seconds:7.1f} s  {step}:"
                f" {command}"
            ),
            flush=True,
        )
        whole_files.write(self.given.json, json.dumps(self.steps, indent=1) + "\n")


if __name__ == "__main__":
    main()
