"""Building the fuzzers of tests/fuzz: by clang, into a folder of their own."""

import subprocess
import tempfile
from pathlib import Path
from typing import Any, Iterable

from clepsydra.environment import REPOSITORY


def fuzzers_can_be_built() -> bool:
    """Whether clang++ is here together with its libraries of fuzzing and sanitizers."""
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "target.cpp"
        source.write_text('extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }\n')
        command = ["clang++", "-fsanitize=fuzzer,address,undefined", str(source), "-o", str(Path(folder) / "target")]
        try:
            return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0
        except FileNotFoundError:
            return False


def build(folder: Path, targets: Iterable[str]) -> None:
    programs = [f"fuzz.{name}" for name in targets if not is_python(name)]
    if not (folder / "build.ninja").exists():
        quietly(
            [
                "cmake",
                "-S",
                REPOSITORY,
                "-B",
                folder,
                "-G",
                "Ninja",
                "-DCMAKE_CXX_COMPILER=clang++",
                "-DCLEPSYDRA_FUZZ=ON",
                "-DCLEPSYDRA_WERROR=OFF",
            ]
        )
    if programs:
        quietly(["cmake", "--build", folder, "--target", *programs])


def is_python(name: str) -> bool:
    return (REPOSITORY / f"tests/fuzz/targets/{name}.py").exists()


def quietly(command: list[Any]) -> None:
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        raise SystemExit(f"fuzz: {' '.join(map(str, command))} failed:\n{done.stdout[-5000:]}")
