"""A case of CFDEMcoupling (CFD/, DEM/) becomes one of ours: reads all of it first, then writes it as a whole."""

import re
import shutil
import tempfile
from pathlib import Path
from typing import Any, Iterable

from clepsydra.cfdem_cases import foam_text, inlets
from clepsydra.cfdem_cases.dem_script import DemScript, output_folders, with_seeds
from clepsydra.cfdem_cases.report import Report
from clepsydra.cfdem_cases.settings import PROPS, Settings

# Files that need nothing done: fields that our coupling makes itself, and settings of what is not chosen.
FIELDS_WITHOUT_COUNTERPART = (
    "Us",
    "Ksl",
    "f",
    "k",
    "epsilon",
    "omega",
    "nut",
    "nuSgs",
    "nuTilda",
    "R",
    "dSmoothing",
    "sSmoothField",
    "vSmoothField",
    "fSmooth",
    "phiIB",
    "partVel",
    "voidfraction_0",
)
# phi there is the flux of the fluid's volume, void fraction times velocity
FIELDS_TO_SAMPLE = {"p": "p", "U": "U", "voidfraction": "voidFraction", "phi": "alphaPhi"}
CONSTANT_FILES = (
    "couplingProperties",
    "liggghtsCommands",
    "transportProperties",
    "turbulenceProperties",
    "RASProperties",
    "LESProperties",
    "environmentalProperties",
    "g",
    "dynamicMeshDict",
    "fvOptions",
    "particleTrackProperties",
    "polyMesh",
    "triSurface",
)
SYSTEM_FILES = ("controlDict", "fvSchemes", "fvSolution", "blockMeshDict", "decomposeParDict", "fvOptions")
OFF = ("off", "false", "no")

ALLRUN = """#!/bin/bash
# Imported from a case of CFDEMcoupling: IMPORTED says what changed. Mesh, {particles}coupled run.
set -euo pipefail
cd "$(dirname "$0")"
repository=${{CLEPSYDRA:?source scripts/environment of Clepsydra first}}
. "$repository/scripts/runFunctions"
. "$repository/scripts/environment"

{steps}
"""


def import_case(case: Path, target: Path, without: Iterable[str] = ()) -> Report:
    """The report. Writes target only where it has no errors."""
    report = Report(without)
    if not (case / "CFD").is_dir() or not (case / "DEM").is_dir():
        raise foam_text.FoamError(f"{case}: is no case of CFDEMcoupling; allowed: a folder with CFD/ and DEM/")
    if target.exists():
        raise foam_text.FoamError(f"{target}: is there already; allowed: a folder that does not exist")
    try:
        files = Import(case, report).files
    except foam_text.FoamError as problem:
        report.error("", str(problem), "the rest of the case was not read")
        return report
    for word in report.without - report.used:
        report.errors.append(("--without", word, "names no error of this case"))
    if not report.errors:
        write(files, report, target)
    return report


def write(files: dict[str, Any], report: Report, target: Path) -> None:
    """files: path -> text, or a Path to copy, or None for an empty folder. All of it or nothing."""
    target.parent.mkdir(parents=True, exist_ok=True)
    folder = Path(tempfile.mkdtemp(prefix=f".{target.name}.", dir=target.parent))
    try:
        for name, content in {**files, "IMPORTED": "\n".join(report.lines()) + "\n"}.items():
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if content is None:
                path.mkdir(parents=True, exist_ok=True)
            elif isinstance(content, Path):
                (shutil.copytree if content.is_dir() else shutil.copyfile)(content, path)
            else:
                path.write_text(content)
        (folder / "Allrun").chmod(0o755)
        folder.chmod(0o755)
        folder.rename(target)
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise


