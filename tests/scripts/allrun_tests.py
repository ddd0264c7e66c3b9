"""cases/tutorials/hopperQuick/Allrun as its user meets it: stops, changed parameters, mistakes. The solver is a
surrogate; seconds."""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import unittest
import unittest.mock
from typing import Any, Iterator

from hopper_case import HopperCase

from clepsydra import hopper_run, parameter_file


class Stops(HopperCase):
    def test_ctrl_c_and_sigterm_write_a_checkpoint_and_the_plain_command_goes_on(self) -> None:
        """Stopped in the filling by Ctrl-C, then in the discharge by SIGTERM: each time the solver itself was asked,
        the status tells which, and the plain `Allrun` goes on: no row is lost or doubled and the filling is not done
        again. An Allrun that wipes first would start the filling three times; one that knows no SIGINT would end with
        another status and no word."""
        status, said = self.interrupted(by=signal.SIGINT, steps=["filling"])
        self.assertEqual(status, 130, said)
        self.assertIn("stopped; the same command resumes the run", said)
        self.assertIn("Asked to stop", (self.case / "steps/filling/log.pimpleDemFoam").read_text())
        status, said = (
            self.interrupted(by=signal.SIGTERM, steps=["dry", "submerged"])
            if self.filling_is_done()
            else (None, "no filling")
        )
        self.assertEqual(status, 143, said)
        self.succeeds()
        self.assertFalse((self.folder / "setupWasCalled").exists())
        self.assertEqual(sorted(self.starts()), ["dry", "dry", "filling", "filling", "submerged", "submerged"])
        self.assertEqual([self.rows(step) for step in ("filling", "dry", "submerged")], [20, 20, 20])

    def filling_is_done(self) -> bool:
        self.succeeds("filling")
        return True

    def test_a_stopped_filling_is_not_discharged(self) -> None:
        """All particles lie in the hopper, yet the filling was stopped: discharging must be refused, with the command
        that goes on."""
        self.interrupted("mesh", "filling", by=signal.SIGTERM, steps=["filling"])
        said = self.refuses("dry")
        self.assertIn("the filling has not come to its end: './Allrun filling' resumes it", said)
        self.assertEqual(self.starts(), ["filling"])
        self.succeeds("filling", "dry")
        self.assertEqual(self.starts(), ["filling", "filling", "dry"])

    def test_a_packing_of_an_earlier_filling_does_not_count(self) -> None:
        """A filling that goes on, for its time was raised, and is stopped leaves no packing, though one was there
        before."""
        self.succeeds("mesh", "filling")
        table = self.table("filling")
        table.write_text("".join(table.read_text().splitlines(keepends=True)[:5]))
        self.set(fillingTime=2)
        self.interrupted("filling", by=signal.SIGTERM, steps=["filling"])
        self.assertIn("the filling has not come to its end", self.refuses("dry"))

    def test_done_is_not_done_again_unless_asked_to(self) -> None:
        self.succeeds()
        (self.case / "results" / "mine").touch()
        self.assertIn("dry: done before", self.succeeds())
        self.assertEqual(len(self.starts()), 3)
        self.assertTrue((self.case / "results" / "mine").exists())
        self.succeeds("-fresh")
        self.assertEqual(len(self.starts()), 6)
        self.assertFalse((self.case / "results" / "mine").exists())

    def test_changed_parameters_are_not_mixed_into_a_stopped_run(self) -> None:
        """Named with both ways out, and nothing is touched; what only says how long or how often may change."""
        self.interrupted(by=signal.SIGINT, steps=["filling"])
        self.set(friction=0.3)
        for arguments in ((), ("filling",)):
            said = self.refuses(*arguments)
            self.assertIn("friction 0.15 -> 0.3", said)
            self.assertIn("Put them back and the same command resumes", said)
            self.assertIn("./Allrun -fresh", said)
        self.assertEqual(self.starts(), ["filling"])
        self.assertEqual(self.rows("filling"), 10)
        self.set(friction=0.15, dryTime=5)
        self.succeeds()
        self.assertEqual(self.rows("filling"), 20)

    def test_another_mesh_or_packing_than_the_parameters_say_is_not_used(self) -> None:
        """A friction of the discharge's own is allowed: one packing serves all frictions. Other particles or cells are
        not."""
        self.succeeds("mesh", "filling")
        self.set(friction=0.3)
        self.succeeds("dry")
        self.set(particleDiameter=1.9e-3)
        self.assertIn("particleDiameter 0.002 -> 0.0019", self.refuses("submerged"))
        self.set(particleDiameter=2e-3, cellSize=2e-3)
        self.assertIn("'./Allrun mesh' makes another", self.refuses("submerged"))


