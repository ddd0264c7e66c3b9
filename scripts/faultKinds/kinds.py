"""What a kind of fault is, and how its tries are counted."""

from dataclasses import dataclass


class Wrong(Exception):
    """What a try showed that must never be."""


class Skipped(Exception):
    """Why a fault cannot be made on this machine."""


@dataclass(frozen=True)
class Fault:
    name: str
    done: str       # what is done to the run
    expected: str
    inQuick: bool
    tries: object   # takes the bench, gives a list of functions: each makes the fault once and says what it saw


ALL = {}


def fault(done, expected, inQuick=True):
    """Makes a function into the kind of fault of its name."""
    def enter(tries):
        ALL[tries.__name__] = Fault(tries.__name__, done, expected, inQuick, tries)
        return tries
    return enter
