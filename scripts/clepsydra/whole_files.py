"""Files that are there whole, or as they were before: also where the disk is full or the power fails."""

import contextlib
import os
from pathlib import Path
from typing import Any, Iterator


@contextlib.contextmanager
def replacing(path: Path | str) -> Iterator[Any]:
    """A text file to write, which takes the place of `path` once it is on disk. OSError where it cannot be written."""
    if os.path.exists(path) and not os.path.isfile(path):  # /dev/stdout, /dev/null, a pipe: nothing there to lose
        with open(path, "w") as file:
            yield file
        return
    path = Path(os.path.realpath(path))
    unfinished = path.with_name(f"{path.name}.unfinished.{os.getpid()}")
    try:
        with open(unfinished, "w") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        unfinished.rename(path)
    except BaseException:
        unfinished.unlink(missing_ok=True)
        raise
    settle(path.parent)


def write(path: Path | str, text: str) -> None:
    with replacing(path) as file:
        file.write(text)


def settle_tree(folder: Path) -> None:
    """All files below a folder are on disk when this returns."""
    for path in [*Path(folder).rglob("*"), Path(folder)]:
        if not path.is_symlink():
            settle(path)


def settle(path: Path | str) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
