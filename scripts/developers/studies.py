#!/usr/bin/python3
"""All studies on real measurements, in one table: the missing effect, and the error without and with it on measurements
that no fit used.

usage: studies [STUDY ...] [--run]     from the committed reports (seconds); --run: the studies are run again first
       studies --leaveOut STUDY ...    each training condition in turn is left out and predicted from the others
       studies --picture FILE STUDY ...    the candidates, and measured and simulated values that no fit used

Errors are those of held-out conditions: the study's own (results/), or those scored afterwards (results/heldOut, by
scoreHeldOut), or training conditions left out in turn (results/leftOut), which no fit used, though the authors of the
library may have known them. The first of these that exists is taken; the table states which. """

import argparse
import json
import math
import statistics
import subprocess
from pathlib import Path
from typing import Any, Iterator

import yaml

from clepsydra import environment

CASES = environment.REPOSITORY / "cases" / "studies"
# What a table says of each; the studies' files say more
STUDIES = {
    "startingSpheres": ("glass spheres released in water (Mordant & Pinton 2000)", "drag only"),
    "bouncesInOil": ("a steel sphere bounces in oil, St 152 (Gondret 2002)", "drag, dry restitution"),
    "glycerineParticlesTall": ("particles settle in a tall tank of glycerol", "one viscosity"),
    "sphereInBoxCurves": ("a sphere settles on the floor (ten Cate 2002)", "drag, added mass"),
    "particlesInTwoLiquids": ("particles in glycerol and in water", "Stokes' drag"),
    "settledGlycerol": ("particles in glycerol, before and after it settled", "one viscosity a day"),
    "gasBed": ("a bed that air fluidises (van Wachem et al. 2001)", "Beetstra's drag, one friction"),
    "slotHopper": ("plastic spheres and cylinders through a slot (digitised)", "spheres of the cylinders' volume"),
    "dischargeGrid": ("rates of two laws, particles of 0.5 to 2 mm", "narrow and shallow hoppers"),
    "paperRates": ("the published hopper's two rates, with corrections as known earlier", "one friction"),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", nargs="*", help="one of " + ", ".join(STUDIES))
    parser.add_argument("--run", action="store_true", help="run the studies again first")
    parser.add_argument("--leaveOut", action="store_true", help="predict each training condition from the others")
    parser.add_argument("--picture", metavar="FILE", help="draw the studies into this file")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.study if name not in STUDIES]
    if unknown:
        raise SystemExit(f"no study '{unknown[0]}'; allowed: {', '.join(STUDIES)}")
    if (arguments.leaveOut or arguments.picture) and not arguments.study:
        raise SystemExit("--leaveOut and --picture need the names of studies")
    chosen = arguments.study or list(STUDIES)
    if arguments.run or arguments.leaveOut:
        environment.load()
    for name in chosen:
        if arguments.run:
            subprocess.run(["traceResidual", "run", CASES / name / "study.yaml"], check=True, stdout=subprocess.DEVNULL)
        if arguments.leaveOut:
            leave_out(CASES / name / "study.yaml")
    if arguments.picture:
        picture(chosen, arguments.picture)
    else:
        table(chosen)


def leave_out(original: Any) -> None:
    """Reports of the study with each training condition held out in turn, from its stored runs and a few more."""
    study = yaml.safe_load(original.read_text())
    training = [one for one in study["conditions"] if one["role"] == "training"]
    for left in [one["name"] for one in training]:
        for one in training:
            one["role"] = "heldOut" if one["name"] == left else "training"
        # beside the original, so that its relative paths and stored runs are found
        split = original.with_name(f".scored.{left}.yaml")
        split.write_text(yaml.safe_dump(study, sort_keys=False))
        output = original.parent / "results/leftOut" / left
        subprocess.run(["traceResidual", "run", "--output", output, split], check=True, stdout=subprocess.DEVNULL)


