#!/usr/bin/python3
"""Prints what was measured, what the paper simulated and what we find, with the residual.

usage: compare [--json FILE] [GROUP ...]       all groups unless named

Exit status 0: every group has its runs, and what is claimed of them holds. A residual, however large, is no failure.
"""

import argparse
import json
import sys
from pathlib import Path
from typing import Any

import comparisons
import series

from clepsydra import whole_files


def main() -> int:
    options = read_options()
    rows, problems = [], []
    for name in options.groups:
        print(f"{name}: {comparisons.GROUPS[name].__doc__}")
        try:
            found = comparisons.GROUPS[name]()
        except (series.MissingRuns, comparisons.ClaimFailed) as problem:
            print(f"  {problem}")
            problems.append(f"{name}: {problem}")
            continue
        rows += found
        print(comparisons.table(found) + "\n")
    if options.json:
        options.json.parent.mkdir(parents=True, exist_ok=True)
        whole_files.write(options.json, json.dumps(rows, indent=2) + "\n")
    for one in problems:
        print(f"compare: {one}", file=sys.stderr)
    return 1 if problems else 0


def read_options() -> Any:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("groups", metavar="GROUP", nargs="*", help=", ".join(comparisons.GROUPS))
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the rows as a list of objects")
    options = parser.parse_args()
    for name in options.groups:
        if name not in comparisons.GROUPS:
            parser.error(f"no group '{name}'; there are: {', '.join(comparisons.GROUPS)}")
    options.groups = options.groups or list(comparisons.GROUPS)
    return options


if __name__ == "__main__":
    sys.exit(main())
