"""What the entries of a case's file `parameters` may be: the case says it in its file parameters.rules.

parameters.rules is YAML:

    entries:                    # all that `parameters` must have, each for itself
      particleDiameter: {from: 1e-5, to: 0.1, unit: m}
      particleCount: {from: 1, to: 1e9, whole: yes}
      seed: {from: 11003, to: 2147483647, prime: yes}
      lift: {words: [on, off]}
      dragLaw: {closure: dragLaws}      # a word that the program `closures` lists; `{word: yes}`: any word
    numbers: [scripts/benchmarks/costModel.json]    # more names: those of the numbers in a JSON file of the repository
    define:                     # more names, in this order
      shear: 0.5 * youngsModulus / (1 + poissonRatio)
      fallSpeed: {closure: terminalVelocity, options: [dragLaw, particleDiameter], at: {option: value}}
      # of the repository; gets `parameters` on its standard input
      cells: {program: ["meshes/{mesher}", --cells, /dev/stdin]}
    together:                   # the entries against each other, in this order
      - require: orificeDiameter < hopperDiameter < tankDiameter
        message: orificeDiameter is {orificeDiameter:g} m; allowed: less than hopperDiameter, {hopperDiameter:g} m
      - expect: orificeDiameter >= 4 * particleDiameter
        message: orificeDiameter is {orificeDiameter / particleDiameter:.1f} particle diameters; it is likely to clog
      - fact: the mesh will have some {cells:.3g} cells

What is required stops a case, what is expected is a warning, facts are for `Allrun check`. `when: CONDITION` restricts
one of them, `notFor: [mesh, ...]` leaves it out where only these parts of the case are wanted, `here: yes` where the
case is to run on another machine. A definition takes `when` and `notFor`, too, and may be a list of which the last that
applies counts; what refers to a name without a value is left out. Conditions compare arithmetic (clepsydra.arithmetic)
and words, and know `and`, `or` and `not`. """

from __future__ import annotations

import ast
import functools
import json
import os
import re
import string
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Union

import yaml

from clepsydra import arithmetic, environment, parameter_file, seeds

REPOSITORY = Path(os.environ.get("CLEPSYDRA", Path(__file__).resolve().parents[2]))
FILE = "parameters.rules"
RANKS_PER_CORE = 4  # more ranks than cores are slow, but may be wanted for a test
ROOT_KEYS = ("entries", "numbers", "define", "together")
ENTRY_KEYS = ("from", "to", "unit", "whole", "prime", "words", "word", "closure")
DEFINITION_KEYS = ("program", "closure", "options", "at", "value", "when", "notFor")
CHECK_KEYS = ("require", "expect", "fact", "message", "when", "notFor", "here")

Value = Union[float, str]
Names = Mapping[str, Union[Value, None]]  # None: a definition that has no value for these parameters


class RulesError(Exception):
    """What is wrong with a file of rules, in words for its author."""


class NoValue(Exception):
    """An expression refers to a name that has no value for these parameters."""


@dataclass
class Findings:
    """What is wrong with the parameters: problems stop a case, warnings do not, facts are for `Allrun check`."""

    problems: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    facts: list[str] = field(default_factory=list)


# --- one entry --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Entry:
    allowed: str  # in words
    holds: Callable[[Value], bool]


def entry_of(about: Mapping[str, Any], where: str) -> Entry:
    require_known(about, ENTRY_KEYS, where)
    if "words" in about:
        words = [as_word(word) for word in about["words"]]
        return Entry(", ".join(words), lambda value: value in words)
    if "word" in about:
        return Entry("a word", lambda value: isinstance(value, str))
    if "closure" in about:
        known = words_of_closure(str(about["closure"]))
        return Entry(
            ", ".join(known) or "a word", lambda value: isinstance(value, str) and (value in known or not known)
        )
    low, high = float(about["from"]), float(about["to"])
    unit = f" [{about['unit']}]" if "unit" in about else ""
    if about.get("prime"):
        return Entry(
            f"a prime from {low:.0f} to {high:.0f}",
            lambda value: isinstance(value, float)
            and low <= value <= high
            and value.is_integer()
            and seeds.is_seed(int(value)),
        )
    if about.get("whole"):
        return Entry(
            f"a whole number from {low:.0f} to {high:.0f}{unit}",
            lambda value: isinstance(value, float) and value.is_integer() and low <= value <= high,
        )
    return Entry(
        f"a number from {low:g} to {high:g}{unit}", lambda value: isinstance(value, float) and low <= value <= high
    )