class Results(HopperCase):
    def test_without_particles_written_all_but_their_picture_is_made(self) -> None:
        """What draws particles fails here, as it does where none were written; with particles it is called, and its
        failure reported."""
        self.program(self.folder / "scripts" / "renderFlow", "#!/bin/sh\nexit 1\n")
        self.refuses()
        self.set(drawParticles="off")
        self.succeeds()
        self.assertTrue((self.case / "results" / "summary.json").exists())


class Ranks(HopperCase):
    def test_their_boxes_all_reach_the_particles(self) -> None:
        """As many as ranks, side by side, as near to a square as their number allows; said once however often a step is
        prepared, also for a step that was begun when there were slabs only. Strips for all numbers of ranks fail at 4,
        a second say at the second number."""
        shares = {1: (1, 1), 2: (2, 1), 3: (3, 1), 4: (2, 2), 6: (3, 2), 8: (4, 2), 12: (4, 3), 16: (4, 4)}
        step = self.case / "steps" / "dry" / "step"
        for ranks, along in shares.items():
            self.prepare("dry", ranks)
            said = re.findall(r"^(ranks\w*) +(\d+);$", step.read_text(), re.MULTILINE)
            expected = [("ranks", ranks), *zip(("ranksAlongX", "ranksAlongY", "ranksAlongZ"), (*along, 1))]
            self.assertEqual(said, [(name, str(number)) for name, number in expected])
        text = (self.case / "step.dry").read_text()
        step.write_text(text + "ranks           4;\n")
        self.prepare("dry", 4)
        self.assertTrue(step.read_text().startswith(text))
        self.assertIn("ranksAlongY     2;\n", step.read_text())

    def test_other_ranks_keep_the_fields_of_all_times(self) -> None:
        """From two ranks to four: the times that two ranks have written, not those of one rank before, are put together
        before decomposePar removes the folders of the old ranks; one that is not whole is not."""
        step = self.folder / "step"
        for time, marker in (("0.1", "complete"), ("0.2", "complete"), ("0.3", "complete"), ("0.4", "beginning")):
            (step / "checkpoints" / time).mkdir(parents=True)
            (step / "checkpoints" / time / marker).touch()
        (step / "0.1").mkdir()
        (step / "ranksOnDisk").write_text("2\n")
        for name in ("reconstructPar", "decomposePar"):
            self.program(self.folder / "bin" / name, f'#!/bin/sh\necho {name} "$@" >> {self.folder}/calls\n')
        openfoam = next((self.folder / "dependencies").iterdir())
        path = f"{self.folder / 'bin'}:{os.environ['PATH']}"
        with unittest.mock.patch.dict(os.environ, {"PATH": path, "WM_PROJECT_DIR": str(openfoam)}):
            hopper_run.Step(step).redistribute(4)
        self.assertEqual(
            (self.folder / "calls").read_text(),
            "reconstructPar -time 0.2,0.3\ndecomposePar -force -time 0.3\n",
        )
        self.assertEqual((step / "ranksOnDisk").read_text(), "4\n")

    def prepare(self, step: Any, ranks: int) -> None:
        self.succeeds("-np", str(ranks), "-prepare", step)


