"""Which OpenFOAM is taken from a sourced environment, by CMake and by scripts/setup; which is warned of, which refused.

The OpenFOAM here is a tree of empty files: nothing is compiled. An implementation that looks at no environment would
find the distribution's libraries, or none. """

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
MODULES = REPOSITORY / "cmake"

LIBRARIES = (
    "OpenFOAM fileFormats surfMesh finiteVolume meshTools incompressibleTransportModels turbulenceModels "
    "incompressibleTurbulenceModels sampling dynamicMesh dynamicFvMesh lagrangian fvOptions decompositionMethods"
).split()

PROJECT = f"""
cmake_minimum_required(VERSION 3.22)
project(User LANGUAGES CXX)
list(APPEND CMAKE_MODULE_PATH "{MODULES}")
find_package(OpenFOAM REQUIRED)
get_target_property(definitions OpenFOAM::core INTERFACE_COMPILE_DEFINITIONS)
get_target_property(libraries OpenFOAM::core INTERFACE_LINK_LIBRARIES)
message(STATUS "definitions: ${{definitions}}")
message(STATUS "libraries: ${{libraries}}")
"""

# What scripts/setup calls until it has looked at the environment; no apt-get, so that it installs nothing.
COMMANDS = "bash dirname mkdir flock date du awk sed cut grep cat".split()


