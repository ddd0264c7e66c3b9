"""OpenFOAM's dictionaries as text: read, with a record of what was asked for, and written again."""

import re
from pathlib import Path
from typing import Any, Iterator

# A word may have closed brackets in it: div(phi,U), div((nuEff*dev2(T(grad(U)))))
_INSIDE = r"[^\s{}()\[\];\"]*"
_CALL = rf"\({_INSIDE}\)"
for _ in range(5):
    _CALL = rf"\({_INSIDE}(?:{_CALL}{_INSIDE})*\)"
TOKEN = re.compile(
    rf'\s+|//[^\n]*|/\*.*?\*/|(?P<token>"[^"]*"|[^\s{{}}()\[\];"]+(?:{_CALL}{_INSIDE})*|[{{}}()\[\];])', re.DOTALL
)
CLOSES = {"(": ")", "[": "]", "{": "}"}


class FoamError(Exception):
    """What is wrong with a file, in one line."""


class Dictionary:
    """Entries by name: text, or another Dictionary. It remembers which of them were asked for."""

    def __init__(self, where: str) -> None:
        self.where = where
        self.entries: dict[str, Any] = {}
        self.asked: set[str] = set()

    def __contains__(self, name: str) -> bool:
        return name in self.entries

    def text(self, name: str, default: str | None = None) -> str:
        """The entry's words; the default where there is none."""
        self.asked.add(name)
        value = self.entries.get(name, default)
        if isinstance(value, Dictionary):
            raise FoamError(f"{self.where}: '{name}' is a dictionary; allowed: a value")
        return value

    def needed(self, name: str) -> Any:
        if name not in self.entries:
            raise FoamError(f"{self.where}: entry '{name}' is missing")
        return self.text(name)

    def number(self, name: str) -> float:
        """The last number of the entry, behind a name and dimensions if it has them."""
        words = self.needed(name).split()
        try:
            return float(words[-1])
        except (ValueError, IndexError):
            raise FoamError(f"{self.where}: entry '{name}' is '{' '.join(words)}'; allowed: a number") from None

    def words(self, name: str) -> list[str]:
        """Of a list in brackets, or of a single word, without quotes."""
        return self.text(name, "").replace("(", " ").replace(")", " ").replace('"', " ").split()

    def sub(self, name: str) -> "Dictionary":
        """The dictionary that OpenFOAM takes for a name; an empty one where there is none."""
        return self.matching(name) or Dictionary(f"{self.where}/{name}")

    def unread(self) -> Iterator[tuple[str, str]]:
        """Names of the entries that nobody asked for, those of dictionaries that were asked for as well."""
        for name, value in self.entries.items():
            if name not in self.asked:
                yield self.where, name
            elif isinstance(value, Dictionary):
                yield from value.unread()

    def matching(self, name: str) -> "Dictionary | None":
        """The dictionary that OpenFOAM takes for a name: its own, else that of the last pattern which fits; None where
        none does."""
        fitting = [pattern for pattern in self.entries if is_pattern(pattern) and re.fullmatch(pattern, name)]
        key = name if name in self.entries or not fitting else fitting[-1]
        self.asked.add(key)
        value = self.entries.get(key)
        return value if isinstance(value, Dictionary) else None

    def is_read(self) -> "Dictionary":
        """Everything in it counts as asked for."""
        self.asked |= set(self.entries)
        for value in self.entries.values():
            if isinstance(value, Dictionary):
                value.is_read()
        return self


def is_pattern(name: str) -> bool:
    """Whether a keyword was in quotes; div(phi,U) is a word."""
    return not re.fullmatch(r"[\w.:-]+(\([^|]*\))?", name)


def read(path: Path, where: str | None = None) -> Dictionary:
    where = where or str(path)
    try:
        text = Path(path).read_text()
    except OSError as problem:
        raise FoamError(f"{where}: {problem.strerror}") from None
    found = parse(text, where)
    found.entries.pop("FoamFile", None)
    return found


def parse(text: str, where: str) -> Dictionary:
    tokens = []
    at = 0
    while at < len(text):
        piece = TOKEN.match(text, at)
        if not piece:
            raise FoamError(f"{where}:{text.count(chr(10), 0, at) + 1}: a quote or comment that does not end")
        if piece["token"]:
            tokens.append(piece["token"])
        at = piece.end()
    found, rest = body(tokens, 0, where)
    if rest < len(tokens):
        raise FoamError(f"{where}: a '}}' without its '{{'")
    return found


def body(tokens: list[str], at: int, where: str) -> tuple[Dictionary, int]:
    """Entries from a place on, to the brace that ends them."""
    found = Dictionary(where)
    while at < len(tokens) and tokens[at] != "}":
        name = tokens[at]
        if name == ";":
            at += 1
            continue
        if name.startswith("#"):
            raise FoamError(f"{where}: '{name}' is not followed; write what it stands for in its place")
        if at + 1 < len(tokens) and tokens[at + 1] == "{":
            found.entries[name.strip('"')], at = body(tokens, at + 2, f"{where}/{name}")
            if at == len(tokens):
                raise FoamError(f"{where}: the '{{' of '{name}' is not closed")
            at += 1
        else:
            start = at = at + 1
            open_: list[str] = []
            while at < len(tokens) and (open_ or tokens[at] != ";"):
                if tokens[at] in CLOSES:
                    open_.append(CLOSES[tokens[at]])
                elif open_ and tokens[at] == open_[-1]:
                    open_.pop()
                elif tokens[at] in CLOSES.values():
                    raise FoamError(f"{where}: entry '{name}' has no ';' at its end, or a bracket too many")
                at += 1
            if at == len(tokens):
                raise FoamError(f"{where}: entry '{name}' has no ';' at its end")
            found.entries[name.strip('"')] = " ".join(tokens[start:at])
            at += 1
    return found, at


def listed(text: str, where: str) -> Dictionary:
    """The dictionaries in a list of them: `functions ( name { } );`, as older versions of OpenFOAM write it."""
    return parse(text.strip()[1:-1], where)


def written(entries: Any, indent: int = 0) -> str:
    """Text of a Dictionary, or of a plain dict."""
    lines, blank = [], " " * indent
    for name, value in (entries.entries if isinstance(entries, Dictionary) else entries).items():
        if is_pattern(name) and not name.startswith("$"):
            name = f'"{name}"'
        if isinstance(value, (dict, Dictionary)):
            lines += [f"{blank}{name}", f"{blank}{{", written(value, indent + 4), f"{blank}}}"]
        else:
            lines.append(f"{blank}{name:23} {value};" if value != "" else f"{blank}{name};")
    return "\n".join(lines)


def file(name: str, kind: str, entries: Any) -> str:
    """A whole file."""
    return f"FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n\n{written(entries)}\n"
