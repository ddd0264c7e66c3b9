"""What an import found: carried over with another meaning, left out, or an error."""

from typing import Any, Iterable, Iterator


class Report:
    def __init__(self, known: Iterable[str] = ()) -> None:
        self.changes: list[tuple[str, str, str]] = []
        self.omissions: list[tuple[str, str, str]] = []
        self.errors: list[tuple[str, str, str]] = []
        self.without = set(known)  # entries that the user wants left out, whatever they say
        self.used: set[Any] = set()

    def change(self, where: str, what: str, how: str) -> None:
        self.changes.append((where, what, how))

    def left_out(self, where: str, what: str, why: str) -> None:
        self.omissions.append((where, what, why))

    def error(self, where: str, what: str, why: str) -> None:
        """Unless the user has said --without for it."""
        if what in self.without:
            self.used.add(what)
            self.left_out(where, what, "by --without")
        else:
            self.errors.append((where, what, why))

    def lines(self) -> Iterator[Any]:
        for title, rows in (("Means something else here", self.changes), ("Left out", self.omissions)):
            if rows:
                yield f"{title}:"
                yield from (f"  {where}: {what}: {how}" for where, what, how in dict.fromkeys(rows))
