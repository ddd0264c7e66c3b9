#!/usr/bin/python3
"""Throws damaged and hostile text at everything that reads users' files, and looks for crashes, hangs and sanitizers'
reports.

Usage: fuzz [--seconds N] [--json FILE] [--build FOLDER] [--build-only] [TARGET ...]

Each TARGET (default: all) first reads every file of TARGET in tests/fuzz/found.zip, where the findings of earlier runs
are kept, and then mutations of the repository's own files for N seconds (default 60; with 0, the earlier findings
only). Inputs that reached new code are kept in FOLDER/corpus (default FOLDER: build-fuzz), from which the next run
continues. --json adds the numbers to FILE. Findings are in FOLDER/found. Exit status 1 if anything was found, 77 if
clang cannot build fuzzers. """

import argparse
import sys
from pathlib import Path
from typing import Any

from clepsydra.environment import REPOSITORY
from developers.fuzzing import builds, table, targets

CANNOT_BUILD = 77


def main() -> Any:
    options = parsed(sys.argv[1:])
    if not builds.fuzzers_can_be_built():
        print("fuzz: clang++ cannot build fuzzers here; scripts/setup installs what it needs (clang, libclang-rt-dev)")
        return CANNOT_BUILD
    builds.build(options.build, options.targets)
    if options.build_only:
        return 0
    rows = [targets.run(name, options.build, options.seconds) for name in options.targets]
    print(table.text(rows))
    if options.json:
        table.add_to(options.json, rows)
    return 1 if any(row["findings"] for row in rows) else 0


def parsed(arguments: Any) -> Any:
    parser = argparse.ArgumentParser(
        usage=__doc__.split("\n\n")[1][len("Usage: ") :],
        description="\n\n".join(__doc__.split("\n\n")[::2]),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--seconds", type=int, default=60, help="time for each target (%(default)d)")
    parser.add_argument("--json", type=Path, help="add the numbers to this file")
    parser.add_argument("--build", type=Path, default=REPOSITORY / "build-fuzz", help="build folder (build-fuzz)")
    parser.add_argument("--build-only", action="store_true", help="build the fuzzers and do not run them")
    parser.add_argument("targets", nargs="*", metavar="TARGET", help=", ".join(targets.TARGETS))
    options = parser.parse_args(arguments)
    for name in options.targets:
        if name not in targets.TARGETS:
            parser.error(f"there is no target '{name}'; allowed: {', '.join(targets.TARGETS)}")
    options.targets = options.targets or list(targets.TARGETS)
    options.build = options.build.resolve()
    return options


if __name__ == "__main__":
    sys.exit(main())
