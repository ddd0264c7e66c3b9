"""The numbers of runs, as text and as a file that sums them up."""

import datetime
import json
import subprocess
from pathlib import Path
from typing import Any

from clepsydra import whole_files
from clepsydra.environment import REPOSITORY

#: What is added up where the same target was run at the same commit before.
SUMMED = ("executions", "seconds", "findings")


def text(rows: list[dict[str, Any]]) -> str:
    lines = [f"{'target':20}{'executions':>12}{'seconds':>9}{'edges':>14}{'former finds':>14}{'findings':>10}"]
    for row in rows:
        lines.append(
            f"{row['target']:20}{row['executions']:12d}{row['seconds']:9d}"
            f"{row['edgesReached']:7d}/{row['edges']:6d}{row['formerFinds']:14d}{row['findings']:10d}"
        )
    return "\n".join(lines)


def add_to(file: Path, rows: list[dict[str, Any]]) -> None:
    known = json.loads(file.read_text())["runs"] if file.exists() else []
    for row in rows:
        row = {**row, "commit": commit(), "date": datetime.date.today().isoformat()}
        same = next((old for old in known if (old["target"], old["commit"]) == (row["target"], row["commit"])), None)
        if same:
            row.update({key: same[key] + row[key] for key in SUMMED})
            known.remove(same)
        known.append(row)
    total = {key: sum(row[key] for row in known) for key in SUMMED}
    whole_files.write(file, json.dumps({"total": total, "runs": known}, indent=1) + "\n")


def commit() -> str:
    """Of what was run; the file of numbers, which every run changes, makes it no other."""
    changed = lines(
        "status", "--porcelain", "--untracked-files=no", "--", ":(top)", ":(top,exclude)tests/fuzz/executions.json"
    )
    return lines("rev-parse", "--short=12", "HEAD")[0] + ("-dirty" if changed else "")


def lines(*command: Any) -> list[str]:
    done = subprocess.run(["git", "-C", REPOSITORY, *command], stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout.splitlines()
