#!/usr/bin/python3
"""Error rates of traceResidual with a surrogate of the solver: false alarms, detection, right names, sets of
candidates, answers `unknown`, coverage of intervals, the same answer with other seeds; and of the held-out conditions,
how often a wrong and a right effect may enter the model.

Prints the table of all seeds that have been run (takes seconds). With --run SEED, options of
build/bin/checkIdentification may follow, for instance --libraries 3. """

import argparse
import json
import subprocess
import tempfile
from pathlib import Path
from typing import Any

from scipy.stats import binomtest

from clepsydra import environment, whole_files

ROOT = environment.REPOSITORY
RESULTS = ROOT / "identification/results/statistics.json"  # a list of what checkIdentification writes for each seed
SURROGATE = ROOT / "tests/identification/surrogate"
TITLES = {
    (False, True): "Runs scatter; sizes and viscosity are measured with a gauge",
    (False, False): "Runs scatter; sizes and viscosity may be wrong like any other effect",
    (True, True): "Runs do not scatter (seed: none)",
}
USUAL = {"libraries": 12, "nulls": 20, "effects": 11, "unknowns": 3, "pairs": 2, "again": 2, "draws": 500}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--run", metavar="SEED", help="run one seed first, half an hour, into identification/results/statistics.json"
    )
    given, options = parser.parse_known_args()
    if given.run:
        run(given.run, options)
    elif options:
        parser.error(f"{options[0]}: only --run SEED has options, those of build/bin/checkIdentification")
    results = json.loads(RESULTS.read_text())
    for kind, title in TITLES.items():
        of_kind = [one for one in results if kind_of(one) == kind]
        if of_kind:
            print(f"{title}: ", end="")
            table(of_kind)


def run(seed: str, options: list[str]) -> None:
    usual = [word for name, number in USUAL.items() for word in (f"--{name}", str(number))]
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "statistics.json"
        study = [str(SURROGATE / "study.yaml"), "--gauged", str(SURROGATE / "gauged.yaml")]
        command = [str(environment.program("checkIdentification")), *study, *usual, "--seed", seed, *options]
        subprocess.run([*command, "--output", str(output)], check=True, stdout=subprocess.DEVNULL)
        keep(json.loads(output.read_text()))


def keep(result: dict[str, Any]) -> None:
    """In the place of an earlier result of the same seed and kind."""

    def place(one: dict[str, Any]) -> tuple[tuple[bool, bool], int]:
        return kind_of(one), one["seed"]

    results = [one for one in json.loads(RESULTS.read_text()) if place(one) != place(result)]
    results = sorted([*results, result], key=place)
    with whole_files.replacing(RESULTS) as file:
        json.dump(results, file, indent=1)
        file.write("\n")


def kind_of(result: dict[str, Any]) -> tuple[bool, bool]:
    """Whether runs of the simulator do not scatter, and whether sizes and viscosity were measured with a gauge."""
    return result["exact"], bool(result.get("gauged"))


def table(seeds: list[dict[str, Any]]) -> None:
    print(f"seeds {', '.join(str(one['seed']) for one in seeds)}; {sum(one['libraries'] for one in seeds)} libraries\n")
    print("| | measured [95 %] |\n|---|---|")
    row("false alarms at nominal 5 %", seeds, "falseAlarms")
    row("p below one half, without any effect", seeds, "pValueBelowHalf")
    row("effects detected", seeds, "effects", "detected")
    for name, key in (
        ("best is the truth", "topOneWhenDetected"),
        ("truth in the set", "truthInSetWhenDetected"),
        ("named", "namedWhenDetected"),
        ("amplitude in its interval", "intervalCoversWhenDetected"),
    ):
        row(f"of these: {name}", seeds, "effects", key)
    row("of these named: rightly", seeds, "effects", "namedRightly")
    detected = [one["effects"]["detected"].get("count", 0) for one in seeds]
    sizes = [one["effects"]["meanSetSize"] or 0 for one in seeds]
    print(f"| mean size of the set | {sum(n * size for n, size in zip(detected, sizes)) / sum(detected):.2f} |")
    worst = min(seeds[0]["byEffect"], key=lambda name: covered(seeds, name))
    row(f"truth in the set, worst effect ({worst})", seeds, "byEffect", worst, "truthInSetWhenDetected")
    row("same answer with other seeds of its own runs", seeds, "sameAnswerWithOtherSeeds")
    for size in ("1.00", "0.50", "0.25"):
        row(f"outside the library, size {size}: wrong name", seeds, "outsideLibrary", size, "wrongNameWhenDetected")
        row("unknown, or a set with something else", seeds, "outsideLibrary", size, "somethingElseWhenDetected")
    row("better, without being the truth, of all data sets with one effect or none", seeds, "falseAcceptance")
    row("of these without an effect", seeds, "nulls", "falseAcceptance")
    row("of these with an effect of the library", seeds, "effects", "falseAcceptance")
    for size in ("1.00", "0.50", "0.25"):
        row(f"of these outside the library, size {size}", seeds, "outsideLibrary", size, "falseAcceptance")
    row("named rightly: better", seeds, "rightAcceptance")
    row("named rightly: complete", seeds, "effects", "completeWhenNamedRightly")
    row("fall of the held-out error in its 95 % interval", seeds, "coverageOfFall")
    for size in ("1.00", "0.50", "0.25"):
        row(f"the same, outside the library, size {size}", seeds, "outsideLibrary", size, "coverageOfFall")
    row("two effects: the pair in the set", seeds, "pairs", "truthInSetWhenDetected")
    row("two effects: better, without being the pair", seeds, "pairs", "falseAcceptance")
    row("two effects: a name", seeds, "pairs", "namedWhenDetected")
    row("of these: of the pair, and no part of it", seeds, "pairs", "namedRightly")


def covered(seeds: list[dict[str, Any]], effect: str) -> float:
    count, of = counted(seeds, "byEffect", effect, "truthInSetWhenDetected")
    return count / of if of else 1


def counted(seeds: list[dict[str, Any]], *keys: Any) -> tuple[int, int]:
    parts = []
    for one in seeds:
        for key in keys:
            one = one.get(key, {})  # a kind of data sets may have been left out
        parts.append(one)
    return sum(part.get("count", 0) for part in parts), sum(part.get("of", 0) for part in parts)


def row(name: str, seeds: list[dict[str, Any]], *keys: Any) -> None:
    count, of = counted(seeds, *keys)
    if of:
        lower, upper = binomtest(int(count), int(of)).proportion_ci(method="wilson")
        print(f"| {name} | {count:.0f} of {of:.0f}: {100 * count / of:.1f} % [{100 * lower:.0f}, {100 * upper:.0f}] |")


if __name__ == "__main__":
    main()
