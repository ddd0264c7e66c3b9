"""What a kind of fault is, and how its tries are counted."""

from dataclasses import dataclass
from typing import Any, Callable


class Wrong(Exception):
    """What a try showed that must never be."""


class Skipped(Exception):
    """Why a fault cannot be made on this machine."""


@dataclass(frozen=True)
class Fault:
    name: str
    done: str  # what is done to the run
    expected: str
    in_quick: bool
    tries: Callable[
        [Any], list[Callable[[], str]]
    ]  # takes the bench, gives a list of functions: each makes the fault once and says what it saw


ALL = {}


def command_name(function: Any) -> str:
    """The name of a kind of fault as it is typed and recorded: emptyOfCheckpoint for empty_of_checkpoint."""
    first, *others = function.split("_")
    return first + "".join(word.capitalize() for word in others)


def fault(done: Any, expected: Any, in_quick: bool = True) -> Any:
    """Makes a function into the kind of fault of its name."""

    def enter(tries: Any) -> Any:
        name = command_name(tries.__name__)
        ALL[name] = Fault(name, done, expected, in_quick, tries)
        return tries

    return enter
