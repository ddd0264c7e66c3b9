"""What drives the fluid. Velocities at inlets: superficial in CFDEMcoupling where 0/voidfraction is fixed there,
between the particles here. fvOptions: those of OpenFOAM stay as they are, and CFDEMcoupling's own becomes the one of
OpenFOAM."""

import re
from typing import Any, Iterable

from clepsydra.cfdem_cases import foam_text
from clepsydra.cfdem_cases.report import Report

TERMS_OF_A_VARIABLE = 10
FIXED = ("fixedValue", "uniformFixedValue")
# Conditions by which no velocity through the patch is given: it follows from the cells, from the pressure, or is 0.
NOT_GIVEN = re.compile(
    r"zeroGradient|calculated|inletOutlet|advective|waveTransmissive|fluxCorrectedVelocity"
    r"|pressure\w*InletOutlet\w*|pressure(Directed)?Inlet(Uniform)?Velocity"
    r"|slip|noSlip|partialSlip|(moving|rotating|translating)WallVelocity"
    r"|symmetry(Plane)?|empty|wedge|cyclic\w*|processor\w*"
)
LIBRARIES = ("libfvOptionsCFDEM.so",)  # with CFDEMcoupling's own options
OF_THEIR_SOLVERS = ("twoPhase", "coupled", "voidfractionField", "alphaField", "alphaMin", "rhoField")


def converted(U: foam_text.Dictionary, void_fraction: foam_text.Dictionary, report: Report) -> Any:
    """Changes the patches of U, a Dictionary, whose velocity is superficial."""
    for patch, entries in U.sub("boundaryField").entries.items():
        if not isinstance(entries, foam_text.Dictionary):
            continue
        kind = entries.text("type", "")
        if kind not in FIXED:
            is_given = gives_inflow(entries) or not NOT_GIVEN.fullmatch(kind)
            if is_given and fixed_fraction(void_fraction.sub("boundaryField"), patch) is not None:
                report.error(
                    entries.where,
                    kind or "type",
                    "0/voidfraction is fixed there, so that the velocity is a superficial one, and this condition is "
                    f"not converted; allowed: {', '.join(FIXED)}, or voidfraction zeroGradient there"
                    + (", or inletValue uniform (0 0 0)" if gives_inflow(entries) else ""),
                )
            continue
        table = velocities(entries)
        if all(part == 0 for _, velocity in table for part in velocity):
            continue
        fraction = fixed_fraction(void_fraction.sub("boundaryField"), patch)
        if fraction is None:
            continue
        superficial = [(time, [fraction * part for part in velocity]) for time, velocity in table]
        if len(superficial) == 1:
            as_vector = vector(superficial[0][1])
            entries.entries = {
                "type": "interstitialInletVelocity",
                "inletVelocity": f"uniform {as_vector}",
                "alpha": "voidFraction",
                "value": f"uniform {as_vector}",
            }
        else:
            variables, parts = expression(superficial)
            entries.entries = {
                "type": "exprFixedValue",
                "value": f"uniform {vector(superficial[0][1])}",
                "variables": f"( {variables} )",
                "valueExpr": f'"vector({", ".join(parts)})/voidFraction"',
            }
        report.change(
            U.where,
            f"{patch} of U",
            (
                f"0/voidfraction is {fraction:g} there, so that the velocity is a superficial one; "
                "here the velocity at the patch is divided by the void fraction there"
            ),
        )


def gives_inflow(entries: foam_text.Dictionary) -> bool:
    """Whether the condition states the velocity of fluid that flows in."""
    return not re.fullmatch(r"uniform \( (0(\.0*)? ){3}\)", entries.text("inletValue", "uniform ( 0 0 0 )"))


def fixed_fraction(void_fraction: foam_text.Dictionary, patch: str) -> Any:
    """The value at the patch; None where it follows the cells, as it does here. voidFraction: the boundary field."""
    entries = (
        void_fraction.sub(patch)
        if patch in void_fraction
        else None
        if foam_text.is_pattern(patch)
        else void_fraction.matching(patch)
    )
    if entries is None:
        raise foam_text.FoamError(
            f"{void_fraction.where}: nothing for '{patch}', where U has a velocity; allowed: the same name, so "
            "that it is clear whether the velocity is superficial"
        )
    if entries.text("type") == "zeroGradient":
        return None
    if entries.text("type") != "fixedValue":
        raise foam_text.FoamError(
            f"{entries.where}: type {entries.text('type')}, where U has a velocity; allowed: fixedValue, zeroGradient"
        )
    value = entries.needed("value")
    if not re.fullmatch(r"uniform [-+.\deE]+", value):
        raise foam_text.FoamError(f"{entries.where}: value '{value}'; allowed: uniform NUMBER")
    return float(value.split()[1])