def as_word(word: object) -> str:
    """YAML reads on and off as booleans."""
    return {True: "on", False: "off"}[word] if isinstance(word, bool) else str(word)


@functools.cache
def words_of_closure(listing: str) -> tuple[str, ...]:
    """What the program `closures` lists; nothing where it is not built, and the solver itself will say."""
    try:
        asked = subprocess.run([environment.program("closures"), listing], capture_output=True, text=True)
    except OSError:
        return ()
    return tuple(asked.stdout.split()) if asked.returncode == 0 else ()


def alone(values: Mapping[str, Value], entries: Mapping[str, Entry], folder: Path) -> list[str]:
    """What is wrong with the entries, each for itself."""
    problems = [f"entry '{name}' is missing" for name in entries if name not in values]
    for name, value in values.items():
        if name not in entries:
            if not is_referred_to(name, folder):
                known = ", ".join(entries)
                problems.append(f"entry '{name}' is unknown{parameter_file.meant(name, entries)}; allowed: {known}")
        elif not entries[name].holds(value):
            shown = f"{parameter_file.shown(value)}{hint(value)}"
            problems.append(f"entry '{name}' is {shown}; allowed: {entries[name].allowed}")
    return problems


def is_referred_to(name: str, case: Path) -> bool:
    """True where a file of the case has $name: then it is an entry of the user's own."""
    word = re.compile(rf"\$\{{?{name}\b")
    files = [path for part in ("0", "constant", "system", "DEM") for path in (case / part).glob("*")]
    return any(
        word.search(path.read_text(errors="replace")) for path in [*files, *case.glob("step.*")] if path.is_file()
    )


def hint(value: Value) -> str:
    if isinstance(value, str) and "$" in value:
        return ", which refers to no entry above it"
    if isinstance(value, str) and re.match(r"[+-]?[\d.]+(e[+-]?\d+)?\s*[A-Za-z]+$", value):
        return ", which has a unit"
    return ""


# --- expressions ------------------------------------------------------------------------------------------------------


def number(expression: str, names: Names) -> float:
    """The value of arithmetic on names. NoValue where one of them has none."""
    for name in referred(expression) - arithmetic.FUNCTIONS.keys():
        if name not in names:
            raise RulesError(f"{expression!r}: there is no '{name}'{parameter_file.meant(name, names)}")
        if names[name] is None:
            raise NoValue(name)
    try:
        return float(arithmetic.evaluate(expression, names))
    except ValueError as problem:
        raise RulesError(f"{expression!r} {problem}") from None


def referred(expression: str) -> set[str]:
    return {node.id for node in ast.walk(parsed(expression)) if isinstance(node, ast.Name)}


def parsed(expression: str) -> ast.expr:
    try:
        return ast.parse(expression.strip(), mode="eval").body
    except SyntaxError:
        raise RulesError(f"{expression!r} is no expression") from None


def holds(condition: str, names: Names) -> bool:
    return truth(parsed(condition), names)


