"""The environment of scripts/environment, for Python programs that start ours or OpenFOAM's."""

import os
import subprocess
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[1]
REPOSITORY = SCRIPTS.parent


def load():
    """Sets it for this process and all that it starts. SystemExit where nothing has been built."""
    said = subprocess.run(
        ["bash", "-c", '. "$0" && env -0', str(SCRIPTS / "environment")], stdout=subprocess.PIPE, check=True
    )
    os.environ.update(entry.split("=", 1) for entry in said.stdout.decode().split("\0") if "=" in entry)
    if not program("pimpleDemFoam").exists():
        raise SystemExit(f"there is no {program('pimpleDemFoam')}: run {SCRIPTS}/setup")


def program(name):
    """One of ours."""
    return build() / "bin" / name


def build():
    return Path(os.environ.get("CLEPSYDRA_BUILD", REPOSITORY / "build"))
