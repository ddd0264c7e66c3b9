"""Where things lie."""

from pathlib import Path

import yaml

CASE = Path(__file__).resolve().parents[1]
RESULTS = CASE / "results"
PARAMETER_STUDY = CASE / "parameterStudy.yaml"


def hopper():
    """The parameters of cases/paper/hopper.yaml."""
    return yaml.safe_load((CASE / "hopper.yaml").read_text())["parameters"]
