#!/usr/bin/python3
"""The blind sets: what is committed belongs together, and the committed truth gives the committed data.

usage: blindHopper FOLDER     for copies and one run, made again

Fails where a set was answered again with another experiment than the program had asked for, where the false alarms on
nulls are not those listed, where a truth or an answer is not the one whose hash was committed, where results/score.json
or the table is not what the reports and the truths give, where the record or the measurements come out of their files
other than they went in, or where the real solver, with what set6's truth says was in it (a lid and a lagging scale),
does not give a measurement of that set once more. That the checks can fail is tried on copies in which one digit of a
truth or of an answer is changed, in the archive or beside it, and on the same measurement of the other sets, which is
another one. """

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import blind_run
import measurements
import numpy as np
import old_names
import record
import seals
import studies
import undeclared
import yaml

from clepsydra import environment

ROOT = Path(__file__).resolve().parents[2]
CASE = ROOT / "cases/studies/blindHopper"

SET, RUN = "set6", "drySmall_1"
SET_OF_THIRD_DRAW = "set23"
ALIKE = 0.04  # of the fill, rms: compilers differ in the last digit, and packings then go their own ways by 1 to 2 %


def main() -> None:
    folder = Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    said = check(CASE)
    require(said.returncode == 0, f"score --check fails on the committed files: {said.stderr}")
    for name in opened_sets():
        require(
            re.search(
                f"^{name}: truth .* as sealed.*; answer .* (as committed|not packed yet)", said.stdout, re.MULTILINE
            ),
            f"score --check does not say of {name} that truth and answer have their hashes",
        )
    changes_are_found(folder)
    nothing_is_lost_in_files(folder)
    what_is_measured_takes_the_place_of_what_is_archived(folder)
    old_names_are_read()
    study_is_changed_where_asked(folder)
    what_was_asked_for_was_measured()
    alarms_are_counted()
    measured_once_more(folder)
    print("truth, hashes, reports, score and data belong together")


def opened_sets() -> list[Any]:
    """What is still sealed stays sealed."""
    return [name for name in seals.set_names() if seals.is_open(name)]


def check(case: Any) -> Any:
    return subprocess.run([case / "score", "--check"], capture_output=True, text=True)


def changes_are_found(folder: Path) -> None:
    """In the archive, and in a file that lies beside it."""
    truth, answer, sealed = "truth/set1.json", "results/set1/report.json", "sealed/set17.json.enc"
    for name, path, digit in (("truth", truth, b'"friction": 0.2'), ("answer", answer, b'"pValue": 0.0')):
        content = record.archived()[path].replace(digit, digit[:-1] + b"1", 1)
        require(content != record.archived()[path], f"{path} has no {digit!r}")
        case = copy(folder / f"changed.{name}")
        record.write(record.archived() | {path: content}, case / "record.tar.xz")
        require(
            "its hash is not that of" in check(case).stderr, f"a changed {name} in the archive passes score --check"
        )
        case = copy(folder / f"beside.{name}")
        (case / path).parent.mkdir(parents=True, exist_ok=True)
        (case / path).write_bytes(content)
        require(
            "is not the file of that name in" in check(case).stderr,
            f"another {name} beside the archive passes score --check",
        )
    case = copy(folder / "changed.sealed")
    record.write(record.archived() | {sealed: record.archived()["sealed/set18.json.enc"]}, case / "record.tar.xz")
    require(check(case).returncode != 0, "another sealed file passes score --check")
    # An answer that is nowhere.
    case = copy(folder / "missing.answer")
    record.write(
        {path: content for path, content in record.archived().items() if path != answer}, case / "record.tar.xz"
    )
    require("there is no such answer" in check(case).stderr, "a missing answer passes score --check")


def nothing_is_lost_in_files(folder: Path) -> None:
    """The archive has the same bytes when it is packed once more; the measurements of a set are as many as its truth
    has seeds for, and the files that traceResidual reads give the set's own file back."""
    record.write(record.archived(), folder / "again.tar.xz")
    require(
        (folder / "again.tar.xz").read_bytes() == record.ARCHIVE.read_bytes(),
        "record.tar.xz packed again has other bytes",
    )
    case = copy(folder / "unpacked")
    candidates = blind_run.candidates()
    for name in opened_sets():
        runs = {run for run in measurements.discharges(name) if run.rsplit("_", 1)[0] not in candidates}
        require(runs == set(seals.open(name)["seeds"]), f"{name}.csv has other discharges than {name}'s truth")
    subprocess.run([case / "unpack", SET_OF_THIRD_DRAW], check=True)
    answer = f"results/{SET_OF_THIRD_DRAW}/report.json"
    require(
        (case / "work/record" / answer).read_bytes() == record.archived()[answer],
        f"{answer} is unpacked as something else",
    )
    files = sorted((case / f"work/data/{SET_OF_THIRD_DRAW}").glob("*.csv"))
    require(
        len(files) == 40,
        f"{SET_OF_THIRD_DRAW} is unpacked into {len(files)} files and not into 32 and 8 of one more condition",
    )
    together = measurements.set_files()[SET_OF_THIRD_DRAW].read_bytes()
    subprocess.run(
        [sys.executable, "-Bc", f"import measurements; measurements.join('{SET_OF_THIRD_DRAW}')"], cwd=case, check=True
    )
    require(
        (case / f"data/{SET_OF_THIRD_DRAW}.csv").read_bytes() == together,
        f"data/{SET_OF_THIRD_DRAW}.csv is not made of its discharges",
    )


