#!/usr/bin/python3
"""The `parameters` of a case as all scripts read and change them (clepsydra.parameter_file).

A text is either refused with ParameterError, or its last entry can be set, is then read as what it was set to, and all
other entries keep their values. (traceResidual reads the same files by itself: entries.cpp.)

A small fuzzer with libFuzzer's options, as far as scripts/fuzz uses them, and its words for what it has done. It keeps
a text where no other before had such an outcome; what it reports as reached are lines of Python, not edges. """

import dis
import mmap
import random
import re
import signal
import sys
import time
from pathlib import Path
from typing import Any

from clepsydra import arithmetic, parameter_file

SCRIPTS = Path(__file__).resolve().parents[3] / "scripts"

OPTION = re.compile(r"-(\w+)=(.*)")
EXTREMES = ["0", "-1", "1e308", "1e-320", "1e400", "nan", "inf", "00", "1_0", "9" * 30, "0x10", "1.", ".5", "+", "1e"]


def main() -> None:
    options = {match[1]: match[2] for word in sys.argv[1:] if (match := OPTION.fullmatch(word))}
    texts = [read_text(path) for word in sys.argv[1:] if not OPTION.fullmatch(word) for path in files_of(Path(word))]
    if "max_total_time" not in options:
        for text in texts:
            execute(text, options)
            print("Executed 1 text")
        return
    corpus, executed = mutate(texts, options)
    reached, all_ = coverage(corpus.values())
    print(f"({all_} inline 8-bit counters)\ncov: {reached}\nstat::number_of_executed_units: {executed}")


def files_of(path: Path) -> list[Any]:
    return sorted(path.iterdir()) if path.is_dir() else [path]


def read_text(path: Path) -> str:
    return path.read_bytes().decode(errors="replace")


def execute(text: str, options: Any) -> str:
    """Its outcome, in few words. A text that takes too long ends this program by SIGALRM, Python's own loops
    included."""
    signal.setitimer(signal.ITIMER_REAL, float(options.get("timeout", 10)))
    try:
        before = parameter_file.parameters_in(text)
    except parameter_file.ParameterError as refusal:
        return re.sub(r"'.*'|\d+", "", str(refusal))
    if not before:
        return "nothing"
    last = list(before)[-1]
    now = parameter_file.parameters_in(parameter_file.with_parameters(text, {last: "42"}))
    if list(now.items()) != [*list(before.items())[:-1], (last, 42.0)]:
        raise AssertionError(f"after {last} was set to 42, these were read: {now}; before: {before}")
    return f"{min(len(before), 9)} entries, {sorted({type(value).__name__ for value in before.values()})}"


def mutate(texts: Any, options: Any) -> tuple[Any, Any]:
    """The texts kept, by outcome, and how many were tried."""
    random.seed(int(options.get("seed", time.time_ns())))
    words = EXTREMES + dictionary(options)
    longest, found = int(options["max_len"]), Path(options["artifact_prefix"])
    end = time.monotonic() + float(options["max_total_time"])
    pieces = [text[:longest] for text in texts] or [""]
    kept, executed = {}, 0
    with Running(found / "running", 4 * longest) as running:
        while time.monotonic() < end:
            text = mutated(random.choice(pieces), pieces, words)[:longest]
            running.note(text)
            outcome = execute(text, options)
            executed += 1
            if outcome not in kept:
                kept[outcome] = text
                pieces.append(text)
    signal.setitimer(signal.ITIMER_REAL, 0)
    return kept, executed


class Running:
    """Keeps the text that is being tried in a file, which stays where this program is ended."""

    def __init__(self, path: Path, size: Any) -> None:
        self.path, self.size = path, size

    def __enter__(self) -> Any:
        self.path.write_bytes(bytes(self.size))
        with self.path.open("r+b") as file:
            self.memory = mmap.mmap(file.fileno(), self.size)
        return self

    def note(self, text: str) -> None:
        self.memory[:] = text.encode(errors="replace").ljust(self.size, b" ")

    def __exit__(self, problem: Any, *_: Any) -> None:
        self.memory.close()
        if problem is None:
            self.path.unlink()


def dictionary(options: Any) -> list[str]:
    lines = Path(options["dict"]).read_text().splitlines() if "dict" in options else []
    return [line[1:-1].encode().decode("unicode_escape") for line in lines if line.startswith('"')]


def mutated(text: str, pieces: Any, words: Any) -> Any:
    for _ in range(random.choice((1, 1, 1, 2, 3, 6))):
        at = random.randint(0, len(text))
        up_to = min(len(text), at + random.choice((1, 1, 2, 5, 20, 100)))
        kind = random.randrange(7)
        if kind == 0:
            new = random.choice(words)
        elif kind == 1:
            new = chr(random.choice((random.randrange(128), random.randrange(0x800), random.randrange(0x2000, 0x2100))))
        elif kind == 2:
            new = text[at:up_to] * 2
        elif kind == 3:
            other = random.choice(pieces)
            start = random.randint(0, len(other))
            new = other[start : start + random.randint(0, 60)]
        elif kind == 4:
            new, up_to = random.choice(words) * random.randint(1, 30), at
        elif kind == 5:
            new = text[at:up_to][::-1]
        else:
            new = ""
        text = text[:at] + new + text[up_to:]
    return text


def coverage(texts: Any) -> tuple[int, int]:
    """Lines of the parser that the texts reach, and all of its lines."""
    files = {module.__file__: module for module in (parameter_file, arithmetic)}
    reached = set()

    def trace(frame: Any, event: Any, _: Any) -> Any:
        if frame.f_code.co_filename in files:
            reached.add((frame.f_code.co_filename, frame.f_lineno))
            return trace
        return None

    sys.settrace(trace)
    try:
        for text in texts:
            execute(text, {})
    finally:
        sys.settrace(None)
        signal.setitimer(signal.ITIMER_REAL, 0)
    all_ = {
        (file, line)
        for file, module in files.items()
        for value in vars(module).values()
        if getattr(value, "__module__", None) == module.__name__ and hasattr(value, "__code__")
        for _, line in dis.findlinestarts(value.__code__)
        if line != value.__code__.co_firstlineno
    }
    return len(reached & all_), len(all_)


if __name__ == "__main__":
    main()
