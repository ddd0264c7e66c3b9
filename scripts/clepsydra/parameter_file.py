#!/usr/bin/python3
"""Prints and changes entries of a case's file `parameters`, a flat OpenFOAM dictionary of lines "name value;".

Comments are kept. Only this module reads and changes that file."""

import argparse
import difflib
import math
import re
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator, Mapping

from clepsydra import arithmetic, whole_files
from clepsydra.old_names import NEW_NAMES

VALUE = r'(?:[^;\n"/{}#]|"[^"\n]*"|/(?![/*])|\$\{\w+\}|\#eval[ \t]*\{[^;\n{}#]*\})*'
PIECE = re.compile(
    r"(?P<between>\s+|//[^\n]*|/\*.*?\*/|FoamFile\s*\{[^{}]*\}|\#include\w*[ \t]+\"[^\"\n]*\")"
    # All of the blanks or none: to try each number of them would take for ever on a long line.
    rf"|(?P<name>[A-Za-z_]\w*)(?P<gap>[ \t]+(?![ \t])(?={VALUE};)|(?=;))(?P<value>{VALUE});",
    re.DOTALL,
)
EVALUATED = re.compile(r"#eval[ \t]*\{(.*)\}")
SPELT_ALIKE = 0.75  # as "widht" and "width"; "depth" and "width" are less alike
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")


class ParameterError(SystemExit):
    """What is wrong with a file, entry or value, in one line. Uncaught, it ends the program with that line."""


def parameters(path: Path | str) -> dict[str, Any]:
    """The entries of a file, by name: numbers as float, all else as text."""
    return parameters_in(read(path), path)


def parameters_in(text: str, path: Path | str = "parameters") -> dict[str, Any]:
    found: dict[Any, Any] = {}
    for name, value, line in entries(text, path):
        if name in NEW_NAMES:
            raise ParameterError(f"{path}:{line}: entry '{name}' has another name now; allowed: '{NEW_NAMES[name]}'")
        if name in found:
            raise ParameterError(f"{path}:{line}: entry '{name}' is there twice; allowed: once")
        found[name] = resolved(value, found, f"{path}:{line}: entry '{name}'")
    return found


def read(path: Path | str) -> str:
    try:
        return Path(path).read_text()
    except OSError as problem:
        raise ParameterError(f"{path}: {problem.strerror}") from None
    except UnicodeDecodeError:
        raise ParameterError(f"{path}: is no text") from None


def entries(text: str, path: Path | str) -> Iterator[tuple[str, str, int]]:
    """(name, value as it is written, line) of each."""
    for piece in pieces(text, path):
        if piece["name"]:
            line = text.count("\n", 0, piece.start()) + 1
            if not piece["value"].strip():
                raise ParameterError(
                    f"{path}:{line}: entry '{piece['name']}' has no value; allowed: {piece['name']} VALUE;"
                )
            yield piece["name"], piece["value"].strip(), line


def pieces(text: str, path: Path | str) -> Iterator[re.Match[str]]:
    at = 0
    while at < len(text):
        piece = PIECE.match(text, at)
        if not piece:
            line, shown = text.count("\n", 0, at) + 1, text[at:].split("\n", 1)[0][:60]
            raise ParameterError(
                f"{path}:{line}: {shown!r} is no entry; allowed: one `name value;` a line, and comments"
            )
        yield piece
        at = piece.end()


def resolved(value: str, before: Mapping[str, Any], where: str) -> Any:
    """Its number or text. before: the entries above it, to which $name refers; what refers to others stays as it is."""
    reference = re.fullmatch(r"\$(?:(\w+)|\{(\w+)\})", value)
    if reference:
        name = reference[1] or reference[2]
        return before.get(name, value)
    expression = EVALUATED.fullmatch(value)
    if expression:
        if not set(re.findall(r"\$\{?(\w+)", expression[1])) <= set(before):
            return value
        try:
            return float(arithmetic.evaluate(re.sub(r"\$\{?(\w+)\}?", r"\1", expression[1]), before))
        except ValueError as problem:
            raise ParameterError(f"{where} is {value}, which {problem}") from None
    if not NUMBER.fullmatch(value):
        return value
    if not math.isfinite(float(value)):
        raise ParameterError(f"{where} is {value}; allowed: numbers up to 1.8e308")
    return float(value)