def truth(node: ast.expr, names: Names) -> bool:
    if isinstance(node, ast.BoolOp):
        # As Python does: what comes after the one that decides is not looked at.
        every = isinstance(node.op, ast.And)
        return (
            all(truth(part, names) for part in node.values)
            if every
            else any(truth(part, names) for part in node.values)
        )
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        return not truth(node.operand, names)
    if isinstance(node, ast.Compare):
        sides = [side(one, names) for one in (node.left, *node.comparators)]
        return all(compared(kind, one, other) for kind, one, other in zip(node.ops, sides, sides[1:]))
    raise RulesError(f"{ast.unparse(node)!r} is no condition; allowed: comparisons, and, or, not")


def side(node: ast.expr, names: Names) -> Value:
    """Of a comparison: a word in quotes, an entry that is a word, or arithmetic."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    value = names.get(node.id) if isinstance(node, ast.Name) else None
    if isinstance(value, str):
        return value
    return number(ast.unparse(node), names)


def compared(kind: ast.cmpop, one: Value, other: Value) -> bool:
    if isinstance(kind, ast.Eq):
        return one == other
    if isinstance(kind, ast.NotEq):
        return one != other
    if isinstance(one, float) and isinstance(other, float):
        if isinstance(kind, ast.Lt):
            return one < other
        if isinstance(kind, ast.LtE):
            return one <= other
        if isinstance(kind, ast.Gt):
            return one > other
        if isinstance(kind, ast.GtE):
            return one >= other
    raise RulesError(f"{one!r} and {other!r} cannot be compared so; allowed: == and != of words, < <= > >= of numbers")


def filled(message: str, names: Names) -> str:
    """The message with the values of its {EXPRESSION:FORMAT}."""
    text = []
    for literal, expression, form, _ in string.Formatter().parse(message):
        text.append(literal)
        if expression is not None:
            word = names.get(expression)
            text.append(word if isinstance(word, str) else format(number(expression, names), form or "g"))
    return "".join(text)


# --- all together -----------------------------------------------------------------------------------------------------


class Rules:
    """The file of rules in the folder of a case."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.path = folder / FILE
        try:
            said = yaml.safe_load(self.path.read_text())
        except (OSError, yaml.YAMLError) as problem:
            raise RulesError(f"{self.path}: {' '.join(str(problem).split())}") from None
        require_known(said, ROOT_KEYS, str(self.path))
        try:
            self.entries = {name: entry_of(about, f"{self.path}: {name}") for name, about in said["entries"].items()}
        except (KeyError, TypeError, ValueError, AttributeError) as problem:
            raise RulesError(f"{self.path}: entries: {type(problem).__name__} {problem}") from None
        self.numbers: list[str] = said.get("numbers", [])
        self.definitions: dict[str, Any] = said.get("define", {})
        self.together: list[dict[str, Any]] = said.get("together", [])

    def check(self, text: str, ranks: int | None, part: str, path: str) -> Findings:
        """Findings about the text of a file `parameters`, which is called `path` in them.

        ranks: None where the case is to run on another machine; part: what of the case is wanted, or `all`."""
        try:
            values = parameter_file.parameters_in(text, path)
        except parameter_file.ParameterError as problem:
            return Findings([str(problem)])
        found = Findings(alone(values, self.entries, self.folder))
        try:
            if not found.problems:
                names = self._names(values, text, part, found)
                for about in self.together:
                    self._apply(about, names, ranks, part, found)
                if ranks is not None:
                    check_ranks(ranks, found)
        except RulesError as problem:
            raise RulesError(f"{self.path}: {problem}") from None
        problems, warnings = ([f"{path}: {one}" for one in some] for some in (found.problems, found.warnings))
        return Findings(problems, warnings, found.facts)

    def _names(self, values: Mapping[str, Value], text: str, part: str, found: Findings) -> Names:
        names: dict[str, Value | None] = {**dict.fromkeys(self.definitions), **values}
        names["memoryHere"] = float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
        for file in self.numbers:
            table = json.loads((REPOSITORY / file).read_text())
            names.update({name: float(value) for name, value in table.items() if isinstance(value, (int, float))})
        choices = [
            (name, one)
            for name, about in self.definitions.items()
            for one in (about if isinstance(about, list) else [about])
        ]
        for name, about in choices:
            how = about if isinstance(about, dict) else {"value": str(about)}
            require_known(how, DEFINITION_KEYS, name)
            try:
                if part in how.get("notFor", ()) or not holds(str(how.get("when", "0 == 0")), names):
                    continue
                if "program" in how:
                    names[name] = by_program(how["program"], names, text)
                elif "closure" in how:
                    names[name] = by_closure(how["closure"], how["options"], how.get("at", {}), names)
                else:
                    names[name] = number(str(how["value"]), names)
            except NoValue:
                continue
            except Refused as refusal:
                found.problems.append(str(refusal))
        return names

    @staticmethod
    def _apply(about: Mapping[str, Any], names: Names, ranks: int | None, part: str, found: Findings) -> None:
        require_known(about, CHECK_KEYS, "together")
        if part in about.get("notFor", ()) or (about.get("here") and ranks is None):
            return
        try:
            if not holds(str(about.get("when", "0 == 0")), names):
                return
            if "fact" in about:
                found.facts.append(filled(about["fact"], names))
            elif "require" in about and not holds(about["require"], names):
                found.problems.append(filled(about["message"], names))
            elif "expect" in about and not holds(about["expect"], names):
                found.warnings.append(filled(about["message"], names))
        except NoValue:
            return
        except KeyError as missing:
            raise RulesError(f"together: {dict(about)} has no {missing}") from None