def table(chosen: Any) -> None:
    print(
        "| data | baseline | missing effect | held out | error before | after | one more parameter | noise alone |"
        " grade | complete | runs | time |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for name in chosen:
        report = read(CASES / name / "results/report.json")
        if report is None:
            print("|", " | ".join([*STUDIES[name], "not run yet"] + 9 * [""]), "|")
            continue
        found = unseen(name, report)
        scores = [line for label, each in found.items() for line in [(label, errors(each)), *by_condition(each)]]
        runs = report["runs"]
        seconds = runs["seconds"] + runs.get("secondsOfStored", 0)
        for i, (label, score) in enumerate(scores or [("none", 6 * [""])]):
            first = [*STUDIES[name], answer(report)] if i == 0 else ["", "", ""]
            last = [str(runs["used"]), f"{seconds / 60:.0f} min"] if i == 0 else ["", ""]
            print("|", " | ".join(first + [label] + score + last), "|")


def answer(report: Any) -> Any:
    return {"named": report["name"], "noResidual": "no residual", "unknown": "unknown"}.get(
        report["decision"]
    ) or "one of: " + ", ".join(
        [one["name"] for one in report["set"]] + ["something else"] * report["somethingElseInSet"]
    )


def unseen(name: str, report: Any) -> dict[str, Any]:
    """Labels and reports of conditions that no fit used, one line of the table each."""
    folder = CASES / name / "results"
    if report["heldOut"].get("before"):
        return {", ".join(report["heldOut"]["conditions"]): report}
    scored = read(folder / "heldOut/report.json")
    if scored:
        return {", ".join(scored["heldOut"]["conditions"]) + " (scored afterwards)": scored}
    left = {path.parent.name: read(path) for path in sorted(folder.glob("leftOut/*/report.json"))}
    return {f"{one} (fit without it: {answer(each)})": each for one, each in left.items()}


OLD_RULE = "not judged"  # a report from before the joint test of held-out data; --run renews it
CANDIDATES = 5  # effects in the picture's left panel


def picture(names: list[str], file: Path) -> None:
    """A row for each study, from the measurement to the answer: how well each effect explains the training data;
    then each condition that no fit used, as measured and as simulated without and with the effect that was named.
    """
    from clepsydra import picture_style
    from clepsydra.picture_style import pyplot

    rows = [
        (name, report, [(label, each["heldOut"]["numbers"]) for label, each in unseen(name, report).items()])
        for name in names
        for report in [read(CASES / name / "results/report.json")]
        if report and unseen(name, report)
    ]
    if not rows:
        raise SystemExit("no condition of these studies was held out, or left out: nothing to draw")
    most = max(len(panels) for _, _, panels in rows)
    figure, axes = pyplot.subplots(
        len(rows),
        1 + most,
        figsize=(3.4 + 2.7 * most, 3.4 * len(rows)),
        squeeze=False,
        constrained_layout=True,
        width_ratios=[1.3] + most * [1],
    )
    for row, (name, report, panels) in zip(axes, rows):
        draw_candidates(row[0], report)
        study = yaml.safe_load((CASES / name / "study.yaml").read_text())
        for place, panel in enumerate(row[1:]):
            panel.set_visible(place < len(panels))
            if place < len(panels):
                draw_unseen(panel, panels[place], study, picture_style, place == 0)
    figure.savefig(file, dpi=picture_style.DPI)


def draw_candidates(axes: Any, report: Any) -> None:
    judged = [one for one in report["effects"] if one["logOdds"] is not None and one.get("chiSquare") is not None]
    best = sorted(judged, key=lambda one: one["chiSquare"])[:CANDIDATES]
    bars = [("no effect", report["null"]["chiSquare"]), *((one["name"], one["chiSquare"]) for one in reversed(best))]
    colours = ["0.6" if name != report["name"] else "tab:blue" for name, _ in bars]
    axes.barh([name for name, _ in bars], [value for _, value in bars], color=colours)
    axes.set(xscale="log", xlabel="discrepancy (chi-square) of the best fit", title=f"answer: {answer(report)}")
    axes.tick_params(labelsize=7)
    axes.title.set_fontsize(9)


def draw_unseen(axes: Any, panel: Any, study: dict[str, Any], picture_style: Any, first: Any) -> None:
    where, numbers = panel
    features = {one.get("name", one["kind"]): one for one in study["observable"]["features"]}
    marks = [
        ("measured", "measured", "black", "o", "black"),
        ("before", "simulated, without the effect", picture_style.STEPS["dry"], "s", "none"),
        ("after", "simulated, with the best effect", picture_style.LINE, "D", "none"),
    ]
    # speeds against the way over which they are means, where all features are such
    ways = [features[one["feature"]] for one in numbers]
    are_speeds = all("peed" in way["kind"] and "to" in way for way in ways)
    for kind, label, colour, mark, filling in marks:
        shown = [
            (
                500 * (way["from"] + way["to"]) if are_speeds else place,
                (1000 if are_speeds else 1) * one[kind]["value"],
                (1000 if are_speeds else 1) * one[kind]["standardError"],
            )
            for place, (one, way) in enumerate(zip(numbers, ways))
            if one[kind]
        ]
        x, y, error = zip(*shown) if shown else ([], [], [])
        axes.errorbar(x, y, error, color=colour, marker=mark, markerfacecolor=filling, linestyle="", label=label)
    if are_speeds:
        axes.set_xlabel("position [mm]")
    else:
        axes.set_xticks(range(len(numbers)), [one["feature"] for one in numbers])
    axes.set(title=f"predicted: {shown_condition(study, where)}", ylim=(0, None))
    axes.tick_params(labelsize=7)
    axes.title.set_fontsize(9)
    axes.grid(alpha=0.3)
    if first:
        axes.set_ylabel("velocity [mm/s]" if are_speeds else "SI units")
        axes.legend(fontsize=6, loc="lower left")


def shown_condition(study: dict[str, Any], where: Any) -> Any:
    """The particle's diameter where the conditions differ by it, else their names."""
    name = where.split(" (")[0]
    for one in study["conditions"]:
        if one["name"] == name and "particleDiameter" in one.get("set", {}):
            return f"sphere of {1000 * float(one['set']['particleDiameter']):g} mm"
    return name


def errors(report: Any) -> list[Any]:
    held_out = report["heldOut"]
    scores = [held_out.get(one) for one in ("before", "after", "oneMoreParameter")]
    return [f"{100 * one['rmsLogError']:.1f} ± {100 * one['standardError']:.1f} %" if one else "" for one in scores] + [
        f"{100 * held_out['noiseFloor']:.1f} %" if held_out.get("noiseFloor") else "",
        grade(report),
        ("yes" if held_out["complete"] else "no") if "complete" in held_out else OLD_RULE,
    ]


def grade(report: Any) -> str:
    """Whether a name is only the one effect that fits, or also predicts better than no effect and both controls, or
    besides agrees with a measurement of its amplitude."""
    if not report["name"]:
        return ""
    if report["heldOut"].get("better") is not True:
        return {False: "named", None: OLD_RULE}[report["heldOut"].get("better")]
    measured = [effect.get("measured") for effect in report["effects"] if effect["name"] == report["name"]]
    return "measured" if measured and all(one and one["agrees"] for one in measured) else "better"


def by_condition(report: Any) -> Iterator[Any]:
    """Where several conditions were held out together: lines of the table for each."""
    conditions = report["heldOut"]["conditions"]
    for condition in conditions if len(conditions) > 1 else []:
        numbers = [one for one in report["heldOut"]["numbers"] if one["condition"] == condition]
        # where no effect explains the residual, the numbers after are those of the nearest one, which is no answer
        given = [when for when in ("before", "after") if report["heldOut"].get(when)]
        yield f"&nbsp; {condition} alone", [rms_log_error(numbers, when) for when in given] + (6 - len(given)) * [""]


def rms_log_error(numbers: Any, when: Any) -> str:
    logs = [math.log(one[when]["value"] / one["measured"]["value"]) for one in numbers if one[when]]
    return f"{100 * math.sqrt(statistics.mean(log * log for log in logs)):.1f} %" if logs else ""


def read(path: Path) -> Any:
    return json.loads(path.read_text()) if path.exists() else None


if __name__ == "__main__":
    main()
