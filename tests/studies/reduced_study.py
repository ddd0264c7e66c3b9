#!/usr/bin/python3
"""A small version of a committed study, run by the real solver: fewer effects, the same numbers and conditions.

Fails where a run fails, where the solver's numbers are not those that the committed report rests on, or where the
answer is not of the kind that a program with working parts must give. An empty simulator, effects that are not switched
on, or held-out data that were trained on are reported by the numbers. """

import argparse
import json
import math
import shutil
import subprocess
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).resolve().parents[2]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", metavar="STUDY", choices=CHECKS)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="for its runs and report, made again")
    given = parser.parse_args()
    name, folder = given.study, given.folder
    original = ROOT / "cases" / "studies" / name / "study.yaml"
    study = yaml.safe_load(original.read_text())
    study["simulator"]["case"] = str(original.parent / study["simulator"]["case"])
    study["simulator"].pop("dependsOn", None)
    study.pop("work", None)
    study.pop("withoutEffects", None)
    libraries = study["effectsFrom"] if isinstance(study["effectsFrom"], list) else [study["effectsFrom"]]
    study["effectsFrom"] = [str(original.parent / one) for one in libraries]
    study["executor"] = {"kind": "pool", "processes": 1}  # ctest runs other tests beside it
    study["inference"] = {"draws": 500}
    # One is enough to try what is to be measured next, of other particles in the same liquids.
    if name != "startingSpheres":
        without_candidates(study)
    check = CHECKS[name]
    check(study)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "study.yaml").write_text(yaml.safe_dump(study))
    subprocess.run(["traceResidual", "run", "study.yaml"], cwd=folder, check=True)
    report = json.loads((folder / "results/report.json").read_text())
    committed = json.loads((original.parent / "results/report.json").read_text())
    require(not report["runs"]["failures"], f"failed runs: {report['runs']['failures']}")
    check(None, report, committed)
    print(f"{name}: {report['decision']}, p = {report['pValue']:.3g}, as it must be")


def without_candidates(study: dict[str, Any]) -> None:
    study["conditions"] = [one for one in study["conditions"] if one["role"] != "candidate"]
    left = {one["name"] for one in study["conditions"]}
    errors = study.get("commonErrors", [])
    for one in errors:
        if "conditions" in one:
            one["conditions"] = [name for name in one["conditions"] if name in left]
    study["commonErrors"] = [one for one in errors if one.get("conditions") != []]


def with_longer_intervals(study: dict[str, Any], factor: Any) -> None:
    """Where one particle sinks steadily through liquid at rest nothing hangs on the coupling step: 3e-4 of a speed for
    four times."""
    for one in study["conditions"]:
        one["set"]["couplingTimeStep"] = factor * float(one["set"]["couplingTimeStep"])


def with_the_edges_height_only(study: dict[str, Any]) -> None:
    """Of the parts of a liquid's layers."""
    study["parameters"] = [one for one in study["parameters"] if one.get("of") is None or one["name"] == "edgeHeight"]


def starting_spheres(study: dict[str, Any] | None, report: Any = None, committed: Any = None) -> None:
    if study:
        study["onlyEffects"] = ["addedMass", "unsteadyForces"]
        return
    same_residual(report, committed)
    leads(report, "unsteadyForces")


def bounces_in_oil(study: dict[str, Any] | None, report: Any = None, committed: Any = None) -> None:
    """Ten times the DEM step, twice the coupling step. The other effect is the camera's, which costs no runs. The fit
    without an effect misses by 14 standard errors, so that each further run moves it by several of its own: by up to
    0.07 in the last bounces, also with four times as many runs."""
    if study:
        study["onlyEffects"] = ["lubrication", "imageScale"]
        study["simulator"]["set"].update(demStep=2e-6, couplingTimeStep=4e-4)
        return
    same_residual(report, committed, 0.08)
    leads(report, "lubrication")


def glycerine_particles_tall(study: dict[str, Any] | None, report: Any = None, committed: Any = None) -> None:
    """The other effect is the camera's, which costs no runs."""
    if study:
        study["onlyEffects"] = ["layers", "imageScale"]
        with_the_edges_height_only(study)
        with_longer_intervals(study, 4)
        return
    same_residual(report, committed)
    leads(report, "layers")
    require(
        committed["name"] == "layers" and abs(committed["effects"][0]["parameters"]["edgeHeight"] - 0.247) < 0.002,
        "the committed report names something else, or has the edge elsewhere",
    )