class Environment(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "project").mkdir()
        (self.folder / "project" / "CMakeLists.txt").write_text(PROJECT)

    def openfoam(self, api: str | None, name: str = "openfoam") -> dict[str, str]:
        """An installed OpenFOAM, and the environment that its etc/bashrc would set."""
        root = self.folder / name
        binaries = root / "platforms" / "linux64" / "lib"
        header = root / "src" / "finiteVolume" / "lnInclude" / "fvCFD.H"
        for file in [header, binaries / "mpi" / "libPstream.so", *(binaries / f"lib{each}.so" for each in LIBRARIES)]:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.touch()
        if api is not None:
            (root / "META-INFO").mkdir()
            (root / "META-INFO" / "api-info").write_text(f"api={api}\npatch=0\n")
        return {
            "WM_PROJECT_DIR": str(root),
            "FOAM_LIBBIN": str(binaries),
            "FOAM_MPI": "mpi",
            "WM_ARCH": "linux64",
            "WM_PRECISION_OPTION": "DP",
            "WM_LABEL_SIZE": "64",
        }

    def configure(self, sourced: dict[str, str]) -> tuple[int, str]:
        """What CMake says, in one line, since it breaks its messages into lines."""
        run = subprocess.run(
            ["cmake", "-S", self.folder / "project", "-B", self.folder / "build"],
            env={"PATH": os.environ["PATH"], **sourced},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        return run.returncode, " ".join(run.stdout.split())

    def setup(self, sourced: dict[str, str]) -> tuple[int, str]:
        commands = self.folder / "commands"
        commands.mkdir(exist_ok=True)
        for command in COMMANDS:
            if not (commands / command).exists():
                (commands / command).symlink_to(str(shutil.which(command)))
        run = subprocess.run(
            [REPOSITORY / "scripts" / "setup", "--no-build"],
            env={
                "PATH": str(commands),
                "CLEPSYDRA_DEPENDENCIES": str(self.folder / "dependencies"),
                "CLEPSYDRA_BUILD": str(self.folder / "build"),
                "CLEPSYDRA_PACKAGES": "installed",
                **sourced,
            },
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        return run.returncode, run.stdout


class CMake(Environment):
    def test_takes_version_libraries_and_sizes_from_the_environment(self) -> None:
        sourced = self.openfoam("2312")
        status, said = self.configure(sourced)
        self.assertEqual(status, 0, said)
        root, libraries = sourced["WM_PROJECT_DIR"], sourced["FOAM_LIBBIN"]
        self.assertIn(f"OpenFOAM v2312: headers in {root}, libraries in {libraries}", said)
        self.assertIn("WM_LABEL_SIZE=64", said)
        self.assertIn("OPENFOAM=2312", said)
        self.assertIn(f"libraries: {libraries}/libOpenFOAM.so;{libraries}/mpi/libPstream.so;", said)
        self.assertIn("its tests have passed with v1912. Run the tests (ctest) with this v2312", said)
        self.assertNotIn("Warning", said)

    def test_says_nothing_of_a_version_that_was_tested(self) -> None:
        status, said = self.configure(self.openfoam("1912"))
        self.assertEqual(status, 0, said)
        self.assertNotIn("Run the tests", said)

    def test_keeps_the_sizes_where_the_environment_is_no_longer_sourced(self) -> None:
        """A build folder configures itself again when a CMakeLists.txt changes, in whichever shell that happens."""
        self.configure(self.openfoam("2312"))
        status, said = self.configure({})
        self.assertEqual(status, 0, said)
        self.assertIn("WM_LABEL_SIZE=64", said)
        self.assertIn("OPENFOAM=2312", said)

    def test_warns_outside_the_range_that_was_compiled(self) -> None:
        for api in ("1906", "9912"):
            with self.subTest(api):
                shutil.rmtree(self.folder / "build", ignore_errors=True)
                status, said = self.configure(self.openfoam(api, "v" + api))
                self.assertEqual(status, 0, said)
                self.assertIn("Warning", said)
                self.assertIn("Clepsydra compiles with OpenFOAM v1912 to v", said)
                self.assertIn(f"with this v{api} before", said)

    def test_refuses_what_is_not_of_esi(self) -> None:
        status, said = self.configure(self.openfoam(None))
        self.assertNotEqual(status, 0)
        self.assertIn("has no META-INFO/api-info, so it is not ESI's", said)

    def test_takes_no_library_from_elsewhere(self) -> None:
        """Where the distribution's OpenFOAM is installed as well, a search that went on would find its libraries."""
        sourced = self.openfoam("2312")
        (Path(sourced["FOAM_LIBBIN"]) / "libOpenFOAM.so").unlink()
        status, said = self.configure(sourced)
        self.assertNotEqual(status, 0)
        self.assertIn("missing: OpenFOAM_LIBRARY", said)

    def test_refuses_a_build_folder_of_another_openfoam(self) -> None:
        self.configure(self.openfoam("2312", "first"))
        status, said = self.configure(self.openfoam("2306", "second"))
        self.assertNotEqual(status, 0)
        self.assertIn(f"was configured with the OpenFOAM in {(self.folder / 'first').resolve()};", said)
        self.assertIn("Configure another build folder", said)


class Setup(Environment):
    def test_says_version_and_place(self) -> None:
        sourced = self.openfoam("2312")
        status, said = self.setup(sourced)
        self.assertEqual(status, 0, said)
        self.assertIn(f"setup: using OpenFOAM v2312 in {sourced['WM_PROJECT_DIR']}, whose environment is sourced", said)
        self.assertIn("setup: Clepsydra compiles with OpenFOAM v1912 to v", said)

    def test_says_nothing_of_a_version_that_was_tested(self) -> None:
        status, said = self.setup(self.openfoam("1912"))
        self.assertEqual(status, 0, said)
        self.assertIn("using OpenFOAM v1912", said)
        self.assertNotIn("Run the tests", said)

    def test_warns_outside_the_range_that_was_compiled(self) -> None:
        status, said = self.setup(self.openfoam("9912"))
        self.assertEqual(status, 0, said)
        self.assertIn("setup: warning: Clepsydra compiles with OpenFOAM v1912 to v", said)

    def test_refuses_an_openfoam_without_headers(self) -> None:
        sourced = self.openfoam("2312")
        shutil.rmtree(Path(sourced["WM_PROJECT_DIR"]) / "src")
        status, said = self.setup(sourced)
        self.assertNotEqual(status, 0)
        self.assertIn("has no headers to compile with", said)
        self.assertIn("openfoam2312-dev", said)

    def test_refuses_what_is_not_of_esi(self) -> None:
        status, said = self.setup(self.openfoam(None))
        self.assertNotEqual(status, 0)
        self.assertIn("has no META-INFO/api-info", said)

    def test_refuses_a_build_folder_of_another_openfoam(self) -> None:
        self.configure(self.openfoam("2312", "first"))
        status, said = self.setup(self.openfoam("2306", "second"))
        self.assertNotEqual(status, 0)
        self.assertIn(f"was configured with the OpenFOAM in {self.folder / 'first'}", said)
        self.assertIn("CLEPSYDRA_BUILD", said)


class OtherCopy(Environment):
    """The environment of one copy of Clepsydra is sourced, and another copy is used: it has an OpenFOAM of its own."""

    def setUp(self) -> None:
        super().setUp()
        sourced = self.openfoam("1912", "other/.dependencies/openfoam-1912")
        self.other = sourced["WM_PROJECT_DIR"]

    def test_environment_replaces_it_where_this_copy_has_its_own(self) -> None:
        own = self.folder / "own"
        (own / "openfoam-1912").mkdir(parents=True)
        for before, dependencies, after in (
            (self.other, own, f"{own}/openfoam-1912"),
            (self.other, self.folder / "none", self.other),
            ("/opt/openfoam2312", own, "/opt/openfoam2312"),
        ):
            for shell in ("bash", "sh"):
                said = subprocess.run(
                    [shell, "-c", '. "$CLEPSYDRA/scripts/environment"; echo "$WM_PROJECT_DIR $FOAM_ETC"'],
                    env={
                        "PATH": os.environ["PATH"],
                        "CLEPSYDRA": str(REPOSITORY),
                        "CLEPSYDRA_DEPENDENCIES": str(dependencies),
                        "WM_PROJECT_DIR": before,
                        "FOAM_ETC": f"{before}/etc",
                    },
                    capture_output=True,
                    text=True,
                ).stdout
                self.assertEqual(said, f"{after} {after}/etc\n")

    def test_setup_does_not_take_it(self) -> None:
        """This machine has no apt-get: where no OpenFOAM of the user's own is sourced, setup can go no further."""
        status, said = self.setup({"WM_PROJECT_DIR": self.other})
        self.assertNotEqual(status, 0)
        self.assertIn("no OpenFOAM environment is sourced", said)


if __name__ == "__main__":
    unittest.main()
