#!/usr/bin/python3
"""Start-up of a particle: terminal velocity, time to 95 % of it and distance fallen, against the measured ones."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, equation_of_motion, parameter_file, validation
from clepsydra.picture_style import pyplot

SOURCE = "Mordant & Pinton 2000, v = U (1 - exp(-3 t/tau_95))"
# By diameter [mm]: U [m/s], tau_95 [s]
MEASURED = {0.5: (0.0741, 0.055), 1.5: (0.218, 0.142)}
KERNELS = {"none": None, "Basset": equation_of_motion.basset, "MeiAdrian": equation_of_motion.mei_adrian}
LACKING = "the run has no history force, see those that have it"
REMAINING = (
    "the measured curve is an exponential fitted to a start that is none; Basset's kernel is for creeping flow, and "
    "holds the particle back too long at these Re"
)
# U: what fits of the drag of spheres scatter by. tau_95: the fit of an exponential to a curve that is none.
OF_U, OF_TAU, OF_DISTANCE = 5, 10, 5
# The run against its own equation of motion: the particle feels 1 % of its own wake, and tau_95 is where the curve is
# flat
OF_THE_EQUATION = 3


def main() -> None:
    found = [start(run) for run in sorted(Path("runs").iterdir())]
    for one in found:
        particle = equation_of_motion.Particle.of(one["parameters"])
        end = one["t"][-1]
        one["equation"] = equation_of_motion.motion(
            particle, end, added_mass=one["addedMass"], history=KERNELS[one["history"]]
        )
    validation.write([row for one in found for row in rows(one)])
    plot(found)


def start(run: Any) -> dict[str, Any]:
    p = parameter_file.parameters(run / "parameters")
    t, _, v = case_files.columns(run, "particleHeight")
    return {
        "diameter": 1e3 * p["particleDiameter"],
        "law": p["dragLaw"].removesuffix("Drag"),
        "addedMass": p["addedMassCoefficient"] > 0,
        "history": p["historyForce"],
        "t": t,
        "v": -v,
        "parameters": p,
    }


def forces(one: Any) -> str:
    if one["history"] != "none":
        return f"added mass, history after {one['history']}"
    return f"added mass {'on' if one['addedMass'] else 'off'}"


def terminal(t: Any, v: Any) -> tuple[Any, Any]:
    """Mean of the last tenth, and its standard deviation."""
    last = v[t > 0.9 * t[-1]]
    return last.mean(), last.std()


def time_to_95(t: np.ndarray, v: np.ndarray) -> float:
    rising = int(np.argmax(v)) + 1
    return float(np.interp(0.95 * terminal(t, v)[0], v[:rising], t[:rising]))


def distance(t: Any, v: Any, end: Any) -> Any:
    """Fallen up to `end`, over U `end`: the shape of the curve as a whole, whatever U is."""
    fine = np.linspace(0, end, 1000)
    return np.trapz(np.interp(fine, t, v), fine) / (terminal(t, v)[0] * end)


def rows(one: Any) -> list[Any]:
    U, tau = MEASURED[one["diameter"]]
    name = f"d {one['diameter']:g} mm, {one['law']}, {forces(one)}"
    run: tuple[np.ndarray, np.ndarray] = (one["t"], one["v"])
    speed, scatter = terminal(*run)
    expected = one["equation"]

    excess = 100 * ((terminal(*expected)[0] / U) ** 2 - 1)
    fast = (
        f"{name}: the measured particle has {excess:.0f} % more drag than the law, which fits many other spheres to 5 %"
    )
    slow = f"{name}: " + (LACKING if one["history"] == "none" else REMAINING)

    def row(
        quantity: str,
        unit: str,
        reference: Any,
        source: Any,
        kind: Any,
        ours: Any,
        uncertainty: Any,
        tolerance: float,
        finding: Any = None,
    ) -> Any:
        return validation.row(
            f"{name}: {quantity}", unit, reference, source, kind, ours, uncertainty, tolerance, finding
        )

    def pair(
        quantity: str,
        unit: str,
        measured: Any,
        ours: Any,
        equation: Any,
        uncertainty: Any,
        tolerance: float,
        finding: Any,
    ) -> list[Any]:
        """Against the measurement, and, so that a finding cannot hide a fault, against the equation solved."""
        return [
            row(quantity, unit, measured, SOURCE, "measured", ours, uncertainty, tolerance, finding),
            row(
                f"{quantity}, against its equation of motion",
                unit,
                equation,
                "equationOfMotion.py, one-way",
                "computed",
                ours,
                uncertainty,
                OF_THE_EQUATION,
            ),
        ]

    return [
        *pair("U", "m/s", U, speed, terminal(*expected)[0], float(np.hypot(scatter, 0.00005)), OF_U, fast),
        *pair("tau_95", "s", tau, time_to_95(*run), time_to_95(*expected), 0.0005, OF_TAU, slow),
        *pair(
            "distance by tau_95 over U tau_95",
            "-",
            1 - (1 - np.exp(-3)) / 3,
            distance(run[0], run[1], tau),
            distance(expected[0], expected[1], tau),
            0.002,
            OF_DISTANCE,
            slow,
        ),
    ]


def plot(found: Any) -> None:
    diameters = sorted({one["diameter"] for one in found})
    figure, panels = pyplot.subplots(1, len(diameters), figsize=(5.5 * len(diameters), 4.5), squeeze=False)
    for panel, diameter in zip(panels[0], diameters):
        U, tau = MEASURED[diameter]
        t = np.linspace(0, 3 * tau, 200)
        panel.plot(t, U * (1 - np.exp(-3 * t / tau)), "k--", label="measured, Mordant & Pinton")
        ours = [one for one in found if one["diameter"] == diameter]
        for one in ours:
            style = "--" if one["history"] != "none" else "-" if one["addedMass"] else ":"
            panel.plot(one["t"], one["v"], style, label=f"{one['law']}, {forces(one)}")
        panel.set(title=f"{diameter} mm glass in water", xlabel="time [s]", ylabel="velocity [m/s]")
        panel.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig("results/startUp.png", dpi=150)


if __name__ == "__main__":
    main()
