"""The targets: where their seeds come from, and running one of them."""

import os
import re
import shutil
import subprocess
import tempfile
import time
import zipfile
from pathlib import Path
from typing import Any

from clepsydra.environment import REPOSITORY

from . import seeds
from .builds import is_python

#: What one input may take.
SECONDS_PER_INPUT = 10
MEGABYTES = 3000

# : OpenFOAM's parser loses memory where a refusal is an exception, as it is in the fuzzer; in the solver it ends the
# program.
LEAKS_EXPECTED = ("couplingProperties",)

#: By name: what it reads; a function that fills its working folder and gives the texts to begin with; the longest
#: mutation in bytes (short ones are quickest, and former finds may be longer).
TARGETS = {
    "formula": ("formulas: study/expression", seeds.formulas, 200),
    "csv": ("measured files: study/measurements, curves/table", seeds.tables, 600),
    "study": ("study files: study/readStudy", seeds.studies, 4000),
    "effects": ("libraries of effects: study/readEffects", seeds.effects, 1500),
    "entries": ("parameters, in traceResidual: study/entries", seeds.parameters, 400),
    "parameters": ("parameters, in scripts: scripts/clepsydra/parameter_file.py", seeds.parameters, 400),
    "couplingProperties": ("couplingProperties: couplingStep/couplingSettings", seeds.coupling_properties, 3000),
}

#: Targets whose mutations are made of another's dictionary.
SAME_WORDS = {"effects": "study", "entries": "parameters", "formula": "parameters"}


def run(name: str, build: Any, seconds: int) -> dict[str, Any]:
    """A row of the table. Prints what was found."""
    reads, fill, _ = TARGETS[name]
    found = build / "found" / name
    corpus = build / "corpus" / name
    for folder in (found, corpus):
        folder.mkdir(parents=True, exist_ok=True)
    began = time.monotonic()
    with working_folder() as folder:
        first = folder / "seeds"
        first.mkdir()
        for number, text in enumerate(fill(folder)):
            (first / f"seed{number}").write_text(text)
        known = former_finds(name, folder / "former")
        output = replay(name, build, folder, known + sorted(first.iterdir()))
        if not output.failed and seconds:
            output = mutate(name, build, folder, [corpus, first], found, seconds)
    if output.failed:
        print(f"{name}: FOUND, input in {found}\n{output.text[-6000:]}")
    return {
        "target": name,
        "reads": reads,
        "executions": output.executions,
        "seconds": round(time.monotonic() - began),
        "edgesReached": output.reached,
        "edges": output.edges,
        "formerFinds": len(known),
        "findings": int(output.failed),
    }


def former_finds(name: str, folder: Path) -> list[Path]:
    """The inputs on which earlier versions of a reader failed, unpacked into a folder."""
    with zipfile.ZipFile(REPOSITORY / "tests/fuzz/found.zip") as archive:
        archive.extractall(folder, [file for file in archive.namelist() if file.startswith(f"{name}/")])
    return sorted((folder / name).glob("*"))


def working_folder() -> "Folder":
    """In memory where that is to be had: each input is a file."""
    memory = Path("/dev/shm")
    return Folder(memory if os.access(memory, os.W_OK) else None)


class Folder:
    def __init__(self, parent: Path | None) -> None:
        self.parent = parent

    def __enter__(self) -> Any:
        self.path = Path(tempfile.mkdtemp(prefix="clepsydra-fuzz.", dir=self.parent))
        return self.path

    def __exit__(self, *_: Any) -> None:
        shutil.rmtree(self.path, ignore_errors=True)


def replay(name: str, build: Any, folder: Path, files: list[Path]) -> "Output":
    return Output(started(name, build, folder, [f"-timeout={SECONDS_PER_INPUT}", f"-rss_limit_mb={MEGABYTES}", *files]))


def mutate(name: str, build: Any, folder: Path, corpora: list[Path], found: Path, seconds: int) -> "Output":
    dictionary = REPOSITORY / f"tests/fuzz/dictionaries/{SAME_WORDS.get(name, name)}"
    options = [
        f"-max_total_time={seconds}",
        f"-max_len={TARGETS[name][2]}",
        f"-timeout={SECONDS_PER_INPUT}",
        f"-rss_limit_mb={MEGABYTES}",
        "-print_final_stats=1",
        f"-artifact_prefix={found}/",
    ]
    options += [f"-dict={dictionary}"] if dictionary.exists() else []
    return Output(started(name, build, folder, options + corpora))


def started(name: str, build: Any, folder: Path, arguments: list[Any]) -> subprocess.CompletedProcess[str]:
    sanitizers = REPOSITORY / "scripts/developers/sanitizers"
    variables = dict(
        os.environ,
        FOAM_CASE=str(folder),
        # Less of what makes memory slow: short stacks of allocations, and little freed memory kept from being used
        # again.
        # OpenFOAM's LList deletes its links as their base, which Clang 19 tells by the size.
        ASAN_OPTIONS=f"detect_leaks={int(name not in LEAKS_EXPECTED)}:malloc_context_size=5:quarantine_size_mb=16"
        ":new_delete_type_mismatch=0",
        LSAN_OPTIONS=f"suppressions={sanitizers}/leaks.suppressions:print_suppressions=0",
        UBSAN_OPTIONS="halt_on_error=1:print_stacktrace=1",
    )
    program = REPOSITORY / f"tests/fuzz/targets/{name}.py" if is_python(name) else build / f"bin/fuzz.{name}"
    command = ["sh", "-c", '. "$0"; exec "$@"', REPOSITORY / "scripts/environment", program, *arguments]
    return subprocess.run(
        command,
        cwd=folder,
        env=variables,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
    )


class Output:
    """What a target of libFuzzer's kind says of its run."""

    def __init__(self, done: subprocess.CompletedProcess[str]) -> None:
        self.text = done.stdout
        self.failed = done.returncode != 0
        # libFuzzer counts the mutations, and names each file that it replays.
        self.executions = self.last(r"stat::number_of_executed_units:\s*(\d+)") or self.text.count("Executed ")
        self.edges = self.last(r"\((\d+) inline 8-bit counters\)")
        self.reached = self.last(r"\bcov: (\d+)")

    def last(self, pattern: str) -> int:
        found = re.findall(pattern, self.text)
        return int(found[-1]) if found else 0
