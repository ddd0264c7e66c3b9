#!/usr/bin/python3
"""Injects faults of disks, systems and users into a small run, a parameter study and a study of traceResidual. After
each fault, a run must end with a message or resume with the results of an undisturbed run.

Usage: faults [--quick] [--json FILE] [--keep] [NAME ...]

Without NAME, all kinds of fault are tried; with --quick a selection, in a minute. Each kind is tried several times
and compared with an undisturbed run. Prints a line per kind; exit status 1 if one of them fails. A fault that
cannot be made on this machine is skipped, with the reason. --page writes the table of a JSON file into the page. """

import argparse
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from clepsydra import environment
from developers.fault_kinds import (
    damage,
    disk,
    going_on,
    limits,
    parallel,
    parameter_studies,
    report,
    shell,
    stops,
    studies,
    system_calls,
)
from developers.fault_kinds.bench import Bench
from developers.fault_kinds.kinds import ALL, Fault, Skipped, Wrong

IN_NAMESPACE = "CLEPSYDRA_FAULTS_MAY_MOUNT"
# In the order of the table. Each module enters its kinds of fault into ALL when it is imported.
MODULES = (stops, parallel, disk, system_calls, damage, going_on, limits, parameter_studies, studies, shell)
KINDS = {name: kind for module in MODULES for name, kind in ALL.items() if kind.tries.__module__ == module.__name__}


def main() -> int:
    options = read_options()
    if options.page:
        report.write_page(options.page)
        return 0
    enter_namespace()
    environment.load()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    # A shell starts what runs in the background with SIGINT ignored, and the runs would inherit that.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    folder = Path(tempfile.mkdtemp(prefix="clepsydraFaults."))
    bench = Bench(folder, options.quick, may_mount=bool(os.environ[IN_NAMESPACE]))
    rows = []
    try:
        for name in options.names or [name for name, kind in KINDS.items() if kind.in_quick or not options.quick]:
            rows.append(tried(KINDS[name], bench, options.keep))
            print(report.line(rows[-1]), flush=True)
            if options.json:  # after each: it may be interrupted
                report.write(options.json, rows)
    finally:
        bench.kill_all()
        if not options.keep:
            bench.clean()
            shutil.rmtree(folder, ignore_errors=True)
    print(report.summary(rows))
    return 0 if all(row["holds"] is not False for row in rows) else 1


def read_options() -> Any:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(KINDS))
    parser.add_argument("--quick", action="store_true", help="a selection of kinds and tries, in a minute")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the results to this file")
    parser.add_argument("--keep", action="store_true", help="keep the folders of all tries")
    parser.add_argument(
        "--page", type=Path, metavar="FILE", help="only write the table of this JSON file into the page"
    )
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in KINDS]
    if unknown:
        parser.error(f"no fault {' '.join(unknown)}; there are: {', '.join(KINDS)}")
    return options


def enter_namespace() -> None:
    """Where the system allows it: mounts made here are nobody else's, and vanish with this program."""
    if IN_NAMESPACE in os.environ:
        return
    unshare = ["unshare", "--mount"] + ["--map-root-user"] * (os.geteuid() != 0)
    allowed = shutil.which("unshare") and subprocess.run([*unshare, "true"], stderr=subprocess.DEVNULL).returncode == 0
    os.environ[IN_NAMESPACE] = "yes" if allowed else ""
    if allowed:
        os.execvp(unshare[0], [*unshare, sys.executable, *sys.argv])


def tried(kind: Fault, bench: Bench, keep: bool) -> dict[str, Any]:
    """Makes the fault as often as it says, and counts what was seen."""
    seen: dict[str, int] = {}
    wrong: list[str] = []
    began = time.monotonic()
    try:
        tries = kind.tries(bench)
    except Skipped as reason:
        return report.row(kind, {}, [], 0, skipped=str(reason))
    for attempt in tries:
        try:
            words = attempt()
            seen[words] = seen.get(words, 0) + 1
        except Skipped as reason:
            return report.row(kind, {}, [], 0, skipped=str(reason))
        except Wrong as found:
            wrong.append(str(found))
        finally:
            bench.kill_all()
            if not keep:
                bench.clean()
    return report.row(kind, seen, wrong, time.monotonic() - began)


if __name__ == "__main__":
    sys.exit(main())