class Mistakes(HopperCase):
    """Each must be reported in a line that names file and entry, and what is allowed, before anything is made."""

    def expect_refused(self, *words: Any, arguments: Any = ()) -> None:
        before = sorted(self.case.rglob("*"))
        said = self.refuses(*arguments)
        for word in words:
            self.assertIn(word, said)
        self.assertEqual(sorted(self.case.rglob("*")), before)

    @contextlib.contextmanager
    def other_parameters(self, change: Any) -> Iterator[Any]:
        path = self.case / "parameters"
        text = path.read_text()
        path.write_text(change(text))
        try:
            with self.subTest():
                yield
        finally:
            path.write_text(text)

    @staticmethod
    def other_line(name: str, line: Any) -> Any:
        return lambda text: re.sub(rf"(?m)^{name} .*$", lambda _: line, text)

    def test_mistyped_entries(self) -> None:
        for name, line, words in (
            ("friction", "friction ;", ["parameters:14: entry 'friction' has no value"]),
            (
                "friction",
                "friction 0.15",
                ["parameters:14: 'friction 0.15' is no entry; allowed: one `name value;` a line"],
            ),
            ("friction", "friction 0.15; friction 0.2;", ["parameters:14: entry 'friction' is there twice"]),
            (
                "friction",
                "",
                ["entry 'frictionWall' is $friction, which refers to no entry above it", "entry 'friction' is missing"],
            ),
            ("friction", "friction 0.15; fricton 0.2;", ["'fricton' is unknown (is 'friction' meant?)"]),
            ("friction", "friction nan;", ["entry 'friction' is nan; allowed: a number from 0 to 10"]),
            ("friction", "friction 1e400;", ["entry 'friction' is 1e400; allowed: numbers up to"]),
            (
                "particleDiameter",
                "particleDiameter 25mm;",
                ["entry 'particleDiameter' is 25mm, which has a unit; allowed: a number", "[m]"],
            ),
            (
                "particleDiameter",
                "particleDiameter 2;",
                ["entry 'particleDiameter' is 2; allowed: a number from 1e-05 to 0.1 [m]"],
            ),
            ("particleDensity", "particleDensity 1e308;", ["entry 'particleDensity' is 1e+308; allowed"]),
            (
                "mesher",
                "mesher ../../bin/sh;",
                ["entry 'mesher' is ../../bin/sh; allowed: hopperInTank, hopperBySnappy, hopperFromSurface"],
            ),
            ("seed", "seed 100004;", ["entry 'seed' is 100004; allowed: a prime"]),
            ("seed", "seed 10007;", ["entry 'seed' is 10007; allowed: a prime from 11003"]),
        ):  # a particle template has it
            with self.other_parameters(self.other_line(name, line)):
                self.expect_refused("parameters", *words)
        with self.other_parameters(self.other_line("friction", "friction x;")):
            for arguments in (["check"], ["mesh"], ["filling"], ["dry"]):
                self.expect_refused("entry 'friction' is x; allowed: a number from 0 to 10", arguments=arguments)

    def test_sizes_against_each_other(self) -> None:
        wrong: list[tuple[dict[str, float], list[str]]] = [
            ({"orificeDiameter": 1.5e-3}, ["particles (0.002 m) cannot pass orificeDiameter 0.0015 m"]),
            ({"hopperDiameter": 25, "orificeDiameter": 10}, ["entry 'hopperDiameter' is 25; allowed", "[m]"]),
            (
                {"hopperDiameter": 0.25, "tankDiameter": 0.7, "tankDepth": 0.4, "hopperHeight": 0.65, "cellSize": 1e-5},
                ["cells, which need", "Are all lengths in metres?"],
            ),
            ({"demStep": 1e-4}, ["demStep 0.0001 s is 0.83 of the Rayleigh time"]),
            ({"couplingTimeStep": 0.2}, ["couplingTimeStep 0.2 s", "cells in it; allowed: 10"]),
            ({"couplingTimeStep": 1.99e-3}, ["is 49.75 demSteps of 4e-05 s; allowed: a whole number"]),
            ({"smoothingBandwidth": 6}, ["smoothingBandwidth 6 m; allowed: at most hopperDiameter"]),
            ({"particleCount": 30000}, ["particleCount 30000 particles lie at least"]),
        ]
        for values, words in wrong:
            with self.other_parameters(
                lambda text: parameter_file.with_parameters(text, {name: str(value) for name, value in values.items()})
            ):
                self.expect_refused("parameters", *words)

    def test_far_too_many_ranks(self) -> None:
        for ranks, word in (
            ("20000", "20000 ranks; allowed: 1 to"),
            ("0", "not '0'"),
            ("two", "not 'two'"),
            ("-1", "not '-1'"),
        ):
            self.assertIn(word, self.refuses("-np", ranks, "mesh"))

    def test_nothing_in_parameters_is_run(self) -> None:
        """A value that the old scripts handed to sed, to awk or to a shell as code, which then made the file."""
        made = self.folder / "made"
        for value in (f"x $(touch {made})|e #", f"0.1|e touch {made}", f"`touch {made}`", f'system("touch {made}")'):
            with self.other_parameters(self.other_line("friction", f"friction {value};")):
                self.refuses("mesh")
                functions = f"cd {self.case}; repository={self.folder}; . {self.folder}/scripts/runFunctions; "
                for use in (
                    f"setParameter step.dry stepEndTime {chr(39)}{value}{chr(39)}",
                    "cp parameters other; parameterFile merge other parameters",
                    'at "$(parameter friction)"',
                ):
                    subprocess.run(["bash", "-c", functions + use], env=self.environment, capture_output=True)
                self.assertFalse(made.exists())

    def test_an_absent_program_is_named(self) -> None:
        """And not the end of the log that it left when it was there."""
        self.succeeds("mesh", "filling")
        log = self.case / "steps" / "dry" / "log.pimpleDemFoam"
        self.interrupted("dry", by=signal.SIGTERM, steps=["dry"])
        before = log.read_text()
        (self.folder / "bin" / "pimpleDemFoam").unlink()
        said = self.refuses("dry")
        self.assertIn("there is no program 'pimpleDemFoam' here: run", said)
        self.assertNotIn("Asked to stop", said)
        self.assertEqual(log.read_text(), before)
        (self.case / "log.noMesher").write_text("an old log\n")
        outcome = subprocess.run(
            [
                "bash",
                "-c",
                f"cd {self.case}; repository={self.folder}; . {self.folder}/scripts/runFunctions; logged noMesher",
            ],
            env=self.environment,
            capture_output=True,
            text=True,
        )
        self.assertNotEqual(outcome.returncode, 0)
        self.assertIn("there is no program 'noMesher' here: run", outcome.stderr)
        self.assertNotIn("an old log", outcome.stderr)

    def test_a_mesh_that_check_mesh_has_not_seen_is_not_used(self) -> None:
        """What an interrupted `Allrun mesh` leaves."""
        (self.case / "constant" / "polyMesh").mkdir()
        for part in ("filling", "dry"):
            self.assertIn("there is no whole mesh here: './Allrun mesh' makes it", self.refuses(part))

    def test_a_space_in_the_path(self) -> None:
        self.lay_out(self.folder / "with space")
        said = self.refuses("mesh")
        self.assertIn("has a space or a quote in it, which OpenFOAM cannot bear; move it", said)
        self.assertFalse((self.case / "steps").exists())

    def test_check_makes_nothing(self) -> None:
        before = sorted(self.case.rglob("*"))
        said = self.succeeds("check")
        self.assertIn("3000 of 2 mm", said)
        self.assertIn("cells (hopperInTank); memory: some", said)
        self.assertEqual(sorted(self.case.rglob("*")), before)
        self.succeeds("mesh", "filling")
        before = sorted(self.case.rglob("*"))
        self.assertIn("step submerged", self.succeeds("check"))
        self.assertEqual(sorted(self.case.rglob("*")), before)


