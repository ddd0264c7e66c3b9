"""Rows of the validation table: what a case compares, and how well it holds.

A case of cases/validation writes results/rows.json by `write`; scripts/validate collects them.
"""

import json
from pathlib import Path

KINDS = ("measured", "computed", "otherCode")


def row(quantity, unit, reference, source, kind, ours, uncertainty, tolerancePercent, finding=None):
    """One comparison.

    kind: what the reference is - measured by somebody, computed from a closed formula, or the result of another code.
    uncertainty: one standard error of the comparison, in `unit`: ours and the reference's together.
    tolerancePercent: fixed before the result was seen, from what the model and the measurement can be expected to give.
    finding: why a row that does not hold is a result and not a fault. Without it a row that does not hold is a failure.
    """
    if kind not in KINDS:
        raise ValueError(f"kind '{kind}' of '{quantity}': allowed are {', '.join(KINDS)}")
    error = 100 * (ours - reference) / reference if reference else float("inf") * (ours != 0)
    found = {"quantity": quantity, "unit": unit, "reference": reference, "source": source, "kind": kind, "ours": ours,
             "uncertainty": uncertainty, "errorPercent": round(error, 3), "tolerancePercent": tolerancePercent,
             "holds": bool(abs(error) <= tolerancePercent)}
    if finding:
        found["finding"] = finding
    return found


def write(rows, case=Path(".")):
    """results/rows.json of a case, each row with the case's name."""
    case = Path(case).resolve()
    results = case / "results"
    results.mkdir(exist_ok=True)
    named = [{"case": case.name} | found for found in rows]
    (results / "rows.json").write_text(json.dumps(named, indent=2) + "\n")


def table(rows):
    """The rows as lines of text."""
    def value(number):
        return f"{number:.4g}"

    head = ("case", "quantity", "unit", "reference", "ours", "+-", "error %", "allowed %", "holds", "kind")
    lines = [head] + [
        (found["case"], found["quantity"], found["unit"], value(found["reference"]), value(found["ours"]),
         value(found["uncertainty"]), f"{found['errorPercent']:+.2f}", value(found["tolerancePercent"]),
         "yes" if found["holds"] else "finding" if "finding" in found else "NO", found["kind"]) for found in rows]
    widths = [max(len(line[column]) for line in lines) for column in range(len(head))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in lines)