class Refused(Exception):
    """A program refused the parameters, and said why."""


def by_program(command: list[str], names: Names, text: str) -> float:
    words = [filled(str(word), names) for word in command]
    asked = subprocess.run([str(REPOSITORY / words[0]), *words[1:]], input=text, capture_output=True, text=True)
    if asked.returncode != 0:
        raise Refused(asked.stderr.strip().replace("/dev/stdin: ", ""))
    return float(asked.stdout)


def by_closure(formula: str, options: list[str], at: Mapping[str, float], names: Names) -> float:
    """NoValue where the program is not built, or knows no value."""
    command = [str(environment.program("closures")), formula, *(f"--{name}={names[name]}" for name in options)]
    command += [f"--{name}={value}" for name, value in at.items()]
    try:
        return float(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    except (OSError, subprocess.CalledProcessError, ValueError):
        raise NoValue(formula) from None


def check_ranks(ranks: int, found: Findings) -> None:
    cores = len(os.sched_getaffinity(0))
    tasks = int(os.environ.get("SLURM_NTASKS", 1))
    most = max(cores * RANKS_PER_CORE, tasks)
    if ranks > most:
        found.problems.append(f"{ranks} ranks; allowed: 1 to {most} ({cores} cores here)")
    elif ranks > max(cores, tasks):
        found.warnings.append(f"{ranks} ranks on {cores} cores are slower than {cores}")


def require_known(said: object, allowed: tuple[str, ...], where: str) -> None:
    if not isinstance(said, dict):
        raise RulesError(f"{where}: must be a list of `entry: value`; allowed entries: {', '.join(allowed)}")
    for name in said:
        if name not in allowed:
            known = parameter_file.meant(str(name), allowed)
            raise RulesError(f"{where}: unknown entry '{name}'{known}; allowed: {', '.join(allowed)}")


def report(path: Path, ranks: int, part: str, facts: bool) -> int:
    """Prints what is wrong with a file `parameters`, and the facts where they are wanted. 1 where it cannot be used."""
    try:
        found = Rules(path.absolute().parent).check(parameter_file.read(path), ranks, part, str(path))
    except RulesError as problem:
        print(problem, file=sys.stderr)
        return 1
    for line in found.problems + [f"{warning} (a warning)" for warning in found.warnings]:
        print(line, file=sys.stderr)
    if facts and not found.problems:
        print("\n".join(f"  {fact}" for fact in found.facts))
    return 1 if found.problems else 0