def with_parameters(text: str, values: Mapping[str, str], path: Path | str = "parameters") -> str:
    """The dictionary's text with other values, all text, of entries that it has."""
    known = [name for name, _, _ in entries(text, path)]
    for name, value in values.items():
        if name not in known:
            raise ParameterError(f"{path}: no entry '{name}'{meant(name, known)}; it has: {', '.join(known)}")
        if not (value.strip() and re.fullmatch(VALUE, value)):
            raise ParameterError(
                f"{path}: entry '{name}' cannot be {value!r}; allowed: a number, words, or #eval{{...}}, "
                "in one line without ; { } #"
            )
    changed = []
    for piece in pieces(text, path):
        changed.append(
            f"{piece['name']}{piece['gap']}{values[piece['name']]};" if piece["name"] in values else piece[0]
        )
    return "".join(changed)


def meant(word: str, known: Iterable[str]) -> str:
    """The new name of an old entry, or the known word that is most like a misspelt one, in words."""
    if word in NEW_NAMES:
        return f" (its name is '{NEW_NAMES[word]}' now)"
    near = difflib.get_close_matches(word, [str(name) for name in known], 1)
    return f" (is '{near[0]}' meant?)" if near else ""


def changed_names(before: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """Names of the entries that are not alike, or in one only."""
    return [name for name in dict.fromkeys([*before, *now]) if before.get(name) != now.get(name)]


def shown(value: Any) -> str:
    return f"{value:.10g}" if isinstance(value, float) else value


# --- for shell scripts ---------------------------------------------------------------------------


def get(path: str, name: str) -> None:
    found = parameters(path)
    if name not in found:
        raise ParameterError(f"{path}: entry '{name}' is missing{meant(name, found)}")
    print(shown(found[name]))


def set_values(path: str, *wishes: str) -> None:
    for wish in wishes:
        if "=" not in wish:
            raise ParameterError(f"'{wish}' sets nothing; allowed: NAME=VALUE")
    change(path, dict(wish.split("=", 1) for wish in wishes))


def merge(path: str, other: str) -> None:
    """The entries of a case on top of those of its template: other values, then entries that the template lacks. Those
    that look like a misspelt entry of the template are refused."""
    template = read(path)
    known = [name for name, _, _ in entries(template, path)]
    wanted = {name: value for name, value, _ in entries(read(other), other)}
    added = {name: value for name, value in wanted.items() if name not in known}
    for name in added:
        if name in NEW_NAMES or difflib.get_close_matches(name, known, 1, SPELT_ALIKE):
            raise ParameterError(
                f"{other}: the template {path} has no entry '{name}'{meant(name, known)}; it has: {', '.join(known)}"
            )
    changed = with_parameters(template, {name: wanted[name] for name in wanted if name in known}, path)
    write(path, changed + "".join(f"\n{name} {value};\n" for name, value in added.items()))


def change(path: Path | str, values: Mapping[str, str]) -> None:
    write(path, with_parameters(read(path), values, path))


def write(path: Path | str, text: str) -> None:
    try:
        whole_files.write(path, text)
    except OSError as problem:
        raise ParameterError(f"{path}: {problem.strerror}") from None


def numbers(path: Path | str) -> None:
    for name, value in parameters(path).items():
        if isinstance(value, float):
            print(name, shown(value))


def differences(before: str, now: str) -> None:
    old, new = parameters(before), parameters(now)
    for name in changed_names(old, new):
        print(f"{name} {shown(old.get(name, '(none)'))} -> {shown(new.get(name, '(none)'))}")


def evaluate(expression: str) -> None:
    try:
        print(f"{arithmetic.evaluate(expression):.6g}")
    except ValueError as problem:
        raise ParameterError(f"{expression!r} {problem}") from None


COMMANDS: dict[str, tuple[Callable[..., None], tuple[str, ...], str]] = {
    "get": (get, ("FILE", "NAME"), "print an entry's value, with $name replaced and #eval{} computed"),
    "set": (set_values, ("FILE", "NAME=VALUE ..."), "give entries that are there other values"),
    "merge": (merge, ("FILE", "OTHER"), "put the entries of OTHER in place of those of FILE"),
    "numbers": (numbers, ("FILE",), "print `name number` of all entries that are numbers"),
    "differences": (differences, ("BEFORE", "NOW"), "print `name before -> now` of all entries that differ"),
    "evaluate": (evaluate, ("EXPRESSION",), "print an expression's value"),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    subparsers = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for name, (_, operands, description) in COMMANDS.items():
        subparser = subparsers.add_parser(name, help=description, description=description)
        for operand in operands:
            subparser.add_argument(operand.removesuffix(" ..."), nargs="*" if operand.endswith(" ...") else 1)
    given = vars(parser.parse_args())
    command, operands, _ = COMMANDS[given["command"]]
    command(*(word for operand in operands for word in given[operand.removesuffix(" ...")]))


if __name__ == "__main__":
    main()
