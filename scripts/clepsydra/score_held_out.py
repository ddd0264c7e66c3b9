#!/usr/bin/python3
"""Scores a study on a blind test set: the measured files of candidate conditions are entered as held-out conditions,
and the study is run again from its stored runs. The answer is written before the files are read.

Writes STUDY's folder/results/heldOut/report.json and .html. The study file is not changed. """

import argparse
import glob
import json
import subprocess
from pathlib import Path
from typing import Any

import yaml

from clepsydra import environment


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=Path, metavar="STUDY.yaml")
    parser.add_argument(
        "files",
        nargs="+",
        metavar="CONDITION=FILES",
        help="a candidate of the study, and its measured files: one name or 'pattern*'",
    )
    given = parser.parse_args()
    if any("=" not in one for one in given.files):
        parser.error("CONDITION=FILES: there is no = in it")
    environment.load()
    original = given.study.resolve()
    study = with_files(yaml.safe_load(original.read_text()), dict(one.split("=", 1) for one in given.files))
    # beside the original, so that its relative paths and stored runs are found
    scored = original.with_name(f".scored.{original.name}")
    scored.write_text(yaml.safe_dump(study, sort_keys=False))
    output = original.parent / "results/heldOut"
    subprocess.run(["traceResidual", "run", "--output", output, scored], check=True)
    report = json.loads((output / "report.json").read_text())
    print(f"{report['study']}: {report['decision']} {report.get('name') or ''}".rstrip())
    for model in ("before", "after", "oneMoreParameter"):
        error = report["heldOut"].get(model)
        if error:
            print(f"{model}: {100 * error['rmsLogError']:.2f} +- {100 * error['standardError']:.2f} %")


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
    main()
