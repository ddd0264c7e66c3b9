#!/usr/bin/python3
"""Runs the validation cases and prints one table of what was expected and what came out.

Exit status 0: every case ran, every row agrees with its reference or is the finding that is recorded
(cases/validation/results.json, quickResults.json), each case has recorded rows and none of them is missing. 77: no case
could run here, for want of another program. """

import argparse
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

from clepsydra import environment, validation, whole_files

CASES = environment.REPOSITORY / "cases" / "validation"
LEFT_OUT = 77  # exit status of an Allrun that lacks another program


def main() -> int:
    options = read_options()
    status = {case.name: run(case, options.quick) for case in options.cases}
    failed = [name for name in status if status[name] not in (0, LEFT_OUT)]
    done = [name for name in status if status[name] == 0]
    rows = [found for name in done for found in json.loads((CASES / name / "results" / "rows.json").read_text())]
    record = CASES / ("quickResults.json" if options.quick else "results.json")
    recorded = json.loads(record.read_text()) if record.exists() else []
    if options.record:
        recorded = [found for found in recorded if found["case"] not in done] + rows
    validation.judge(rows, recorded)
    print(validation.table(rows))
    findings = sorted({f"{found['case']}: {found['finding']}" for found in rows if "finding" in found})
    print("".join(f"\nfinding - {finding}" for finding in findings))
    if options.json:
        whole_files.write(options.json, json.dumps(rows, indent=2) + "\n")
    for name in failed:
        print(f"validate: {name} did not run to its end", file=sys.stderr)
    wrong = [validation.complaint(found) for found in rows if not found["holds"]]
    wrong += validation.missing(rows, [found for found in recorded if found["case"] in done])
    wrong += validation.unrecorded(done, recorded)
    for complaint in wrong:
        print(f"validate: {complaint}", file=sys.stderr)
    if failed or wrong:
        return 1
    if options.record:
        whole_files.write(record, json.dumps(recorded, indent=2) + "\n")
    return 0 if done else LEFT_OUT


def read_options() -> Any:
    known = sorted(path.parent for path in CASES.glob("*/Allrun"))
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("cases", nargs="*", metavar="CASE", help="all of cases/validation unless named")
    parser.add_argument("--quick", action="store_true", help="the small version of each case, seconds to a minute")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the rows as a list of objects")
    parser.add_argument(
        "--record", action="store_true", help="take the findings as they are now for those to be expected from now on"
    )
    options = parser.parse_args()
    for name in options.cases:
        if CASES / name not in known:
            parser.error(f"no case '{name}'; there are: {', '.join(case.name for case in known)}")
    options.cases = [CASES / name for name in options.cases] or known
    return options


def run(case: Path, quick: bool) -> int:
    """Exit status of the case's Allrun."""
    print(f"--- {case.name}", flush=True)
    return subprocess.run([case / "Allrun"] + ["--quick"] * quick).returncode


if __name__ == "__main__":
    sys.exit(main())
