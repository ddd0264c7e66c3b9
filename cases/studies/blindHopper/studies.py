"""study.yaml with other files, further conditions, or nothing held out. As text: numbers keep the form that stored runs know."""

import json
import re
import subprocess
from pathlib import Path

import yaml

import measurements
import oldNames
import record

HERE = Path(__file__).resolve().parent


def study(replaced, further="", heldOut=True):
    """replaced: {text: by what}; further: blocks of conditions."""
    text = (HERE / "study.yaml").read_text()
    for name, block in conditions("study.yaml").items():
        if not heldOut and "role: heldOut" in block:
            text = text.replace(block, "")
    text = text.replace("\nparameters:", further + "\nparameters:")
    for old, new in replaced.items():
        text = text.replace(old, new)
    return text


def report(traceResidual, results, file, text):
    """What traceResidual says of a study; from the report, where there is one. file: a name for the study."""
    path = str((results / "report.json").relative_to(HERE))
    if record.read(path) is None:
        (HERE / file).write_text(text)
        subprocess.run([traceResidual, "run", "--output", results, HERE / file], check=True)
    return oldNames.today(json.loads(record.answer(path)))


def measuredBy(name):
    """What makes the study that of a set: {text: by what}, with a file for each of its discharges."""
    return {"work/data/SET/": f"{measurements.unpack(name).relative_to(HERE)}/"}


def conditions(file):
    """{name: block of text} of its conditions."""
    text = (HERE / file).read_text().split("\nconditions:\n")[1].split("\nparameters:")[0]
    blocks = re.split("^(?=  - name: )", text, flags=re.MULTILINE)[1:]
    return {yaml.safe_load(block)[0]["name"]: block for block in blocks}