def velocities(entries: foam_text.Dictionary) -> Any:
    """Rows of a time and a velocity; one row where it does not change."""
    text = entries.needed("value" if entries.text("type") == "fixedValue" else "uniformValue")
    numbers = [float(word) for word in re.findall(r"[-+.\d][-+.\deE]*", text)]
    if re.match(r"(uniform|constant)? *\(", text) and len(numbers) == 3:
        return [(0, numbers)]
    if text.startswith("table") and numbers and len(numbers) % 4 == 0:
        return [(numbers[at], numbers[at + 1 : at + 4]) for at in range(0, len(numbers), 4)]
    raise foam_text.FoamError(
        f"{entries.where}: velocity '{text[:60]}'; allowed: uniform (X Y Z), constant (X Y Z), "
        "table ((TIME (X Y Z)) ...)"
    )


def vector(parts: Iterable[float]) -> str:
    return f"({' '.join(f'{part:.10g}' for part in parts)})"


def expression(table: list[tuple[float, list[float]]]) -> Any:
    """The table as OpenFOAM's expressions have it: straight lines between its times, constant before and after.
    Variables, and the three components in terms of them. One bracket deep and cut to pieces, since the parser cannot go
    deep, nor read more than 1024 characters at a time."""
    variables: list[str] = []
    parts: list[str] = []
    for axis, name in enumerate("xyz"):
        terms = component(table, axis)
        pieces = [" + ".join(terms[at : at + TERMS_OF_A_VARIABLE]) for at in range(0, len(terms), TERMS_OF_A_VARIABLE)]
        if len(pieces) == 1:
            parts.append(pieces[0])
        else:
            variables += [f'"{name}{number}={piece}"' for number, piece in enumerate(pieces)]
            parts.append(" + ".join(f"{name}{number}" for number in range(len(pieces))))
    return " ".join(variables), parts


def component(table: list[tuple[float, list[float]]], axis: int) -> list[str]:
    """The terms of a sum: the first value, and ramps that begin at the table's times."""
    terms, slope = [f"{table[0][1][axis]:.10g}"], 0.0
    for (before, low), (after, high) in zip(table, table[1:]):
        rise = high[axis] - low[axis]
        if after == before:
            terms += [f"{rise:.10g}*pos(time() - {after:.10g})"] if rise else []
            continue
        terms += ramp(rise / (after - before) - slope, before)
        slope = rise / (after - before)
    return terms + ramp(-slope, table[-1][0])


def ramp(slope: float, start: float) -> list[str]:
    return [f"{slope:.10g}*max(time() - {start:.10g}, 0)"] if abs(slope) > 1e-12 else []


def converted_sources(options: foam_text.Dictionary, report: Report) -> dict[str, Any]:
    """The options for the new case."""
    new: dict[str, Any] = {}
    for name, option in options.is_read().entries.items():
        is_theirs = isinstance(option, foam_text.Dictionary) and option.text("type") == "meanSupVelocityForce"
        new[name] = mean_velocity_force(option, report) if is_theirs else option
    return new


def mean_velocity_force(option: foam_text.Dictionary, report: Report) -> dict[str, Any]:
    coefficients = option.sub("meanSupVelocityForceCoeffs")
    kept = {name: value for name, value in coefficients.entries.items() if name not in OF_THEIR_SOLVERS}
    report.change(
        option.where,
        f"meanSupVelocityForce Ubar {kept.get('Ubar', '')}",
        "is OpenFOAM's meanVelocityForce here: Ubar is the mean of U between the particles, there of the void fraction"
        " times U. Divide it by the mean void fraction where that is not near 1",
    )
    active = {"active": option.entries["active"]} if "active" in option else {}
    return {"type": "meanVelocityForce", **active, "meanVelocityForceCoeffs": kept}
