"""What opened sets say all together: shares with 95 % Wilson intervals, means with 1.96 standard errors."""

import math
from typing import Any

NORMAL = 1.959964  # standard deviations to either side of 95 %
DRAWS = {"first": range(1, 9), "second": range(9, 17), "third": range(17, 1000)}  # numbers of sets drawn together


def rates(score: Any) -> dict[Any, Any]:
    """{draw: {name: rate}} of each draw that has been opened, and of all together."""
    drawn = {draw: [one for one in score if draw_of(one["set"]) == draw] for draw in DRAWS}
    return {draw: rates_of(some) for draw, some in (drawn | {"all": score}).items() if some}


def draw_of(name: str) -> Any:
    return next(draw for draw, numbers in DRAWS.items() if int(name[3:]) in numbers)


def rates_of(score: Any) -> dict[Any, Any]:
    nulls = [one for one in score if one["kind"] == "null"]
    outside = [one for one in score if one["kind"] == "outside"]
    effects = [one for one in score if one["kind"] not in ("null", "outside")]
    found = [one for one in effects if is_residual(one)]
    alone = [one for one in found if one["decision"] == "named"]
    right = [one for one in alone if one["verdict"] == "right"]
    found_outside = [one for one in outside if is_residual(one)]
    better = [one for one in found if one["heldOut"]["after"]]
    errors = {
        name: mean(one["heldOut"][key]["value"] for one in better)
        for name, key in (
            ("heldOutErrorBefore", "before"),
            ("heldOutErrorAfter", "after"),
            ("heldOutErrorOneMoreParameter", "oneMoreParameter"),
        )
    }
    return {
        "falseAlarms": share(map(is_residual, nulls)),
        "detected": share(map(is_residual, effects)),
        "top1": share(best(one) == true(one) for one in found),
        "truthInSet": share(one["truthInSet"] for one in found),
        "meanSetSize": mean(len(one["answer"]) for one in found),
        "namedAlone": share(one in alone for one in found),
        "namedAloneRight": share(one["verdict"] == "right" for one in alone),
        "wrongNameOutOfLibrary": share(one["decision"] == "named" for one in found_outside),
        "abstainedOutOfLibrary": share(
            one["decision"] == "unknown" or one["somethingElseInSet"] for one in found_outside
        ),
        "coverage95": share(covers(size) for one in found for size in one["amplitudes"]),
        "rightAcceptance": share(map(is_accepted, right)),
        "falseAcceptance": share(map(is_accepted, [one for one in score if one not in right])),
        **errors,
        "runsPerDataSet": mean(one["runs"] for one in score),
    }


def is_residual(one: Any) -> bool:
    return one["decision"] != "noResidual"


def is_accepted(one: Any) -> bool:
    """Whether held-out data let the answer into the model, by the rule of its time."""
    return bool(one["heldOut"].get("better", one["heldOut"].get("accepted")))


def true(one: Any) -> list[Any]:
    return sorted(effect["name"] for effect in one["truth"])


def best(one: Any) -> list[Any]:
    """Effects of the answer's first member, or of what comes nearest where it is unknown."""
    first = one["answer"][0]["amplitudes"] if one["answer"] else one["nearestOfUnknown"] or {}
    return sorted(first)


def covers(size: Any) -> bool:
    """Whether the interval of an amplitude holds the true one; it may end where the range does."""
    lower, upper = size["interval95"]
    return lower - 1e-9 <= size["true"] <= upper + 1e-9


def share(hits: Any) -> dict[str, Any]:
    hits = [bool(hit) for hit in hits]
    n = len(hits)
    if n == 0:
        return {"share": None, "count": 0, "of": 0, "interval95": None}
    p, z = sum(hits) / n, NORMAL**2 / n
    middle, half = (p + z / 2) / (1 + z), math.sqrt(z * (p * (1 - p) + z / 4)) / (1 + z)
    return {"share": p, "count": sum(hits), "of": n, "interval95": [middle - half, middle + half]}


def mean(values: Any) -> dict[str, Any]:
    values = list(values)
    n = len(values)
    if n == 0:
        return {"mean": None, "of": 0, "interval95": None}
    middle = sum(values) / n
    error = NORMAL * math.sqrt(sum((value - middle) ** 2 for value in values) / (n - 1) / n) if n > 1 else None
    return {"mean": middle, "of": n, "interval95": [middle - error, middle + error] if n > 1 else None}