class Import:
    def __init__(self, case: Path, report: Report) -> None:
        self.case, self.report = case, report
        self.files: dict[str, Any] = {}
        self.open_files: list[foam_text.Dictionary] = []
        self.settings = Settings(self.read("CFD/constant/couplingProperties"), report)
        self.script = self.dem_script()
        self.control = self.read("CFD/system/controlDict")
        self.interval = self.chosen_interval()
        self.coupling_properties()
        self.control_dict()
        self.solvers()
        self.mesh()
        self.fluid()
        self.fields()
        self.other_files()
        self.allrun()
        for old in self.open_files:
            for where, name in old.unread():
                report.error(where, name, "has no counterpart here")

    def read(self, name: str) -> foam_text.Dictionary:
        path = self.case / name
        variants = sorted(other.name for other in path.parent.glob(f"{path.name}_*"))
        if not path.exists() and variants:
            raise foam_text.FoamError(f"{name}: there is none; copy one of these to that name: {', '.join(variants)}")
        found = foam_text.read(self.case / name, name)
        self.open_files.append(found)
        return found

    def has(self, name: str) -> bool:
        return (self.case / name).exists()

    # --- particles ---------------------------------------------------------------------------------------

    def dem_script(self) -> DemScript:
        name = Path(self.settings.script).name
        where = f"DEM/{name}"
        if not self.settings.script.startswith("../DEM/") or not self.has(where):
            raise foam_text.FoamError(f"liggghtsPath '{self.settings.script}' leads to no file; allowed: ../DEM/NAME")
        script = DemScript((self.case / where).read_text(), where, self.report)
        self.files[where] = script.text()
        steps = self.settings.interval_in_steps
        if script.couple_every not in (None, steps):
            self.report.change(
                where,
                f"couple_every {script.couple_every}",
                f"is not what counts, there as here: couplingInterval {steps:g} of couplingProperties is",
            )
        self.files |= {folder: None for folder in output_folders(script.text())}
        self.before_it = self.script_that_writes(script.restart)
        return script

    def script_that_writes(self, restart: str | None) -> str | None:
        """The script that makes the particles which the other reads; it runs as it is."""
        if restart is None:
            return None
        for path in sorted((self.case / "DEM").glob("in.*")):
            text = path.read_text()
            if re.search(rf"^\s*write_restart\s+\S*{re.escape(Path(restart).name)}\b", text, re.MULTILINE):
                text = with_seeds(text, f"DEM/{path.name}", self.report)
                self.files[f"DEM/{path.name}"] = re.sub(r"^([ \t]*processors\b)", r"#\1", text, flags=re.MULTILINE)
                self.files |= {f"DEM/{folder}": None for folder in output_folders(text)}
                return path.name
        if not self.has(restart):
            self.report.error(
                f"DEM/{Path(self.settings.script).name}",
                f"read_restart {restart}",
                "no script in DEM/ writes that file, nor is it there",
            )
        return None

    # --- time ----------------------------------------------------------------------------------------

    def chosen_interval(self) -> float:
        """[s]. There the fluid's step and the coupling step are two things, here one."""
        step, delta_t = self.script.time_step, self.control.number("deltaT")
        there = self.settings.interval_in_steps * (step or 1)
        where, what = self.settings.where, f"couplingInterval {self.settings.interval_in_steps:g}"
        fits = step and abs(delta_t / step - round(delta_t / step)) < 1e-6 * delta_t / step
        chosen = delta_t if delta_t < there * (1 - 1e-6) and fits else there
        self.report.change(
            where,
            what,
            (
                f"is in seconds here, couplingTimeStep {chosen:g} s: in the old case the coupling interval is "
                f"{there:g} s and the fluid's deltaT {delta_t:g} s, here both are one"
            ),
        )
        return chosen

    def coupling_properties(self) -> None:
        entries: dict[str, Any] = {
            "fluid": self.settings.entries.pop("fluid"),
            "couplingTimeStep": f"{self.interval:.10g}",
            **self.settings.entries,
            "DEM": {"engine": "liggghts", "script": f'"DEM/{Path(self.settings.script).name}"'},
        }
        if self.script.is_one_particle:
            entries["DEM"]["maxRayleighFraction"] = "100"
            self.report.change(
                self.script.where,
                f"timestep {self.script.time_step:g}",
                (
                    "is not compared with the Rayleigh time, since there is one particle only. Where it meets a wall,"
                    " remove maxRayleighFraction from DEM in constant/couplingProperties"
                ),
            )
        self.liggghts_commands(entries["DEM"])
        self.files["constant/couplingProperties"] = foam_text.file("couplingProperties", "dictionary", entries)

    def liggghts_commands(self, dem: dict[str, Any]) -> None:
        if not self.has("CFD/constant/liggghtsCommands"):
            return
        old = self.read("CFD/constant/liggghtsCommands")
        for name in old.words("liggghtsCommandModels"):
            props = old.sub(f"{name}Props")
            if name == "writeLiggghts":
                props.is_read()
                dem["writeRestart"] = '"DEM/atTheEnd.restart"'
                self.report.change(
                    old.where,
                    name,
                    "is DEM/writeRestart, at the end of the run; checkpoints hold the particles at write times",
                )
            elif name == "runLiggghts":
                props.is_read()
            else:
                self.report.error(old.where, name, "has no counterpart; known: runLiggghts, writeLiggghts")
        for name, props in old.entries.items():
            if PROPS.search(name) and name not in old.asked:
                old.asked.add(name)
                props.is_read()
                self.report.left_out(old.where, name, "of a command that is not chosen")

    def control_dict(self) -> None:
        old, where = self.control, self.control.where
        entries: dict[str, Any] = {"application": "pimpleDemFoam"}
        old.text("application")
        for name in ("startFrom", "startTime", "stopAt", "endTime"):
            entries[name] = old.needed(name)
        entries["deltaT"] = f"{self.interval:.10g}"
        if old.text("adjustTimeStep", "no") not in OFF:
            self.report.error(
                where,
                "adjustTimeStep",
                "is on; allowed: off, and adjustableCouplingTimeStep of couplingProperties in its place",
            )
        for name in ("maxCo", "maxDeltaT"):
            if name in old:
                old.text(name)
                self.report.left_out(where, name, "is read only where the time step adjusts itself")
        control, interval = old.needed("writeControl"), old.number("writeInterval")
        if control == "timeStep":
            control, interval = "runTime", interval * old.number("deltaT")
        entries["writeControl"] = "runTime" if control == "adjustableRunTime" else control
        entries["writeInterval"] = f"{interval:.10g}"
        if old.text("purgeWrite", "0") == "1":
            self.report.error(
                where,
                "purgeWrite",
                "is 1; allowed: 0, or 2 and more: the last checkpoint must be whole before another goes",
            )
        for name, default in (
            ("purgeWrite", "0"),
            ("writeFormat", "ascii"),
            ("writePrecision", "8"),
            ("timeFormat", "general"),
            ("timePrecision", "8"),
        ):
            entries[name] = old.text(name, default)
        entries["writeCompression"] = "off"
        if old.text("writeCompression", "off") not in (*OFF, "uncompressed"):
            self.report.change(where, "writeCompression", "is off here: a checkpoint must be seen to be whole")
        entries["runTimeModifiable"] = "no"
        old.text("runTimeModifiable")
        if "libs" in old and set(old.words("libs")) <= set(inlets.LIBRARIES):
            self.report.left_out(where, "libs", f"{old.text('libs')}: its options become those of OpenFOAM")
        elif "libs" in old:
            self.report.error(where, "libs", f"{old.text('libs')}: libraries of CFDEMcoupling or others are not here")
        entries["functions"] = self.functions()
        self.files["system/controlDict"] = foam_text.file("controlDict", "dictionary", entries)

    def functions(self) -> dict[str, Any]:
        old = self.control.entries.get("functions")
        self.control.asked.add("functions")
        if isinstance(old, str):
            old = foam_text.listed(old, f"{self.control.where}/functions") if old else None
        new = {}
        for name, function in (old.is_read().entries if old else {}).items():
            where = function.where
            entries = dict(function.entries)
            entries.pop("name", None) if entries.get("name") == name else None
            for before, now in (
                ("functionObjectLibs", "libs"),
                ("outputControl", "writeControl"),
                ("outputInterval", "writeInterval"),
            ):
                if before in entries:
                    entries[now] = entries.pop(before)
            entries["writeControl"] = {"outputTime": "writeTime"}.get(
                entries.get("writeControl", "timeStep"), entries.get("writeControl", "timeStep")
            )
            wanted = entries.get("fields", "").strip("() ").split()
            kept = [FIELDS_TO_SAMPLE[field] for field in wanted if field in FIELDS_TO_SAMPLE]
            for field in wanted:
                if FIELDS_TO_SAMPLE.get(field, field) != field:
                    self.report.change(where, field, f"is {FIELDS_TO_SAMPLE[field]} here")
                elif field not in FIELDS_TO_SAMPLE:
                    self.report.left_out(
                        where, field, f"no such field here; there are: {', '.join(FIELDS_TO_SAMPLE.values())}"
                    )
            if wanted and not kept:
                self.report.error(where, "fields", f"none of ({' '.join(wanted)}) is a field here")
            if wanted:
                entries["fields"] = f"( {' '.join(kept)} )"
            new[name] = entries
        return new

    # --- fluid ---------------------------------------------------------------------------------------

    def solvers(self) -> None:
        old = self.read("CFD/system/fvSolution")
        solvers = old.sub("solvers")
        found = {}
        for pattern, value in solvers.entries.items():
            solvers.asked.add(pattern)
            if isinstance(value, foam_text.Dictionary):
                value.is_read()
            for name in ("p", "U"):
                if re.fullmatch(pattern, name):
                    found[name] = value.entries
        for name in ("p", "U"):
            if name not in found:
                raise foam_text.FoamError(f"{solvers.where}: no solver for {name}")
        final = solvers.entries.get("pFinal")
        new = {
            "p": found["p"],
            "pFinal": final.entries if final else {**found["p"], "relTol": "0"},
            "(U|UFinal)": {**found["U"], "relTol": "0"},
        }
        piso = old.sub("PISO" if "PISO" in old else "PIMPLE")
        old.sub("PIMPLE").is_read()
        pimple = {"nOuterCorrectors": "1", **piso.is_read().entries}
        entries: dict[str, Any] = {"solvers": new, "PIMPLE": pimple}
        if "relaxationFactors" in old:
            entries["relaxationFactors"] = old.sub("relaxationFactors").is_read()
        self.files["system/fvSolution"] = foam_text.file("fvSolution", "dictionary", entries)
        self.report.left_out(
            solvers.where,
            "all but p and U",
            "void fraction, momentum and smoothing are not solved for by OpenFOAM's solvers",
        )

        schemes = self.read("CFD/system/fvSchemes").is_read()
        for name in ("fluxRequired", "wallDist"):
            schemes.entries.pop(name, None)
        self.files["system/fvSchemes"] = foam_text.file("fvSchemes", "dictionary", schemes)
        if self.has("CFD/system/decomposeParDict"):
            self.files["system/decomposeParDict"] = self.case / "CFD/system/decomposeParDict"

    def mesh(self) -> None:
        for name in ("system", "constant/polyMesh"):
            if self.has(f"CFD/{name}/blockMeshDict"):
                self.files["system/blockMeshDict"] = self.case / f"CFD/{name}/blockMeshDict"
                self.makes_mesh = True
                return
        self.makes_mesh = False
        if not self.has("CFD/constant/polyMesh/points"):
            raise foam_text.FoamError(
                "CFD: no mesh; allowed: system/blockMeshDict, constant/polyMesh/blockMeshDict, constant/polyMesh/points"
            )
        self.files["constant/polyMesh"] = self.case / "CFD/constant/polyMesh"

    def fluid(self) -> None:
        transport = self.read("CFD/constant/transportProperties")
        if transport.text("transportModel", "Newtonian") != "Newtonian":
            self.report.error(
                transport.where, "transportModel", f"is {transport.text('transportModel')}; allowed: Newtonian"
            )
        for name in list(transport.entries):
            if name.endswith("Coeffs"):
                transport.sub(name).is_read()
        rho = self.read("CFD/0/rho").is_read()
        density = rho.needed("internalField").split()
        if density[:1] != ["uniform"] or len(density) != 2:
            self.report.error(rho.where, "internalField", "allowed: uniform NUMBER, for the fluid has one density here")
        self.report.change(rho.where, f"rho {density[-1]}", "is constant/transportProperties' rho here")
        self.files["constant/transportProperties"] = foam_text.file(
            "transportProperties",
            "dictionary",
            {"rho": f"rho [1 -3 0 0 0 0 0] {density[-1]}", "nu": f"nu [0 2 -1 0 0 0 0] {transport.number('nu'):.10g}"},
        )
        self.turbulence()
        self.gravity()
        for folder in ("constant", "system"):
            if self.has(f"CFD/{folder}/fvOptions"):
                options = inlets.converted_sources(self.read(f"CFD/{folder}/fvOptions"), self.report)
                self.files[f"{folder}/fvOptions"] = foam_text.file("fvOptions", "dictionary", options)

    def turbulence(self) -> None:
        """Only laminar flow: every file that names a model must name none."""
        if self.has("CFD/constant/turbulenceProperties"):
            old = self.read("CFD/constant/turbulenceProperties")
            kind = old.needed("simulationType")
            model = {
                "RASModel": "RASProperties",
                "RAS": "RASProperties",
                "LESModel": "LESProperties",
                "LES": "LESProperties",
            }.get(kind)
            inside = old.sub(kind)
            chosen = (
                inside
                if inside.entries
                else self.read(f"CFD/constant/{model}")
                if model and self.has(f"CFD/constant/{model}")
                else inside
            )
            name = chosen.text("RASModel") or chosen.text("LESModel") or "none"
            if kind != "laminar" and name != "laminar" and chosen.text("turbulence", "on") not in OFF:
                self.report.error(old.where, "simulationType", f"is {kind} with model {name}; allowed: laminar")
            chosen.is_read()
            old.is_read()
        self.files["constant/turbulenceProperties"] = foam_text.file(
            "turbulenceProperties", "dictionary", {"simulationType": "laminar"}
        )

    def gravity(self) -> None:
        of_particles = self.script.gravity or [0, 0, 0]
        for name in ("g", "environmentalProperties"):
            if self.has(f"CFD/constant/{name}"):
                old = self.read(f"CFD/constant/{name}").is_read()
                text = old.text("value") or old.text("g") or ""
                found = [float(word) for word in re.findall(r"[-+.\d][-+.\deE]*", text.split("(")[-1])]
                if any(abs(one - other) > 1e-3 for one, other in zip(found, of_particles)):
                    self.report.error(
                        old.where,
                        "g",
                        f"is {inlets.vector(found)}, that of the DEM script {inlets.vector(of_particles)}",
                    )
                break
        else:
            self.report.change(
                "CFD/constant", "g", f"is not there; {inlets.vector(of_particles)}, that of the DEM script"
            )
        self.files["constant/g"] = foam_text.file(
            "g",
            "uniformDimensionedVectorField",
            {"dimensions": "[0 1 -2 0 0 0 0]", "value": inlets.vector(of_particles)},
        )

    def fields(self) -> None:
        U, p, void_fraction = (self.read(f"CFD/0/{name}") for name in ("U", "p", "voidfraction"))
        inlets.converted(U, void_fraction.is_read(), self.report)
        for field, kind in ((U, "volVectorField"), (p, "volScalarField")):
            name = field.where.rsplit("/", 1)[1]
            self.files[f"0/{name}"] = foam_text.file(name, kind, field.is_read())

    # --- the rest ------------------------------------------------------------------------------------

    def other_files(self) -> None:
        read = {old.where for old in self.open_files}
        for folder, known in (
            ("0", FIELDS_WITHOUT_COUNTERPART),
            ("constant", CONSTANT_FILES),
            ("system", SYSTEM_FILES),
        ):
            for path in sorted((self.case / "CFD" / folder).iterdir()):
                where = f"CFD/{folder}/{path.name}"
                if where in read or path.name.startswith("."):
                    continue
                if (
                    path.name == "dynamicMeshDict"
                    and self.read(where).is_read().text("dynamicFvMesh") != "staticFvMesh"
                ):
                    self.report.error(
                        where, path.name, "the motion of the mesh is not converted; allowed: staticFvMesh"
                    )
                elif folder == "system" and path.name not in known:
                    self.files[f"system/{path.name}"] = path
                    self.report.left_out(where, path.name, "is copied; neither Allrun nor pimpleDemFoam reads it")
                elif path.name.startswith(tuple(f"{name}_" for name in known)):
                    self.report.left_out(where, path.name, "another version of a file that the case has")
                elif path.name not in known:
                    self.report.error(where, path.name, "nothing here reads this file")
                elif folder == "0":
                    self.report.left_out(
                        where, path.name, "the coupling makes this field itself, or the flow is laminar"
                    )
        for path in [*sorted(self.case.iterdir()), *sorted((self.case / "CFD").iterdir())]:
            if path.name not in ("CFD", "DEM", "0", "constant", "system") and not path.name.startswith("."):
                self.report.left_out(
                    str(path.relative_to(self.case)),
                    path.name,
                    "starts or evaluates the old case, or is of its runs; Allrun is new",
                )
        for path in sorted((self.case / "DEM").iterdir()):
            name = f"DEM/{path.name}"
            if path.is_dir() and path.name != "post":
                self.files[name] = path
            elif path.is_file() and name not in self.files:
                if path.name.startswith("in."):
                    self.report.left_out(name, path.name, "no part of the case names it")
                elif not path.name.startswith("."):
                    self.files[name] = path

    def allrun(self) -> None:
        steps = ["logged blockMesh"] if self.makes_mesh else []
        if self.before_it:  # -log none: LIGGGHTS' own log has the name of the one that `logged` writes
            steps.append(f"(cd DEM && logged liggghts -log none -in {self.before_it})")
        steps.append("logged pimpleDemFoam")
        self.files["Allrun"] = ALLRUN.format(
            particles="particles by LIGGGHTS alone, " if self.before_it else "", steps="\n".join(steps)
        )
