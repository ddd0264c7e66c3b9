"""Rows of the validation table: what a case compares, and how well it holds.

A case of cases/validation writes results/rows.json by `write`; scripts/validate collects them, and `judge` holds them
against what is recorded. """

import json
from math import hypot
from pathlib import Path
from typing import Any

from clepsydra import whole_files

KINDS = ("measured", "computed", "otherCode")
# A finding may differ from the recorded one by so many standard errors of the two,
ALLOWED_ERRORS = 3
# and by what a page's tenth of a percent does not show: linear solvers' tolerances, compilers.
SHOWN_PERCENT = 0.1


def row(
    quantity: str,
    unit: str,
    reference: float,
    source: str,
    kind: str,
    ours: float,
    uncertainty: float,
    tolerance_percent: float,
    finding: str | None = None,
    repeats: float | None = None,
) -> dict[str, Any]:
    """One comparison. `quantity` names it, once in its case.

    kind: what the reference is - measured by somebody, computed from a closed formula, or the result of another code.
    uncertainty: one standard error of the comparison, in `unit`: ours and the reference's together.
    tolerancePercent: fixed before the result was seen, from what the model and the measurement can be expected to give.
    finding: why a row that does not agree with its reference is a result and not a fault. Without it, it is a fault.
    repeats: one standard error of ours alone, as by another packing or another part of the time; `uncertainty` unless
        given.
    """
    if kind not in KINDS:
        raise ValueError(f"kind '{kind}' of '{quantity}': allowed are {', '.join(KINDS)}")
    found = {
        "quantity": quantity,
        "unit": unit,
        "reference": reference,
        "source": source,
        "kind": kind,
        "ours": ours,
        "uncertainty": uncertainty,
        "repeats": uncertainty if repeats is None else repeats,
        "errorPercent": round(percent(ours, reference), 3),
        "tolerancePercent": tolerance_percent,
        "agrees": bool(abs(percent(ours, reference)) <= tolerance_percent),
    }
    if finding and not found["agrees"]:
        found["finding"] = finding
    return found


def percent(ours: float, reference: float) -> float:
    return 100 * (ours - reference) / reference if reference else float("inf") * (ours != 0)


def write(rows: list[dict[str, Any]], case: Path = Path(".")) -> None:
    """results/rows.json of a case, each row with the case's name."""
    case = case.resolve()
    results = case / "results"
    results.mkdir(exist_ok=True)
    named = [{"case": case.name} | found for found in rows]
    whole_files.write(results / "rows.json", json.dumps(named, indent=2) + "\n")


def key(found: dict[str, Any]) -> tuple[str, str]:
    return found["case"], found["quantity"]


def judge(rows: list[dict[str, Any]], recorded: list[dict[str, Any]]) -> None:
    """Adds `holds` to each row. What is recorded as a finding holds while it is found again: a finding that changes is
    news, also for the better. Every other row must agree with its reference.

    Another code may scatter more than ours; ours is then held against what the other code gave when it was recorded."""
    findings = {key(found): found for found in recorded if "finding" in found}
    for found in rows:
        finding = findings.get(key(found))
        if finding:
            scatter = 100 * hypot(*(one["repeats"] / abs(one["reference"]) for one in (found, finding)))
            found["expectedErrorPercent"] = finding["errorPercent"]
            found["expectedWithinPercent"] = round(max(ALLOWED_ERRORS * scatter, SHOWN_PERCENT), 3)
            reference = (finding if found["kind"] == "otherCode" else found)["reference"]
            change = abs(percent(found["ours"], reference) - finding["errorPercent"])
            found["holds"] = bool(change <= found["expectedWithinPercent"])
        else:
            found["holds"] = found["agrees"]


def complaint(found: dict[str, Any]) -> str:
    """Of a row that does not hold: what is wrong."""
    text = f"{found['case']}, {found['quantity']}: {found['errorPercent']:+.2f} % "
    if "expectedErrorPercent" in found:
        return (
            text + f"is not the finding that is recorded, {found['expectedErrorPercent']:+.2f} +- "
            f"{found['expectedWithinPercent']:.2f} %"
        )
    return text + (
        f"is more than the {found['tolerancePercent']:g} % allowed, and "
        + ("this finding is not recorded" if "finding" in found else "nothing explains it")
    )


def missing(rows: list[dict[str, Any]], recorded: list[dict[str, Any]]) -> list[str]:
    """What is wrong where rows are no longer compared that are recorded."""
    absent = {key(found) for found in recorded} - {key(found) for found in rows}
    return [f"{case}, {quantity}: is recorded, but was not compared" for case, quantity in sorted(absent)]


def unrecorded(cases: list[str], recorded: list[dict[str, Any]]) -> list[str]:
    """What is wrong where no row of a case is recorded: one that is no longer compared would not be missed."""
    without = sorted(set(cases) - {found["case"] for found in recorded})
    return [f"{case}: none of its rows is recorded; scripts/validate --record takes them" for case in without]


def table(rows: list[dict[str, Any]]) -> str:
    """The rows, judged, as lines of text."""

    def value(number: float | None) -> str:
        return f"{number:.4g}"

    head = ("case", "quantity", "unit", "reference", "ours", "+-", "error %", "expected %", "holds", "kind")
    lines = [head] + [
        (
            found["case"],
            found["quantity"],
            found["unit"],
            value(found["reference"]),
            value(found["ours"]),
            value(found["uncertainty"]),
            f"{found['errorPercent']:+.2f}",
            f"{found.get('expectedErrorPercent', 0):+.2f} +- "
            + value(found.get("expectedWithinPercent", found["tolerancePercent"])),
            "NO" if not found["holds"] else "yes" if found["agrees"] else "finding",
            found["kind"],
        )
        for found in rows
    ]
    widths = [max(len(line[column]) for line in lines) for column in range(len(head))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in lines)
