#!/usr/bin/python3
"""Checks a case's file `parameters` by the rules in its file parameters.rules, whose form case_rules.py describes."""

import argparse
import sys
from pathlib import Path

from clepsydra import case_rules


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", metavar="FILE", type=Path, help="the case's `parameters`")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks of the run that is to be started (%(default)s)")
    parser.add_argument(
        "--part", default="all", help="what is to be run: mesh, the name of a step, or all (%(default)s)"
    )
    parser.add_argument("--report", action="store_true", help="print the quantities derived from the parameters, too")
    options = parser.parse_args()
    return case_rules.report(options.file, options.ranks, options.part, options.report)


if __name__ == "__main__":
    sys.exit(main())
