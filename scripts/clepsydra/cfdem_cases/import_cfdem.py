#!/usr/bin/python3
"""Converts a case of CFDEMcoupling into one of pimpleDemFoam, and reports which entries have another meaning here,
which are left out, and why.

An entry of the old case that has no counterpart is an error, and nothing is written, unless --without names it.
"""

import argparse
import sys
from pathlib import Path

from clepsydra.cfdem_cases import foam_text
from clepsydra.cfdem_cases.case_import import import_case


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", type=Path, metavar="CASE", help="the old case: a folder with CFD/ and DEM/")
    parser.add_argument("target", type=Path, metavar="TARGET", help="the new case, a folder that is not there yet")
    parser.add_argument(
        "--without",
        action="append",
        default=[],
        metavar="ENTRY",
        help="leave out what would be an error; may be given several times",
    )
    options = parser.parse_args()
    try:
        report = import_case(options.case, options.target, options.without)
    except foam_text.FoamError as problem:
        sys.exit(f"importCfdem: {problem}")
    print("\n".join(report.lines()))
    for where, what, why in report.errors:
        print(f"importCfdem: {where + ': ' if where else ''}{what}: {why}", file=sys.stderr)
    if report.errors:
        sys.exit(
            f"importCfdem: {len(report.errors)} errors; nothing was written. Fix the old case, or name entries with"
            " --without"
        )
    print(f"\nWritten: {options.target}. Next: . scripts/environment; {options.target}/Allrun")


if __name__ == "__main__":
    main()
