"""The environment of scripts/environment, for Python programs that start ours or OpenFOAM's."""

import functools
import os
import subprocess
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
REPOSITORY = SCRIPTS.parent


def load() -> None:
    """Sets it for this process and all that it starts. SystemExit where nothing has been built."""
    said = subprocess.run(
        ["bash", "-c", '. "$0" && env -0', str(SCRIPTS / "environment")], stdout=subprocess.PIPE, check=True
    )
    for entry in said.stdout.decode().split("\0"):
        name, equals, value = entry.partition("=")
        if equals:
            os.environ[name] = value
    if not program("pimpleDemFoam").exists():
        raise SystemExit(f"there is no {program('pimpleDemFoam')}: run {SCRIPTS}/setup")


def program(name: str) -> Path:
    """One of ours."""
    return build() / "bin" / name


def build() -> Path:
    return Path(os.environ.get("CLEPSYDRA_BUILD", REPOSITORY / "build"))


@functools.cache
def commit() -> str:
    """Of this repository, with `-dirty` where files differ from it; "unknown" outside a clone."""
    described = subprocess.run(
        ["git", "-C", REPOSITORY, "describe", "--always", "--dirty", "--exclude=*"], capture_output=True, text=True
    )
    return described.stdout.strip() or "unknown"
