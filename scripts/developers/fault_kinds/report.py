"""The rows of scripts/faults, as lines, as JSON and as the page's table."""

import json
from pathlib import Path
from typing import Any

from clepsydra import whole_files
from clepsydra.environment import commit

PAGE = Path(__file__).resolve().parent / "README.md"
BEGIN, END = "<!-- table of faults: made by --page -->\n", "<!-- end of the table -->\n"


def row(kind: Any, seen: Any, wrong: Any, seconds: Any, skipped: Any = None) -> dict[str, Any]:
    tries = sum(seen.values()) + len(wrong)
    if not skipped and tries == 0:
        wrong = ["no try was made, so nothing is shown"]
    observed = [f"{count} x {words}" for words, count in sorted(seen.items(), key=lambda entry: -entry[1])]
    observed += [f"WRONG: {words}" for words in wrong]
    return {
        "fault": kind.name,
        "done": kind.done,
        "tries": tries,
        "expected": kind.expected,
        "observed": f"skipped: {skipped}" if skipped else "; ".join(observed),
        "holds": None if skipped else not wrong,
        "seconds": round(seconds, 1),
        "commit": commit(),
    }


def line(found: Any) -> str:
    verdict = {True: "holds", False: "DOES NOT HOLD", None: "skipped"}[found["holds"]]
    return f"{found['fault']:25} {verdict:14}{found['tries']:4} tries {found['seconds']:6.1f} s  {found['observed']}"


def summary(rows: Any) -> str:
    held = sum(found["holds"] is True for found in rows)
    skipped = sum(found["holds"] is None for found in rows)
    tries = sum(found["tries"] for found in rows)
    return f"{held} of {len(rows)} kinds of fault hold, {skipped} skipped; {tries} tries"


def write(file: Path, rows: Any) -> None:
    whole_files.write(file, json.dumps(rows, indent=1) + "\n")


def write_page(results: Any) -> None:
    """The table of the page, from the results of a run."""
    rows = json.loads(results.read_text())
    text = PAGE.read_text()
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    commits = ", ".join(sorted({found["commit"] for found in rows}))
    table = [
        f"{summary(rows)}; commit {commits}.\n\n",
        "| fault | what is done | what happens | tries |\n|---|---|---|---|\n",
    ]
    table += [f"| `{found['fault']}` | {found['done']} | {found['observed']} | {found['tries']} |\n" for found in rows]
    whole_files.write(PAGE, before + BEGIN + "".join(table) + END + after)
