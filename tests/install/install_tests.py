#!/usr/bin/python3
"""What `cmake --install` and `cpack -G DEB` leave: programs and cases that need neither this repository nor its build.

usage: installTests.py BUILD [unittest's options]

The programs run where an empty file system lies over the repository, the build and OpenFOAM's headers; in a shell that
has HOME and PATH and nothing else. Where the machine does not let us mount, that cover is missing. """

import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(sys.argv.pop(1)).resolve()
DEPENDENCIES = Path(os.environ.get("CLEPSYDRA_DEPENDENCIES", ROOT / ".dependencies")).resolve()
PATH = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"


def covered(script: Any, folders: Any) -> list[str]:
    """The script, with nothing to be seen of these folders."""
    mounts = "; ".join(f"mount -t tmpfs none {folder}" for folder in sorted(folders, reverse=True) if folder.is_dir())
    may_mount = subprocess.run(["unshare", "--mount", "true"], capture_output=True).returncode == 0
    return (
        ["unshare", "--mount", "bash", "-c", f"set -e; {mounts}; {script}"]
        if may_mount
        else ["bash", "-c", f"set -e; {script}"]
    )


class Installed(unittest.TestCase):
    folder: Path
    prefix: Path
    shared: Path

    @classmethod
    def setUpClass(cls) -> None:
        folder = tempfile.TemporaryDirectory(prefix="clepsydra-install-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.unpack()
        cls.shared = cls.prefix / "share/clepsydra"

    @classmethod
    def unpack(cls) -> None:
        cls.prefix = cls.folder / "usr"
        subprocess.run(["cmake", "--install", BUILD, "--prefix", cls.prefix], check=True, stdout=subprocess.DEVNULL)

    def types(self, script: Any, covering: Any = (BUILD, DEPENDENCIES, ROOT)) -> Any:
        done = subprocess.run(
            covered(f"cd {self.folder}; {script}", covering),
            capture_output=True,
            text=True,
            stdin=subprocess.DEVNULL,
            env={"HOME": str(self.folder), "PATH": PATH},
        )
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        return done.stdout

    def test_programs_start_by_their_names(self) -> None:
        self.assertIn("Usage: pimpleDemFoam", self.types("usr/bin/pimpleDemFoam -help"))
        self.assertIn("DiFeliceDrag", self.types("usr/bin/closures dragLaws"))
        self.assertIn("study", self.types("usr/bin/traceResidual --help"))

    def test_manual_pages(self) -> None:
        for program, words in (
            ("pimpleDemFoam", ("-listModels", "DiFeliceDrag", "massInHopper")),
            ("traceResidual", ("plan",)),
            ("closures", ("terminalVelocity",)),
        ):
            page = subprocess.run(
                (
                    ["man", "-l", self.prefix / f"share/man/man1/{program}.1"]
                    if shutil.which("man")
                    else ["cat", self.prefix / f"share/man/man1/{program}.1"]
                ),
                check=True,
                capture_output=True,
                text=True,
            ).stdout
            for word in words:
                self.assertIn(word, page.replace("\\-", "-"))

    def test_completions(self) -> None:
        for program, typed, before, completed in (
            ("pimpleDemFoam", ["-listM"], "", ["-listModels"]),
            ("traceResidual", ["pl"], "", ["plan"]),
            ("closures", ["drag", "--dragL"], "drag", ["--dragLaw"]),
            ("closures", ["drag", "--dragLaw", "DiF"], "--dragLaw", ["DiFeliceDrag"]),
        ):
            words = " ".join([program, *typed])
            said = self.types(
                f"export PATH={self.prefix}/bin:$PATH; . {self.prefix}/share/bash-completion/completions/{program};"
                f" complete -p {program} > /dev/null; COMP_WORDS=({words}); COMP_CWORD={len(typed)};"
                f' _clepsydra_complete {program} {typed[-1]} {before or program}; printf "%s\\n" "${{COMPREPLY[@]}}"'
            )
            self.assertEqual(said.split(), completed)

    def test_copied_case_runs(self) -> None:
        self.types(
            f"cp -r {self.shared}/cases/tutorials/settlingParticle particle; . {self.shared}/scripts/environment;"
            f" particle/Allrun; {self.shared}/scripts/plotParticle particle particle.png"
        )
        last = (
            (self.folder / "particle/postProcessing/particleHeight/0/particleHeight.dat")
            .read_text()
            .splitlines()[-1]
            .split()
        )
        self.assertAlmostEqual(float(last[2]), -0.268, delta=0.003)

    def test_force_of_ones_own(self) -> None:
        """A particle that a force of a user's library holds against its buoyant weight stays where it is."""
        shutil.copytree(ROOT / "tests/install/ownForce", self.folder / "ownForce")
        shutil.copytree(self.shared / "cases/tutorials/settlingParticle", self.folder / "held")
        weight = math.pi / 6 * 2e-3**3 * (2500 - 1000) * 9.81
        self.replace(
            "held/constant/couplingProperties",
            "Archimedes virtualMassForce",
            "Archimedes ConstantForce virtualMassForce",
        )
        self.replace(
            "held/constant/couplingProperties",
            "virtualMassForceProps",
            f"ConstantForceProps {{ force (0 0 {weight:.12e}); }}\nvirtualMassForceProps",
        )
        self.replace(
            "held/system/controlDict",
            "functions\n",
            'libs ("$FOAM_CASE/../ownForce/build/libownForce.so");\nfunctions\n',
        )
        # A user's own copy of the headers: set-up puts them into this repository, which is covered.
        headers = self.folder / "headers"
        if DEPENDENCIES.is_dir():
            shutil.copytree(DEPENDENCIES, headers, symlinks=True)
        self.types(
            f"export CLEPSYDRA_DEPENDENCIES={headers}; cmake -S ownForce -B ownForce/build"
            f" -DCMAKE_PREFIX_PATH={self.prefix} > log.cmake; cmake --build ownForce/build > log.build; ."
            f" {self.shared}/scripts/environment; held/Allrun"
        )
        self.assertIn("ConstantForce: 6.16", (self.folder / "held/log.pimpleDemFoam").read_text())
        last = (
            (self.folder / "held/postProcessing/particleHeight/0/particleHeight.dat")
            .read_text()
            .splitlines()[-1]
            .split()
        )
        self.assertLess(abs(float(last[2])), 1e-8)

    def replace(self, file: str, old: Any, new: Any) -> None:
        text = (self.folder / file).read_text()
        self.assertIn(old, text)
        (self.folder / file).write_text(text.replace(old, new, 1))

    def test_copied_hopper_makes_its_mesh(self) -> None:
        said = self.types(
            f"cp -r {self.shared}/cases/tutorials/hopperQuick hopper; . {self.shared}/scripts/environment;"
            " hopper/Allrun mesh; hopper/Allrun check"
        )
        self.assertIn("The case would start", said)

    def test_setup_has_nothing_to_do(self) -> None:
        self.assertEqual(self.types(f"{self.shared}/scripts/setup"), "")

    def test_results_of_runs_here_stay_here(self) -> None:
        tracked = set(
            subprocess.run(["git", "-C", ROOT, "ls-files"], check=True, capture_output=True, text=True).stdout.split(
                "\n"
            )
        )
        installed = {
            str(path.relative_to(self.shared)) for path in (self.shared / "cases").rglob("*") if path.is_file()
        }
        self.assertTrue(installed)
        self.assertEqual(installed - tracked, set())
        # No case needs the record of the blind test.
        self.assertEqual([name for name in installed if "blindHopper" in name], [])


class Package(Installed):
    """The same from the package, unpacked beside what is there; as far as it is not shown by its files being the
    same."""

    package: Path

    test_manual_pages = None  # type: ignore[assignment]
    test_completions = None  # type: ignore[assignment]
    test_force_of_ones_own = None  # type: ignore[assignment]
    test_copied_hopper_makes_its_mesh = None  # type: ignore[assignment]
    test_results_of_runs_here_stay_here = None  # type: ignore[assignment]

    @classmethod
    def unpack(cls) -> None:
        subprocess.run(
            ["cpack", "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder / "packed"],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        cls.package = next((cls.folder / "packed").glob("clepsydra_*.deb"))
        subprocess.run(["dpkg-deb", "-x", cls.package, cls.folder / "unpacked"], check=True)
        (cls.folder / "usr").symlink_to("unpacked/usr")
        cls.prefix = cls.folder / "usr"

    def test_holds_what_is_installed(self) -> None:
        """All files of `cmake --install`, byte by byte but for the programs, from which debugging symbols are
        stripped."""
        installed = self.folder / "installed"
        subprocess.run(["cmake", "--install", BUILD, "--prefix", installed], check=True, stdout=subprocess.DEVNULL)
        files = [
            {
                path.relative_to(root): path
                for path in root.rglob("*")
                if path.is_file() and path.parent.name != "__pycache__"  # of the commands that were run
            }
            for root in (installed, self.prefix)
        ]
        self.assertGreater(len(files[0]), 100)
        self.assertEqual(set(files[0]), set(files[1]))
        for name, path in files[0].items():
            content, packed = path.read_bytes(), files[1][name].read_bytes()
            if not content.startswith(b"\x7fELF"):
                self.assertEqual(content, packed, name)

    def test_package_conflicts_with_para_views_python(self) -> None:
        """Else apt, which liggghts recommends ParaView to, finds no way to install ours."""
        conflicts = subprocess.run(
            ["dpkg-deb", "-f", self.package, "Conflicts"], check=True, capture_output=True, text=True
        ).stdout
        self.assertIn("python3-paraview", conflicts)

    def test_package_names_what_it_needs(self) -> None:
        depends = subprocess.run(
            ["dpkg-deb", "-f", self.package, "Depends"], check=True, capture_output=True, text=True
        ).stdout
        for needed in ("openfoam", "liggghts", "libliggghts3", "libvtk9", "openmpi-bin", "python3-vtk9"):
            self.assertIn(needed, depends)


if __name__ == "__main__":
    unittest.main()
