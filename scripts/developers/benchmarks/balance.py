"""How evenly the particles are spread over many ranks while a hopper empties: counts, no times."""

import shutil

from developers.benchmarks.hopper import Hopper

from . import timing

RANKS = (8, 16)
TABLE = "thermo_style custom step atoms f_balance\n"


def busiest_rank_over_mean(hopper: Hopper, repetitions: int) -> timing.Figure:
    ratios = {ranks: ratios_on(hopper, ranks) for ranks in RANKS}
    return timing.Figure(
        [max(of) for of in ratios.values()],
        target="<= 1.3",
        meaning="particles of the busiest rank over the mean, the largest value of a dry discharge, "
        + " and ".join(f"{ranks} ranks" for ranks in RANKS),
        details={f"{ranks} ranks, mean over time": sum(of) / len(of) for ranks, of in ratios.items()},
    )


def ratios_on(hopper: Hopper, ranks: int) -> list[float]:
    """The value of `fix balance` at the end of each coupling step."""
    run = hopper.run("dry", f"balancedOn{ranks}", hopper.parameters["dryTime"], ranks)
    scripts = run.folder / "DEM"
    original = scripts.resolve()
    scripts.unlink()
    shutil.copytree(original, scripts)
    with open(scripts / "in.discharge", "a") as script:
        script.write(TABLE)
    timing.timed(run)
    rows = [line.split() for line in (run.folder / "log.liggghts").read_text().splitlines()]
    count = f"{hopper.parameters['particleCount']:.0f}"
    return [float(row[2]) for row in rows if len(row) == 3 and row[1] == count]
