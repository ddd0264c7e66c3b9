"""The measurements of the sets.

SET.csv holds a whole set: a row for each reading, with its condition and its repeat. A set that has just been measured
lies in data/; `./pack` moves it into data.zip. A file in data/ takes the place of the one in the archive. While a set
is being measured, and for traceResidual, each discharge is a file of its own: work/data/SET/CONDITION_REPEAT.csv. """

import zipfile
from pathlib import Path
from typing import Any, Dict, List, Tuple

HERE = Path(__file__).resolve().parent
DATA = HERE / "data"
ARCHIVE = HERE / "data.zip"
HEADER = "t_s,m_g"  # of a discharge
HEADER_OF_SET = "condition,repeat," + HEADER


def set_files() -> Dict[str, Any]:
    """{set: its file}, of all sets that have been measured; a file is a path in data/ or in the archive."""
    archived = zipfile.Path(ARCHIVE).iterdir() if ARCHIVE.exists() else []
    files = {path.name: path for path in archived} | {path.name: path for path in DATA.glob("*.csv")}
    return {name[: -len(".csv")]: path for name, path in sorted(files.items())}


def folder(name: str) -> Path:
    return HERE / "work/data" / name


def discharges(name: str) -> Dict[str, str]:
    """{CONDITION_REPEAT: text of its CSV file} of a set; empty where the set has not been measured."""
    file = set_files().get(name)
    if file is None:
        return {}
    header, *rows = file.read_text().splitlines()
    if header != HEADER_OF_SET:
        raise SystemExit(f"{file}: the first line is '{header}'; allowed is '{HEADER_OF_SET}'")
    texts: Dict[str, List[str]] = {}
    for row in rows:
        condition, repeat, reading = row.split(",", 2)
        texts.setdefault(f"{condition}_{repeat}", [HEADER]).append(reading)
    return {run: "\n".join(lines) + "\n" for run, lines in texts.items()}


def unpack(name: str) -> Path:
    """Writes a file for each discharge that SET.csv holds, and returns their folder."""
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
    unfinished = DATA / f"{name}.unfinished"
    unfinished.write_text("\n".join(rows) + "\n")
    unfinished.rename(DATA / f"{name}.csv")


def condition_and_repeat(path: Path) -> Tuple[str, int]:
    condition, repeat = path.stem.rsplit("_", 1)
    return condition, int(repeat)
