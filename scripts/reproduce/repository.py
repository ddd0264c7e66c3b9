"""Where things lie. To be imported first: it puts scripts/ on the path of modules."""

import sys
from pathlib import Path

import yaml

SCRIPTS = Path(__file__).resolve().parent.parent
CASE = SCRIPTS.parent / "cases" / "hopper5cm"
RESULTS = CASE / "results"
PARAMETER_STUDY = CASE / "parameterStudy.yaml"

sys.path.insert(0, str(SCRIPTS))


def hopper():
    """The parameters of cases/paper/hopper.yaml."""
    return yaml.safe_load((CASE / "hopper.yaml").read_text())["parameters"]
