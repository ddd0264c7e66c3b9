"""What the pages (*.md) tell a reader to type, and where their links lead."""

import os
import re

from clepsydra.environment import REPOSITORY as ROOT

PROGRAMS = (".", "Allrun", "closures", "cmake", "ctest", "mpirun", "pimpleDemFoam", "touch", "traceResidual")


def without_fences(text: str) -> str:
    """Fences of list items are indented."""
    return re.sub(r"^ {0,3}```.*?^ {0,3}```", "", text, flags=re.S | re.M)


def typed_lines(text: str) -> list[tuple[str, str]]:
    """The indented lines, in order, as (command, what its comment says)."""
    indented = re.sub(r" *\\\n *", " ", "\n".join(re.findall(r"^    .*$", without_fences(text), flags=re.M)))
    parts = (re.match(r" *(?:\$ )?(.*?)(?:\s+#\s*(.*))?$", line) for line in indented.splitlines())
    return [(" ".join(part[1].split()), part[2] or "") for part in parts if part]


def commands(page: str, text: str) -> list[str]:
    """Of a page, in its order: the lines of its indented blocks, then what stands in backquotes."""
    spans = re.findall(r"`([^`]+)`", re.sub(r"^    .*$", "", without_fences(text), flags=re.M))
    typed = [command for command, _ in typed_lines(text)] + [" ".join(span.split()) for span in spans]
    return list(dict.fromkeys(line for line in typed if is_command(page, line)))


def is_command(page: str, line: str) -> bool:
    """A program by its name alone is only spoken of."""
    first, *arguments = line.split() or [""]
    if first.startswith("./"):
        return True
    places = [place / first for place in (ROOT, (ROOT / page).parent)]
    program = first in PROGRAMS or any(place.is_file() and os.access(place, os.X_OK) for place in places)
    return program and not first.startswith("build/") and ("/" in first or bool(arguments))


def links(text: str) -> list[str]:
    """Targets within the repository, without the part after #."""
    found = re.findall(r"\]\(([^)#\s]+)(?:#[^)\s]*)?\)", re.sub(r"`[^`]+`", "", without_fences(text)))
    return [link for link in found if "://" not in link]
