"""What both evaluate.py and profile read: a run of the bed, and its profiles."""

import tempfile
import zipfile
from pathlib import Path
from typing import Any

from clepsydra import parameter_file, particle_means

REACH = 4e-3  # [m] along x and z, within which particles count for a place
STEP = 4e-3  # [m] from place to place
BLOCK = 0.5  # [s] of the blocks of time that give the standard errors
EDGE = 0.136  # [m] the outermost places

RUN = Path("runs/bed")
STORED = Path("means.zip")  # of RUN, what a profile needs: it is committed, a run is not


def store() -> None:
    columns = particle_means.ParticleMeans(RUN).columns[: particle_means.SPEED + 1]
    rows = "".join(f"{' '.join(f'{value:.6g}' for value in row)}\n" for row in columns[:, columns[-2] > 0].T)
    contents = {
        "parameters": (RUN / "parameters").read_text(),
        "postProcessing/particleMeans/0/particleMeans.dat": rows,
    }
    with zipfile.ZipFile(STORED, "w") as archive:
        for name, text in contents.items():
            archive.writestr(zipfile.ZipInfo(name), text, zipfile.ZIP_DEFLATED)


def stored() -> "Bed":
    """The bed of the committed run."""
    with tempfile.TemporaryDirectory() as folder:
        zipfile.ZipFile(STORED).extractall(folder)
        return Bed(Path(folder))


class Bed:
    def __init__(self, run: Path) -> None:
        self.run, self.parameters = run, parameter_file.parameters(run / "parameters")
        self.means = particle_means.ParticleMeans(run)

    def __getitem__(self, name: str) -> Any:
        return self.parameters[name]

    def profile(self, height_ratio: float) -> particle_means.Profile:
        """At a height over that of the bed at rest. SystemExit where the means do not reach so far."""
        height = height_ratio * self["restHeight"]
        if not REACH <= height <= self["meansTop"] - REACH:
            allowed = [end / self["restHeight"] for end in (REACH, self["meansTop"] - REACH)]
            raise SystemExit(f"height ratio {height_ratio:g}; allowed: {allowed[0]:g} to {allowed[1]:g}")
        return self.means.profile(height, REACH, -EDGE, EDGE, STEP, BLOCK)