def what_is_measured_takes_the_place_of_what_is_archived(folder: Path) -> None:
    case = copy(folder / "measured")
    (case / "data").mkdir(exist_ok=True)
    measured = case / f"data/{SET_OF_THIRD_DRAW}.csv"
    measured.write_text(f"{measurements.HEADER_OF_SET}\ndryLarge,1,0.000,1.000\n")
    for packed in (False, True):
        if packed:
            subprocess.run([case / "pack"], check=True, stdout=subprocess.DEVNULL)
            require(not measured.exists(), f"pack leaves {measured}")
        shutil.rmtree(case / "work", ignore_errors=True)
        subprocess.run([case / "unpack", SET_OF_THIRD_DRAW], check=True)
        files = {path.name: path.read_text() for path in (case / f"work/data/{SET_OF_THIRD_DRAW}").iterdir()}
        require(
            files == {"dryLarge_1.csv": "t_s,m_g\n0.000,1.000\n"},
            f"{measured} does not take the place of the file in data.zip",
        )


def old_names_are_read() -> None:
    """What was committed under an old name is read under today's, in truths and in answers."""
    for name in opened_sets():
        for effect in seals.open(name)["effects"]:
            require(effect["name"] in undeclared.BY_NAME, f"{name}: nobody knows the effect '{effect['name']}'")
    old = {path: content.decode() for path, content in record.archived().items() if path.endswith(".json")}
    require(
        any(old_names.OLD_NAME.search(text) for text in old.values()),
        "the record has none of the names of old_names.py",
    )
    for path, text in old.items():
        today = json.dumps(old_names.today(json.loads(text)))
        require(
            not old_names.OLD_NAME.search(today) and not any(f'"{key}":' in today for key in old_names.KEYS),
            f"{path} is read with an old name",
        )


def copy(target: Any) -> Any:
    shutil.copytree(CASE, target, ignore=shutil.ignore_patterns("work"))
    return target


def study_is_changed_where_asked(folder: Path) -> None:
    """What ./next and ./nulls make of study.yaml: traceResidual reads it, with what was added and without what was left
    out."""
    require(studies.study({}) == (CASE / "study.yaml").read_text(), "a study with nothing changed is another one")
    as_written = yaml.safe_load((CASE / "study.yaml").read_text())
    absolute = {
        as_written["simulator"]["case"]: str(blind_run.CASE),
        as_written["effectsFrom"]: str((CASE / as_written["effectsFrom"]).resolve()),
        "work/data/SET/": f"{folder}/unpacked/work/data/{SET_OF_THIRD_DRAW}/",
    }
    file = folder / "further.study.yaml"
    file.write_text(studies.study(absolute, "".join(studies.conditions("candidates.yaml").values()), held_out=False))
    said = subprocess.run([environment.program("traceResidual"), "plan", file], stdout=subprocess.PIPE, text=True)
    require(said.returncode == 0 and "effect library" in said.stdout, f"traceResidual plan {file} fails")
    names = re.findall("- name: (dry|wet)", file.read_text())
    require(len(names) == 7, f"{file} has {len(names)} conditions and not four of training and three candidates")


def what_was_asked_for_was_measured() -> None:
    """Each later answer is on the condition that the program had put first, and on no other one's data."""
    reports = [path for path in record.paths() if re.fullmatch("results/set[0-9]+/next/report.json", path)]
    require(reports, "no set was answered with what was measured next")
    for report in reports:
        name = report.split("/")[1]
        first = json.loads(record.answer(f"results/{name}/candidates/report.json"))["nextExperiment"][0]["condition"]
        measured = {run.rsplit("_", 1)[0] for run in measurements.discharges(name)} & set(
            studies.conditions("candidates.yaml")
        )
        require(measured == {first}, f"{name}: {first} was asked for, {measured} was measured")


def alarms_are_counted() -> None:
    path = CASE / "results/nulls.json"
    libraries = json.loads(path.read_text())
    require(len(libraries) > 1, f"{path} has one library only: all its sets share the error of that one")
    require(sum(found["of"] for found in libraries.values()) >= 100, f"{path} has fewer than 100 sets")
    for name, found in libraries.items():
        require(
            found["falseAlarms"] == sum(one["pValue"] < 0.05 for one in found["sets"])
            and found["of"] == len(found["sets"]),
            f"{path}, {name} counts other alarms than it lists",
        )


def measured_once_more(folder: Path) -> None:
    subprocess.run([CASE / "generate", "again", SET, RUN, folder / "again.csv"], check=True)
    again = readings("the measurement once more", (folder / "again.csv").read_text())
    for name in measurements.set_files():
        committed = readings(f"{name}, {RUN}", measurements.discharges(name)[RUN])
        require(
            again.shape == committed.shape,
            f"{name}, {RUN}: another number of readings than in the measurement once more",
        )
        apart = np.sqrt(np.mean((again[:, 1] - committed[:, 1]) ** 2)) / committed[0, 1]
        require(
            (apart < ALIKE) == (name == SET),
            f"the measurement once more is {apart:.3f} of the fill from {RUN} of {name}",
        )


def readings(where: Any, text: str) -> Any:
    header, *rows = text.splitlines()
    require(
        header == "t_s,m_g" and all(re.fullmatch(r"[\d.]+,-?[\d.]+", row) for row in rows),
        f"{where} holds more than readings",
    )
    return np.array([[float(field) for field in row.split(",")] for row in rows])


def require(holds: Any, message: str) -> None:
    if not holds:
        raise SystemExit(message)


main()
