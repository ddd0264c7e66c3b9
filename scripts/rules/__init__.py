"""What the entries of a case's `parameters` may be: each alone here, against each other in the module of the case."""

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable

from clepsydra.parameter_file import ParameterError, meant, parameters_in, shown


@dataclass(frozen=True)
class Rule:
    allowed: str  # in words
    holds: Callable  # of a value: a float or text


@dataclass
class Findings:
    """What a case says about the entries together: problems stop it, warnings do not, facts are for `Allrun check`."""

    problems: list = field(default_factory=list)
    warnings: list = field(default_factory=list)
    facts: list = field(default_factory=list)


def number(low, high, unit=""):
    of = f" [{unit}]" if unit else ""
    return Rule(
        f"a number from {low:g} to {high:g}{of}", lambda value: isinstance(value, float) and low <= value <= high
    )


def length(low, high):
    return number(low, high, "m")


def whole(low, high):
    return Rule(
        f"a whole number from {low} to {high}",
        lambda value: isinstance(value, float) and value.is_integer() and low <= value <= high,
    )


def oneOf(*words):
    return Rule(", ".join(words), lambda value: value in words)


def check(case, text, folder, ranks, part, path):
    """Findings about the text of a file `parameters`, which is called `path` in them.

    case: a module with RULES and findings; folder: where the case lies, whose files may have entries of their own; part: what
    of the case is wanted, as its Allrun calls it, or `all`; ranks: None where it is to run on another machine."""
    try:
        p = parameters_in(text, path)
    except ParameterError as problem:
        return Findings([str(problem)])
    found = Findings(alone(p, case.RULES, Path(folder)))
    if not found.problems:
        case.findings(text, p, ranks, part, found)
    return Findings(
        [f"{path}: {one}" for one in found.problems], [f"{path}: {one}" for one in found.warnings], found.facts
    )


def alone(p, rules, folder):
    """What is wrong with the entries, each for itself."""
    problems = [f"entry '{name}' is missing" for name in rules if name not in p]
    for name, value in p.items():
        if name not in rules:
            if not isReferredTo(name, folder):
                problems.append(f"entry '{name}' is unknown{meant(name, rules)}; allowed: {', '.join(rules)}")
        elif not rules[name].holds(value):
            problems.append(f"entry '{name}' is {shown(value)}{hint(value)}; allowed: {rules[name].allowed}")
    return problems


def isReferredTo(name, case):
    """True where a file of the case has $name: then it is an entry of the user's own."""
    word = re.compile(rf"\$\{{?{name}\b")
    files = [path for part in ("0", "constant", "system", "DEM") for path in (case / part).glob("*")]
    return any(
        word.search(path.read_text(errors="replace")) for path in [*files, *case.glob("step.*")] if path.is_file()
    )


def hint(value):
    if isinstance(value, str) and "$" in value:
        return ", which refers to no entry above it"
    if isinstance(value, str) and re.match(r"[+-]?[\d.]+(e[+-]?\d+)?\s*[A-Za-z]+$", value):
        return ", which has a unit"
    return ""
