"""The measurements of the sets.

data/SET.csv holds a whole set: a row for each reading, with its condition and its repeat. While a set is being
measured, and for traceResidual, each discharge is a file of its own: work/data/SET/CONDITION_REPEAT.csv. """

from pathlib import Path
from typing import Dict, List, Tuple

HERE = Path(__file__).resolve().parent
DATA = HERE / "data"
HEADER = "t_s,m_g"  # of a discharge
HEADER_OF_SET = "condition,repeat," + HEADER


def set_file(name: str) -> Path:
    return DATA / f"{name}.csv"


def folder(name: str) -> Path:
    return HERE / "work/data" / name


def discharges(name: str) -> Dict[str, str]:
    """{CONDITION_REPEAT: text of its CSV file} of a set; empty where the set has not been measured."""
    if not set_file(name).exists():
        return {}
    header, *rows = set_file(name).read_text().splitlines()
    if header != HEADER_OF_SET:
        raise SystemExit(f"{set_file(name)}: the first line is '{header}'; allowed is '{HEADER_OF_SET}'")
    texts: Dict[str, List[str]] = {}
    for row in rows:
        condition, repeat, reading = row.split(",", 2)
        texts.setdefault(f"{condition}_{repeat}", [HEADER]).append(reading)
    return {run: "\n".join(lines) + "\n" for run, lines in texts.items()}


def unpack(name: str) -> Path:
    """Writes a file for each discharge that data/SET.csv holds, and returns their folder."""
    for run, text in discharges(name).items():
        path = folder(name) / f"{run}.csv"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder(name)


def join(name: str) -> None:
    """Writes data/SET.csv from the files of the discharges: whole or not at all."""
    rows = [HEADER_OF_SET]
    for path in sorted(folder(name).glob("*_*.csv"), key=condition_and_repeat):
        condition, repeat = condition_and_repeat(path)
        header, *readings = path.read_text().splitlines()
        if header != HEADER:
            raise SystemExit(f"{path}: the first line is '{header}'; allowed is '{HEADER}'")
        rows += [f"{condition},{repeat},{reading}" for reading in readings]
    DATA.mkdir(exist_ok=True)
    unfinished = set_file(name).with_suffix(".unfinished")
    unfinished.write_text("\n".join(rows) + "\n")
    unfinished.rename(set_file(name))


def condition_and_repeat(path: Path) -> Tuple[str, int]:
    condition, repeat = path.stem.rsplit("_", 1)
    return condition, int(repeat)
