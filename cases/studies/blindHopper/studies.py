"""study.yaml with other files, further conditions, or nothing held out. As text: numbers keep the form that stored runs
know."""

import json
import re
import subprocess
from pathlib import Path
from typing import Any

import measurements
import old_names
import record
import yaml

HERE = Path(__file__).resolve().parent


def study(replaced: Any, further: Any = "", held_out: bool = True) -> Any:
    """replaced: {text: by what}; further: blocks of conditions."""
    text = (HERE / "study.yaml").read_text()
    for name, block in conditions("study.yaml").items():
        if not held_out and "role: heldOut" in block:
            text = text.replace(block, "")
    text = text.replace("\nparameters:", further + "\nparameters:")
    for old, new in replaced.items():
        text = text.replace(old, new)
    return text


def report(trace_residual: Any, results: Path, file: str, text: str) -> Any:
    """What traceResidual says of a study; from the report, where there is one. file: a name for the study."""
    path = str((results / "report.json").relative_to(HERE))
    if record.read(path) is None:
        (HERE / file).write_text(text)
        subprocess.run([trace_residual, "run", "--output", results, HERE / file], check=True)
    return old_names.today(json.loads(record.answer(path)))


def measured_by(name: str) -> dict[str, Any]:
    """What makes the study that of a set: {text: by what}, with a file for each of its discharges."""
    return {"work/data/SET/": f"{measurements.unpack(name).relative_to(HERE)}/"}


def conditions(file: str) -> dict[Any, Any]:
    """{name: block of text} of its conditions."""
    text = (HERE / file).read_text().split("\nconditions:\n")[1].split("\nparameters:")[0]
    blocks = re.split("^(?=  - name: )", text, flags=re.MULTILINE)[1:]
    return {yaml.safe_load(block)[0]["name"]: block for block in blocks}
