"""Where things lie."""

from pathlib import Path
from typing import Any

import yaml

CASE = Path(__file__).resolve().parents[1]
RESULTS = CASE / "results"
PARAMETER_STUDY = CASE / "parameterStudy.yaml"


def hopper() -> Any:
    """The parameters of cases/paper/hopper.yaml."""
    return yaml.safe_load((CASE / "hopper.yaml").read_text())["parameters"]
