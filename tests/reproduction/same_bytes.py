#!/usr/bin/python3
"""scripts/reproduce/all writes the committed pictures, numbers and comparison to the last byte: on this processor, and
where numpy, the C library and a library of linear algebra have to do without its wider instructions.

usage: same_bytes.py [-v] """

import filecmp
import os
import subprocess
import tempfile
import unittest
from pathlib import Path
from typing import Any

import matplotlib
from numpy.core._multiarray_umath import __cpu_dispatch__ as numpy_features
from numpy.core._multiarray_umath import __cpu_features__ as found

REPOSITORY = Path(__file__).resolve().parents[2]
RESULTS = REPOSITORY / "cases" / "paper" / "results"
PICTURES_ARE_OF = "3.6.3"  # the matplotlib of Debian 12; others draw some pixels otherwise
OLD_PROCESSOR = {
    "NPY_DISABLE_CPU_FEATURES": " ".join(name for name in numpy_features if found[name]),
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-AVX512F,-FMA,-FMA4",
    "OPENBLAS_CORETYPE": "Prescott",
    "OPENBLAS_NUM_THREADS": "1",
}


class SameBytes(unittest.TestCase):
    def test_this_processor(self) -> None:
        self.check({})

    def test_an_old_processor(self) -> None:
        self.check(OLD_PROCESSOR)

    def check(self, environment: Any) -> None:
        with tempfile.TemporaryDirectory() as folder:
            made = Path(folder)
            subprocess.run(
                [REPOSITORY / "scripts" / "reproduce" / "all", "--into", made],
                env=os.environ | environment,
                stdout=subprocess.DEVNULL,
                check=True,
            )
            committed = {path.name: path for path in [*(RESULTS / "figures").iterdir(), RESULTS / "reproduction.json"]}
            self.assertEqual({path.name for path in made.iterdir()}, set(committed))
            if matplotlib.__version__ != PICTURES_ARE_OF:
                committed = {name: path for name, path in committed.items() if path.suffix != ".png"}
            different = [name for name, path in committed.items() if not filecmp.cmp(path, made / name, shallow=False)]
            self.assertEqual(different, [], "run scripts/reproduce/all and commit what it writes")


unittest.main()