def particles_in_two_liquids(study: dict[str, Any] | None, report: Any = None, committed: Any = None) -> None:
    """No Stokes' drag in water; the law is reported by neither liquid alone."""
    if study:
        study["onlyEffects"] = ["dragSchillerNaumann", "particleDensity"]
        with_longer_intervals(study, 4)
        return
    same_residual(report, committed)
    leads(report, "dragSchillerNaumann")
    before, after = (report["heldOut"][one]["rmsLogError"] for one in ("before", "after"))
    require(after < 0.5 * before, f"the error in glycerol goes from {before} to {after} only")


def settled_glycerol(study: dict[str, Any] | None, report: Any = None, committed: Any = None) -> None:
    """A liquid that is thicker everywhere does not do."""
    if study:
        study["onlyEffects"] = ["thickerBelow", "otherLiquid"]
        with_the_edges_height_only(study)
        with_longer_intervals(study, 4)
        return
    same_residual(report, committed)
    leads(report, "thickerBelow")
    members = [one["name"] for one in committed["set"]]
    require(members == ["thickerBelow"], f"the committed report's candidates of the library are {members}")


def same_residual(report: Any, committed: dict[str, Any], tolerance: float = 0.02) -> None:
    """What the null leaves does not depend on the effects that are tried: numbers of the solver, and of the fit."""
    for which, one in (("this", report), ("the committed report", committed)):
        require(one["pValue"] < 0.05, f"in {which} p = {one['pValue']}")
    for here, there in zip(report["residual"], committed["residual"], strict=True):
        for feature, value in there["measuredMinusSimulated"].items():
            found = here["measuredMinusSimulated"][feature]["value"]
            require(
                abs(found - value["value"]) < tolerance,
                f"{there['condition']}, {feature}: {found} left, {value['value']} in the committed report",
            )


def leads(report: Any, effect: Any) -> None:
    first = max((one for one in report["effects"] if one["logOdds"] is not None), key=lambda one: one["logOdds"])
    require(first["name"] == effect and first["logOdds"] > 10, f"{first['name']} is likeliest, with {first['logOdds']}")


def paper_rates(study: dict[str, Any] | None, report: Any = None, committed: Any = None) -> None:
    """The paper's two rates, against six grams as deep as the blind sets', with the paper's orifice and one effect."""
    if study:
        blind = yaml.safe_load((ROOT / "cases/studies/blindHopper/study.yaml").read_text())
        # only the start of the flow, as in the study
        study["simulator"]["set"] = {
            **blind["simulator"]["set"],
            "orificeDiameter": 0.01,
            "hopperDiameter": 0.02,
            "particleCount": 600,
            "dryTime": 0.3,
            "submergedTime": 0.4,
        }
        study["onlyEffects"] = ["dragFactor"]
        study["repeats"] = {"base": 2, "alone": 2, "deciding": 3}
        return
    require(report["decision"] != "named", f"two numbers have named {report['name']}")
    simulated = {
        one["condition"]: measured / math.exp(one["measuredMinusSimulated"]["startRate"]["value"])
        for one, measured in zip(report["residual"], (11.4, 7.6))
    }
    require(
        abs(simulated["dry"] - 11.4) < 2, f"a friction could be found, but the dry rate there is {simulated['dry']} g/s"
    )
    require(0.55 < simulated["submerged"] / simulated["dry"] < 0.9, f"rates dry and under water: {simulated}")
    friction = committed["null"]["parameters"]["friction"]
    require(
        friction > 0.2, f"the committed report's friction is {friction}: rates that are too high ask for more than .15"
    )
    require(committed["decision"] == "noResidual", f"the committed report's decision is {committed['decision']}")


def require(holds: bool, message: str) -> None:
    if not holds:
        raise SystemExit(message)


CHECKS = {
    "startingSpheres": starting_spheres,
    "bouncesInOil": bounces_in_oil,
    "glycerineParticlesTall": glycerine_particles_tall,
    "particlesInTwoLiquids": particles_in_two_liquids,
    "settledGlycerol": settled_glycerol,
    "paperRates": paper_rates,
}

if __name__ == "__main__":
    main()
