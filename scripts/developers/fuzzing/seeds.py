"""What the mutations begin with: the repository's own files. Each function fills a target's working folder and gives
texts."""

import re
import shutil
import zipfile
from pathlib import Path
from typing import Any

import yaml

from clepsydra.environment import REPOSITORY

CASES = REPOSITORY / "cases"
TUTORIALS = CASES / "tutorials"
EFFECTS = REPOSITORY / "identification/effects"
SURROGATE = REPOSITORY / "tests/identification/surrogate"
CURVE = zipfile.Path(CASES / "paper/results/runs.zip", "fill100packings-0.8.100019.dry.csv")
BLIND_SET = zipfile.Path(CASES / "studies/blindHopper/data.zip", "set1.csv")


def formulas(_: Path) -> list[Any]:
    found: set[Any] = set()
    for file in EFFECTS.glob("*.yaml"):
        for effect in yaml.safe_load(file.read_text())["effects"]:
            found.update(str(text) for text in {**effect.get("set", {}), **effect.get("chain", {})}.values())
    return sorted(found)


def tables(_: Path) -> list[Any]:
    rows = BLIND_SET.read_text().splitlines()
    discharge = [row.split(",", 2)[2] + "\n" for row in rows[:30]]  # behind condition and repeat
    return [
        "".join(discharge),
        CURVE.read_text()[:1500],
        "# Time\tmass [g]\n0\t(1)\n1\t(.5)\n2\t(.1)\n",
        "time;mass\n0,0;1,5\n1,0;\n2,0;.5\n3,0;NA\n",
    ]


def studies(folder: Path) -> list[Any]:
    """Beside the surrogate for a case, a small library and a measured file, which the texts name in place of their
    own."""
    (folder / "case").mkdir()
    shutil.copy(SURROGATE / "case/parameters", folder / "case")
    (folder / "curve.csv").write_text(CURVE.read_text()[:1500])
    (folder / "library.yaml").write_text('effects: [ { name: lag, chain: { lag: "0.3*a" } } ]\n')
    files = [SURROGATE / "study.yaml", *sorted(CASES.glob("studies/*/study.yaml"))]
    return [beside_surrogate(file.read_text()) for file in files] + [beside_surrogate(STUDY_OF_CURVES)]


def beside_surrogate(study: str) -> str:
    study = re.sub(r"\bcase: .*", "case: case", study)
    study = re.sub(r"\bdependsOn: \[[^]]*\]", "dependsOn: [case]", study)
    study = re.sub(r"\beffectsFrom: .*", "effectsFrom: library.yaml", study)
    return re.sub(r"[\w/.*]+\.csv\b", "curve.csv", study)


STUDY_OF_CURVES = """study: curves
simulator: { case: case, seed: seed, set: { dragFactor: 1.1 } }
observable: { file: out.dat, value: mass, features: [ { name: rate, kind: logMeanRate, from: 0.9, to: 0.2 } ] }
measured:
  time: { column: time, unit: s }
  value: { column: 2, unit: g, factor: -1, offset: 0.1, valid: [0, 1] }
conditions:
  - { name: one, role: training, measured: { files: [curve.csv, curve.csv] } }
  - { name: two, role: heldOut, set: { friction: 0.2 },
      measured: { numbers: [ { feature: rate, unit: g/s, relativeError: 0.01, values: [11] } ] } }
parameters: [ { name: mu, set: { friction: "mu*1.5" }, prior: { mean: 0.15, sd: 0.05, from: measured },
  range: [0.02, 0.8] } ]
effects: [
  { name: wall, set: { frictionWall: "frictionWall*(1 + a)" }, amplitude: [-1, 1] },
  { name: on, set: { lubrication: 1 }, switch: true } ]
withoutEffects: on
"""


def effects(_: Path) -> Any:
    texts = [file.read_text() for file in sorted(EFFECTS.glob("*.yaml"))]
    # Single effects as well: short texts are mutated quickest.
    single = [yaml.safe_dump({"effects": [effect]}) for text in texts for effect in yaml.safe_load(text)["effects"]]
    return texts + single


def parameters(_: Path) -> list[Any]:
    return [file.read_text() for file in sorted(CASES.glob("**/parameters"))] + [
        "a  1;\nb  $a; // b\n",
        "a  2;\nb  #eval{ round($a)*sqrt(2) };\n",
    ]


def coupling_properties(folder: Path) -> list[str]:
    """The cases' own, with all that they include. What a step's script would write stands in `step`."""
    for part in ("constant", "system", "DEM"):
        (folder / part).mkdir()
    (folder / "parameters").write_text(
        "".join((TUTORIALS / case / "parameters").read_text() for case in ("hopperQuick", "settlingParticle"))
    )
    (folder / "step").write_text(
        '#include "$FOAM_CASE/parameters"\nstepFluid incompressible;\nstepScript "DEM/in.particle";\n'
        "stepRestart end.restart;\n"
    )
    for file in (TUTORIALS / "settlingParticle/system").glob("vessel.*"):
        shutil.copy(file, folder / "system")
    (folder / "DEM/in.particle").write_text("")
    return [
        (TUTORIALS / case / "constant/couplingProperties").read_text() for case in ("settlingParticle", "hopperQuick")
    ]
