#!/usr/bin/python3
"""Scores a study on a blind test set: the measured files of candidate conditions are entered as held-out conditions,
and the study is run again from its stored runs. The answer is written before the files are read.

Writes report.json and report.html into results/heldOut in the study's folder, or into the folder of --output. An
existing report is not overwritten. The study file is not changed. """

import argparse
import glob
import json
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import yaml

from clepsydra import environment


def main() -> int:
    """The exit status; 130 where the user has stopped it, as shells have it."""
    try:
        score()
        return 0
    except KeyboardInterrupt:
        print("stopped; the runs that have ended are stored, and the same command goes on from there", file=sys.stderr)
        return 128 + signal.SIGINT


def score() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=Path, metavar="STUDY.yaml")
    parser.add_argument(
        "files",
        nargs="+",
        metavar="CONDITION=FILES",
        help="a candidate of the study, and its measured files: one name or 'pattern*'",
    )
    parser.add_argument("--output", type=Path, metavar="FOLDER", help="default: results/heldOut in the study's folder")
    given = parser.parse_args()
    if any("=" not in one for one in given.files):
        parser.error("CONDITION=FILES: there is no = in it")
    environment.load()
    original = given.study.resolve()
    study = with_files(yaml.safe_load(original.read_text()), dict(one.split("=", 1) for one in given.files))
    output = given.output or original.parent / "results/heldOut"
    if (output / "report.json").exists():
        raise SystemExit(
            f"{output / 'report.json'} exists already and is not overwritten; --output chooses another folder"
        )
    # beside the original, so that its relative paths and stored runs are found
    scored = original.with_name(f".scored.{original.name}")
    scored.write_text(yaml.safe_dump(study, sort_keys=False))
    run(["traceResidual", "run", "--output", str(output), str(scored)])
    report = json.loads((output / "report.json").read_text())
    print(f"{report['study']}: {report['decision']} {report.get('name') or ''}".rstrip())
    for model in ("before", "after", "oneMoreParameter"):
        error = report["heldOut"].get(model)
        if error:
            print(f"{model}: {100 * error['rmsLogError']:.2f} +- {100 * error['standardError']:.2f} %")


def run(command: list[str]) -> None:
    """Where this program is stopped, the other one ends its runs first."""
    with subprocess.Popen(command) as program:
        try:
            status = program.wait()
        except KeyboardInterrupt:
            program.send_signal(signal.SIGINT)
            program.wait()
            raise
    if status != 0:
        raise SystemExit(f"{command[0]} ended with status {status}; nothing is scored")


def with_files(study: dict[str, Any], files: dict[str, str]) -> dict[str, Any]:
    """The study, with the named candidates held out and measured by these files."""
    conditions = {one["name"]: one for one in study["conditions"]}
    for name, pattern in files.items():
        found = sorted(glob.glob(pattern))
        if name not in conditions or conditions[name]["role"] != "candidate":
            candidates = [one for one in conditions if conditions[one]["role"] == "candidate"]
            raise SystemExit(f"no candidate '{name}' in the study; allowed: {', '.join(candidates)}")
        if not found:
            raise SystemExit(f"no file {pattern}")
        conditions[name]["role"] = "heldOut"
        conditions[name]["measured"] = {"files": [str(Path(one).resolve()) for one in found]}
    return study


if __name__ == "__main__":
    raise SystemExit(main())
