#!/usr/bin/python3
"""The numbers of study.yaml from the measured points, where these are (they are not ours to keep here)."""

from pathlib import Path
from typing import Any

import numpy as np

DATA = Path(__file__).resolve().parent / "../../../../shared/data/gondret2002_rebound/gondret_St152.csv"
# Times around a contact, as the features of study.yaml have them [s]
BEFORE, UNTIL, FROM, AFTER = 0.010, 0.0015, 0.002, 0.010
# Uncertainty of a contact's time: a quarter of the time between points [s]
OF_A_CONTACT = 0.5e-3


def main() -> None:
    if not DATA.exists():
        raise SystemExit(f"{DATA} is not here")
    time, gap = np.loadtxt(DATA, delimiter=",", skiprows=1).T
    # Contacts, where the last piece of each fall, extended by a parabola, reaches the wall
    hits = [closing(time, gap, *span) for span in ((-0.02, 0.0), (0.06, 0.082), (0.112, 0.130))]
    show("impactSpeed", "m/s", *speed(time, -gap, hits[0] - BEFORE, hits[0] - UNTIL))
    show("reboundSpeed", "m/s", *speed(time, gap, hits[0] + FROM, hits[0] + AFTER))
    ends = [*hits, time[-1] + 1e-6]
    for flight in range(3):
        show(f"height{flight + 1}", "mm", *(1e3 * value for value in top(time, gap, ends[flight], ends[flight + 1])))
    for flight in range(2):
        show(f"duration{flight + 1}", "ms", 1e3 * (hits[flight + 1] - hits[flight]), 1e3 * OF_A_CONTACT)


def closing(time: np.ndarray, gap: np.ndarray, begin: Any, end: Any) -> Any:
    """Time at which a parabola through a fall's last points above 0.2 mm is zero."""
    part = (time > begin) & (time < end) & (gap > 2e-4)
    part &= time > time[part][-1] - 0.0115
    roots = np.roots(np.polyfit(time[part], gap[part], 2)).real
    return roots[np.argmin(abs(roots - time[part][-1]))]


def speed(time: np.ndarray, value: Any, begin: Any, end: Any) -> tuple[Any, Any]:
    """Slope by least squares, and how it changes with the contact's time: the mean acceleration times that."""
    part = (time > begin) & (time < end)
    slope, _ = np.polyfit(time[part], value[part], 1)
    bend, _, _ = np.polyfit(time[part], value[part], 2)
    return slope, abs(2 * bend) * OF_A_CONTACT


def top(time: np.ndarray, gap: np.ndarray, begin: Any, end: Any) -> tuple[Any, Any]:
    """Of a cubic through the middle three fifths of a flight, and the scatter of its points."""
    part = (time > begin + 0.2 * (end - begin)) & (time < end - 0.2 * (end - begin))
    centre = time[part].mean()
    fit = np.polyfit(time[part] - centre, gap[part], 3)
    fine = np.linspace(time[part][0], time[part][-1], 2000) - centre
    return np.polyval(fit, fine).max(), np.std(np.polyval(fit, time[part] - centre) - gap[part])


def show(name: str, unit: str, value: Any, error: Any) -> None:
    print(f"{name}: {value:.5g} {unit}, relative error {error / value:.4f}")


if __name__ == "__main__":
    main()