class Quickstart(HopperCase):
    """The front page's first command."""

    def quickstart(self, *arguments: Any) -> Any:
        return subprocess.run(
            [self.folder / "scripts/quickstart", *arguments],
            env=self.environment,
            capture_output=True,
            text=True,
            stdin=subprocess.DEVNULL,
            timeout=60,
        )

    def test_it_sets_up_and_then_runs_the_hopper(self) -> None:
        """In this order: where set-up fails nothing is run. It says where the results are."""
        outcome = self.quickstart()
        self.assertEqual(outcome.returncode, 1)
        self.assertFalse((self.case / "starts").exists())
        self.program(self.folder / "scripts" / "setup", f'#!/bin/sh\necho "$*" > {self.folder}/options\n')
        outcome = self.quickstart()
        self.assertEqual(outcome.returncode, 0, outcome.stdout + outcome.stderr)
        self.assertEqual((self.folder / "options").read_text(), "--programs\n")
        self.assertEqual(sorted(self.starts()), ["dry", "filling", "submerged"])
        self.assertIn(f"the results are in {self.case}/results", outcome.stdout)

    def test_help_makes_nothing(self) -> None:
        for option, status in (("--help", 0), ("-h", 0), ("--fast", 2)):
            outcome = self.quickstart(option)
            self.assertEqual(outcome.returncode, status)
            self.assertIn("usage: scripts/quickstart", outcome.stdout + outcome.stderr)
        self.assertFalse((self.folder / "setupWasCalled").exists())


class Copies(HopperCase):
    """Cases that were copied out of the repository."""

    def test_a_copy_elsewhere_finds_clepsydra_or_says_how(self) -> None:
        elsewhere = self.folder / "far/away/from/it/copy"
        shutil.copytree(self.case, elsewhere)
        self.case = elsewhere
        self.assertIn("source its scripts/environment first", self.refuses("mesh"))
        self.environment["CLEPSYDRA"] = str(self.folder)
        self.succeeds("mesh", "filling")
        self.assertEqual(self.starts(), ["filling"])


if __name__ == "__main__":
    unittest.main()
