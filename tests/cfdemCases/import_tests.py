#!/usr/bin/python3
"""scripts/importCfdem on two cases with the structure and the parameters of CFDEMcoupling-PUBLIC's tutorials
ErgunTestMPI and settlingTestMPI. What it writes is run, and held against the law that the old case states; what it
cannot carry over is an error. The old cases are in cases.zip. """

import re
import shutil
import subprocess
import tempfile
import unittest
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, closures, environment

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


class Folder(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="clepsydra-import-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.target = self.folder / "new"
        self.old = self.folder / "old"
        with zipfile.ZipFile(HERE / "cases.zip") as cases:
            cases.extractall(self.old)

    def case(self, name: str, file: str | None = None, old: Any = "", new: Any = "") -> Any:
        """A copy of an old case, with a text in one of its files replaced."""
        copy = self.folder / name
        shutil.copytree(self.old / name, copy)
        if file:
            text = (copy / file).read_text() if (copy / file).exists() else ""
            self.assertIn(old, text)
            (copy / file).write_text(text.replace(old, new, 1))
        return copy

    def importing(self, case: Any, *options: Any) -> Any:
        return subprocess.run(
            [ROOT / "scripts/importCfdem", case, self.target, *options], capture_output=True, text=True
        )

    def imported(self, case: Any, *options: Any) -> Any:
        done = self.importing(case, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def run_(self) -> None:
        done = subprocess.run([self.target / "Allrun"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr[-3000:])


class Runs(Folder):
    """Of the new cases: within 5 % of the law."""

    def test_settling_particle(self) -> None:
        self.imported(self.old / "settlingParticle")
        self.run_()
        speed = -np.loadtxt(self.target / "DEM/post/velocity.txt")[-1, 2]
        law = closures.value(
            "terminalVelocity",
            dragLaw="DiFeliceDrag",
            particleDiameter=1e-4,
            particleDensity=3000,
            fluidDensity=10,
            fluidViscosity=1e-5,
        )
        print(f"settlingParticle: {speed:.5f} m/s, Di Felice's law {law:.5f}: {100 * (speed / law - 1):+.2f} %")
        self.assertLess(abs(speed / law - 1), 0.05)

    def test_packed_column(self) -> None:
        """Taken for a velocity between the particles, the inlet's .006 and .01 m/s would give less than half of the
        pressure drop."""
        self.imported(self.old / "packedColumn")
        self.run_()
        probes = np.loadtxt(self.target / "postProcessing/probes/0/p")
        for time, velocity in (("0.05", 0.006), ("0.1", 0.01)):
            bottom, top = probes[np.abs(probes[:, 0] - float(time)).argmin(), 1:]
            drop, law = 10 * (bottom - top), self.ergun(time, velocity)
            print(f"packedColumn at {velocity} m/s: {drop:.2f} Pa, Ergun {law:.2f}: {100 * (drop / law - 1):+.2f} %")
            self.assertLess(abs(drop / law - 1), 0.05)

    def ergun(self, time: str, velocity: float) -> Any:
        """Over the layers of cells between the two probes, which are the middles of the lowest layer and of one above
        the bed."""
        void_fraction = case_files.field(self.target, time, "voidFraction")[:, 0]  # one cell a layer
        bed = void_fraction < 0.95
        weight = np.where(np.arange(30) == 0, 0.5, 1.0)[bed]
        gradient = closures.values(
            "ergunPressureGradient",
            particleDiameter=1e-3,
            fluidDensity=10,
            fluidViscosity=1.5e-4,
            voidFraction=void_fraction[bed],
            superficialVelocity=velocity,
        )
        return (weight * gradient).sum() * 1e-3


class Meanings(Folder):
    """What is written, where a word means something else."""

    def test_interval_is_in_seconds(self) -> None:
        said = self.imported(self.old / "settlingParticle")
        self.assertIn("couplingTimeStep        0.001;", (self.target / "constant/couplingProperties").read_text())
        self.assertIn("deltaT                  0.001;", (self.target / "system/controlDict").read_text())
        self.assertIn("couplingInterval 100: is in seconds here", said)

    def test_terms_that_were_not_there_are_left_out(self) -> None:
        """Without the words the program refuses the case."""
        said = self.imported(self.old / "packedColumn")
        text = (self.target / "constant/couplingProperties").read_text()
        self.assertIn("( gradPForce viscForce GidaspowDrag noBuoyancy );", text)
        self.assertIn("has no Archimedes, so noBuoyancy is added", said)

    def test_mean_velocity_of_a_periodic_channel(self) -> None:
        """As the tutorial periodicChannel writes it. Taken over as it is, OpenFOAM knows no such option; left in its
        library, the program does not start."""
        case = self.case(
            "packedColumn", "CFD/system/controlDict", "application", 'libs ("libfvOptionsCFDEM.so");\napplication'
        )
        options = (
            "momentumSource { type meanSupVelocityForce; active yes;"
            " meanSupVelocityForceCoeffs { selectionMode all;"
            " fields (U); Ubar (10 0 0); relaxation 0.9; twoPhase false; coupled true;"
            ' voidfractionField "voidfraction";'
            " } }\nmore { type vectorSemiImplicitSource; selectionMode all; }\n"
        )
        (case / "CFD/system/fvOptions").write_text(options)
        said = self.imported(case)
        self.assertIn("Ubar is the mean of U between the particles", said)
        self.assertIn("libfvOptionsCFDEM.so", said)
        self.assertNotIn("libfvOptionsCFDEM", (self.target / "system/controlDict").read_text())
        text = (self.target / "system/fvOptions").read_text()
        for words in (
            r"type\s+meanVelocityForce;",
            r"meanVelocityForceCoeffs\s",
            r"Ubar\s+\( 10 0 0 \);",
            r"relaxation\s+0.9;",
        ):
            self.assertRegex(text, words)
        self.assertRegex(text, r"more\s+{\s+type\s+vectorSemiImplicitSource;")
        for gone in ("Sup", "twoPhase", "coupled", "voidfraction"):
            self.assertNotIn(gone, text)

    def test_model_b_lacks_no_pressure_gradient(self) -> None:
        self.imported(self.old / "settlingParticle")
        text = (self.target / "constant/couplingProperties").read_text()
        self.assertIn("( DiFeliceDrag Archimedes );", text)

    def test_case_without_drag_law(self) -> None:
        self.imported(
            self.case(
                "settlingParticle", "CFD/constant/couplingProperties", "    DiFeliceDrag\n    //grad", "    //grad"
            )
        )
        text = (self.target / "constant/couplingProperties").read_text()
        self.assertIn("( Archimedes noDrag );", text)

    def test_smoothing_length_spreads_alike(self) -> None:
        self.imported(self.old / "settlingParticle")
        self.assertIn("bandwidth               0.0006;", (self.target / "constant/couplingProperties").read_text())

    def test_constant_inlet_is_superficial(self) -> None:
        text = (self.old / "packedColumn/CFD/0/U").read_text()
        (table,) = re.findall(r"type            uniformFixedValue;.*?\);\n", text, re.DOTALL)[:1]
        self.imported(self.case("packedColumn", "CFD/0/U", table, "type fixedValue; value uniform (0 0 0.01);\n"))
        self.assertIn("interstitialInletVelocity", (self.target / "0/U").read_text())

    def test_long_table_of_an_inlet(self) -> None:
        """OpenFOAM reads the expression, and it has the table's values at and between its times."""
        rows = [(0.001 * step, 0.002 + 0.001 * (step % 3)) for step in range(60)]
        text = (self.old / "packedColumn/CFD/0/U").read_text()
        (table,) = re.findall(r"table\n        \(.*?\n        \);", text, re.DOTALL)[:1]
        self.imported(
            self.case(
                "packedColumn",
                "CFD/0/U",
                table,
                "table (" + " ".join(f"({time:.6g} (0 0 {speed:.6g}))" for time, speed in rows) + ");",
            )
        )
        control = self.target / "system/controlDict"
        control.write_text(re.sub(r"(?m)^(endTime|writeInterval) .*;", r"\1 0.03;", control.read_text()))
        self.run_()
        probes = (self.target / "postProcessing/probes/0/U").read_text().replace("(", " ").replace(")", " ")
        for row in probes.splitlines():
            if not row.startswith("#"):
                time, *_, upwards = (float(number) for number in row.split())
                self.assertAlmostEqual(upwards, float(np.interp(time, *np.transpose(rows))), delta=1e-6)

    def test_inlet_between_the_particles_stays_one(self) -> None:
        self.imported(
            self.case(
                "packedColumn",
                "CFD/0/voidfraction",
                '"(inlet|outlet)"\n    {\n        type            fixedValue;',
                '"(inlet|outlet)"\n    {\n        type            zeroGradient;',
            )
        )
        self.assertIn("uniformFixedValue", (self.target / "0/U").read_text())

    def test_processors_behind_a_blank_line(self) -> None:
        """Of the script that LIGGGHTS runs alone: the blank line would be commented out, and the command stay."""
        self.imported(self.case("packedColumn", "DEM/in.liggghts_init", "processors ", "\n  processors "))
        self.assertRegex((self.target / "DEM/in.liggghts_init").read_text(), r"\n\n# +processors")

    def test_probes_look_for_our_field(self) -> None:
        said = self.imported(self.old / "packedColumn")
        self.assertIn("fields                  ( p U voidFraction );", (self.target / "system/controlDict").read_text())
        self.assertIn("volAverage_voidfraction: no such field here", said)

    def test_files_are_not_compressed(self) -> None:
        """Taken over as `on`, the program would refuse the case."""
        said = self.imported(
            self.case(
                "settlingParticle",
                "CFD/system/controlDict",
                "writeCompression uncompressed",
                "writeCompression compressed",
            )
        )
        self.assertIn("writeCompression        off;", (self.target / "system/controlDict").read_text())
        self.assertIn("writeCompression: is off here", said)

    def test_script_loses_the_coupling(self) -> None:
        said = self.imported(self.old / "packedColumn")
        script = (self.target / "DEM/in.liggghts_run").read_text()
        for word in ("processors", "couple/cfd", "dragforce", "dragtotal", "../DEM", "thermo_log"):
            self.assertNotIn(word, script)
        self.assertNotRegex(script, r"(?m)^run")
        self.assertIn("thermo_style custom step atoms ke c_centre[3]", script)
        self.assertIn("processors 2 2 1: both engines", said)

    def test_seeds_are_primes_above10000(self) -> None:
        for file, old, new in (
            ("DEM/in.liggghts_init", "sphere 15485863", "sphere 1"),
            ("DEM/in.liggghts_init", "seed 100003", "seed 100001"),
        ):
            with self.subTest(new):
                case = self.case("packedColumn", file, old, new)
                said = self.imported(case)
                script = (self.target / file).read_text()
                shutil.rmtree(case)
                shutil.rmtree(self.target)
                self.assertRegex(script, r"sphere 10007|seed 100003")
                self.assertIn(f"seed {new.split()[1]}: is 100", said)

    def test_solvers_keep_their_words(self) -> None:
        self.imported(self.old / "packedColumn")
        solution = (self.target / "system/fvSolution").read_text()
        self.assertIn("        $p;", solution)
        self.assertIn("    nNonOrthogonalCorrectors 0;", solution)

    def test_report_stays_with_the_case(self) -> None:
        said = self.imported(self.old / "packedColumn")
        self.assertTrue(said.startswith((self.target / "IMPORTED").read_text().rstrip()))

    def test_what_todays_tutorials_write(self) -> None:
        """A regular expression as keyword, couple_every beside couplingInterval, executeProps of a command that is not
        chosen, and dictionaries of other programs: ErgunTestMPI of CFDEMcoupling-PUBLIC has all of them."""
        coupling = "CFD/constant/couplingProperties"
        case = self.case("settlingParticle", coupling, "twoWayMPIProps", '"(twoWayMPIProps|M2MProps)"')
        script = case / "DEM/in.liggghts_run"
        script.write_text(script.read_text().replace("couple_every 100", "couple_every 50"))
        with open(case / "CFD/constant/liggghtsCommands", "a") as commands:
            commands.write("executeProps2 { command (run); }\n")
        (case / "CFD/system/funkySetFieldsDict").write_text("expressions ( );\n")
        printed = self.imported(case)
        for word in ("couple_every 50", "executeProps2", "funkySetFieldsDict"):
            self.assertIn(word, printed)
        self.assertIn('"DEM/in.liggghts_run"', (self.target / "constant/couplingProperties").read_text())
        self.assertTrue((self.target / "system/funkySetFieldsDict").exists())

    def test_keywords_with_brackets(self) -> None:
        """Taken apart, div(phi,U) would be an entry 'div', and OpenFOAM would take the default in its place."""
        schemes = "CFD/system/fvSchemes"
        case = self.case("settlingParticle", schemes)
        old = (case / schemes).read_text()
        (case / schemes).write_text(
            old.replace("divSchemes\n{", "divSchemes\n{\n    div((nuEff*dev2(T(grad(U))))) none;")
        )
        self.imported(case)
        written = (self.target / "system/fvSchemes").read_text()
        self.assertRegex(written, r"\sdiv\(\(nuEff\*dev2\(T\(grad\(U\)\)\)\)\) +none;")

    def test_functions_as_a_dictionary(self) -> None:
        """phi of CFDEMcoupling is the flux of the fluid's volume."""
        control = "CFD/system/controlDict"
        case = self.case("settlingParticle", control)
        with open(case / control, "a") as end:
            end.write(
                "functions { flow { type surfaceFieldValue; functionObjectLibs (fieldFunctionObjects); "
                "fields ( phi ); } }"
            )
        self.imported(case)
        written = (self.target / "system/controlDict").read_text()
        self.assertRegex(written, r"flow\s*{[^}]*fields\s+\( alphaPhi \)")

    def test_parcels(self) -> None:
        """The ratio of every force is one entry, under either of CFDEMcoupling's words."""
        coupling = "CFD/constant/couplingProperties"
        for word in ("scale", "scaleDia"):
            with self.subTest(word):
                props = f"    treeSearch true; }} DiFeliceDragProps {{ {word} 2; }} ArchimedesProps {{ {word} 2;"
                case = self.case("settlingParticle", coupling, "    treeSearch true;", props)
                self.assertIn("scale 2: is coarseGraining 2 here", self.imported(case))
                written = (self.target / "constant/couplingProperties").read_text()
                self.assertRegex(written, r"\bcoarseGraining +2;")
                shutil.rmtree(case)
                shutil.rmtree(self.target)

    def test_without_parcels(self) -> None:
        coupling = "CFD/constant/couplingProperties"
        self.imported(self.case("settlingParticle", coupling))
        self.assertNotIn("coarseGraining", (self.target / "constant/couplingProperties").read_text())


class Errors(Folder):
    """Nothing is written, and the message names the file and the entry."""

    def test_what_nothing_reads(self) -> None:
        coupling, control, script = "CFD/constant/couplingProperties", "CFD/system/controlDict", "DEM/in.liggghts_run"
        for file, old, new, named in (
            (coupling, "modelType B;", "modelType B; useImplicitWhatever on;", "useImplicitWhatever"),
            (coupling, "    treeSearch true;", "    treeSearch true; } DiFeliceDragProps { scaleDrag 2;", "scaleDrag"),
            (
                coupling,
                "    treeSearch true;",
                "    treeSearch true; } DiFeliceDragProps { scale 2; } ArchimedesProps { scale 3;",
                "differs (DiFeliceDrag 2, Archimedes 3)",
            ),
            (script, "run             0\n", "coarsegraining 2\nrun             0\n", "diameters of the parcels"),
            (coupling, 'granVelFieldName "Us";\n    verbose', "slipFactor 2;\n    verbose", "slipFactor"),
            (coupling, "modelType B;", "modelType Bfull;", "modelType"),
            (coupling, "    Archimedes\n", "    Archimedes\n    magicForce\n", "magicForce"),
            (
                coupling,
                "    Archimedes\n",
                "    Archimedes\n    KochHillDrag\n",
                "KochHillDrag: its force adds to that of DiFeliceDrag",
            ),
            (coupling, "    //gradPForce\n", "    gradPForce\n", "gradPForce: the drag of model B"),
            (coupling, "dataExchangeModel twoWayMPI", "dataExchangeModel twoWayM2M", "dataExchangeModel"),
            (coupling, "scaleUpVol 1.0", "scaleUpVol 1.3", "scaleUpVol"),
            (control, "adjustTimeStep  no", "adjustTimeStep  yes", "adjustTimeStep"),
            (control, "endTime         0.15;", 'endTime         0.15; libs ("libmine.so");', "libs"),
            (control, "endTime         0.15;", "endTime         0.15; graphFormat raw;", "graphFormat"),
            (script, "run             0\n", "run             5000\n", "run"),
            (script, "couple/cfd/force\n", "couple/cfd/convection\n", "couple/cfd/convection"),
            (
                "CFD/constant/RASProperties",
                "RASModel        laminar;\nturbulence      off;",
                "RASModel kEpsilon; turbulence on;",
                "kEpsilon",
            ),
            ("CFD/constant/g", "0 -9.81 0", "0 0 -9.81", "DEM script"),
            ("CFD/0/T", "", "internalField uniform 300;", "CFD/0/T"),
            ("CFD/constant/liggghtsCommands", "runLiggghts", "runLiggghts execute", "execute"),
        ):
            with self.subTest(named):
                case = self.case("settlingParticle", file, old, new)
                done = self.importing(case)
                shutil.rmtree(case)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn(named, done.stderr)
                self.assertIn("nothing was written", done.stderr)
                self.assertFalse(self.target.exists())

    def test_inlet_that_may_be_either(self) -> None:
        done = self.importing(self.case("packedColumn", "CFD/0/voidfraction", '"(inlet|outlet)"', "outlet"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("inlet", done.stderr)

    def test_inlets_that_are_not_converted(self) -> None:
        """Copied, they would give the flow times the void fraction at the patch. Where 0/voidfraction is not fixed
        they mean the same, and conditions that give no velocity are no inlets."""
        text = (self.old / "packedColumn/CFD/0/U").read_text()
        (table,) = re.findall(r"type            uniformFixedValue;.*?\);\n", text, re.DOTALL)[:1]
        for kind in ("flowRateInletVelocity", "surfaceNormalFixedValue", "cylindricalInletVelocity", "mappedField"):
            case = self.case("packedColumn", "CFD/0/U", table, f"type {kind};\n")
            done = self.importing(case)
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn(f"CFD/0/U/boundaryField/inlet: {kind}: 0/voidfraction is fixed there", done.stderr)
            self.assertIn("allowed: fixedValue, uniformFixedValue, or voidfraction zeroGradient", done.stderr)
            self.assertFalse(self.target.exists())
            shutil.rmtree(case)
        inflow = "type inletOutlet; inletValue uniform (0 0 0.002);\n"
        done = self.importing(self.case("packedColumn", "CFD/0/U", table, inflow))
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(
            "allowed: fixedValue, uniformFixedValue, or voidfraction zeroGradient there, or inletV", done.stderr
        )
        shutil.rmtree(self.folder / "packedColumn")
        self.imported(self.case("packedColumn", "CFD/0/U", table, inflow.replace("0.002", "0.0")))
        shutil.rmtree(self.folder / "packedColumn")
        shutil.rmtree(self.target)
        case = self.case("packedColumn", "CFD/0/U", table, "type flowRateInletVelocity;\n")
        void_fraction = case / "CFD/0/voidfraction"
        void_fraction.write_text(void_fraction.read_text().replace("fixedValue", "zeroGradient"))
        self.imported(case)
        shutil.rmtree(case)
        for kind in ("inletOutlet", "pressureInletOutletVelocity", "noSlip", "symmetryPlane", "cyclicAMI"):
            shutil.rmtree(self.target)
            self.imported(self.case("packedColumn", "CFD/0/U", table, f"type {kind};\n"))
            shutil.rmtree(self.folder / "packedColumn")

    def test_without_is_what_the_user_says(self) -> None:
        case = self.case(
            "settlingParticle",
            "CFD/constant/couplingProperties",
            "modelType B;",
            "modelType B; useImplicitWhatever on;",
        )
        self.assertIn("useImplicitWhatever: by --without", self.imported(case, "--without", "useImplicitWhatever"))

    def test_without_a_second_drag_law(self) -> None:
        case = self.case(
            "settlingParticle",
            "CFD/constant/couplingProperties",
            "    Archimedes\n",
            "    Archimedes\n    KochHillDrag\n",
        )
        self.imported(case, "--without", "KochHillDrag")
        self.assertIn("( DiFeliceDrag Archimedes );", (self.target / "constant/couplingProperties").read_text())

    def test_without_that_names_nothing(self) -> None:
        done = self.importing(self.old / "settlingParticle", "--without", "misspelt")
        self.assertEqual(done.returncode, 1)
        self.assertIn("misspelt: names no error", done.stderr)

    def test_target_that_is_there(self) -> None:
        self.target.mkdir()
        done = self.importing(self.old / "settlingParticle")
        self.assertIn("is there already", done.stderr)

    def test_broken_file(self) -> None:
        done = self.importing(self.case("settlingParticle", "CFD/0/p", "boundaryField\n{", "boundaryField\n"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("CFD/0/p", done.stderr)


environment.load()
unittest.main()
