"""Velocities at inlets: superficial in CFDEMcoupling where 0/voidfraction is fixed there, between the beads here."""

import re

import foamText

FIXED = ("fixedValue", "uniformFixedValue")


def converted(U, voidFraction, report):
    """Changes the patches of U, a Dictionary, whose velocity is superficial."""
    for patch, entries in U.sub("boundaryField").entries.items():
        if not isinstance(entries, foamText.Dictionary) or entries.text("type") not in FIXED:
            continue
        table = velocities(entries)
        if all(part == 0 for _, velocity in table for part in velocity):
            continue
        fraction = fixedFraction(voidFraction.sub("boundaryField"), patch)
        if fraction is None:
            continue
        superficial = [(time, [fraction * part for part in velocity]) for time, velocity in table]
        if len(superficial) == 1:
            asVector = vector(superficial[0][1])
            entries.entries = {"type": "interstitialInletVelocity", "inletVelocity": f"uniform {asVector}", "alpha": "voidFraction",
                               "value": f"uniform {asVector}"}
        else:
            entries.entries = {"type": "exprFixedValue", "value": f"uniform {vector(superficial[0][1])}",
                               "valueExpr": f'"{expression(superficial)}/voidFraction"'}
        report.change(U.where, f"{patch} of U", f"0/voidfraction is {fraction:g} there, so that the velocity is a superficial one; "
                      "it is divided by the void fraction of the beads at the patch now")


def fixedFraction(voidFraction, patch):
    """The value at the patch; None where it follows the cells, as it does here. voidFraction: the boundary field."""
    entries = voidFraction.sub(patch) if patch in voidFraction else None if foamText.isPattern(patch) else voidFraction.matching(patch)
    if entries is None:
        raise foamText.FoamError(f"{voidFraction.where}: nothing for '{patch}', where U has a velocity; allowed: the same name, so "
                                 "that it is clear whether the velocity is superficial")
    if entries.text("type") == "zeroGradient":
        return None
    if entries.text("type") != "fixedValue":
        raise foamText.FoamError(f"{entries.where}: type {entries.text('type')}, where U has a velocity; allowed: fixedValue, zeroGradient")
    value = entries.needed("value")
    if not re.fullmatch(r"uniform [-+.\deE]+", value):
        raise foamText.FoamError(f"{entries.where}: value '{value}'; allowed: uniform NUMBER")
    return float(value.split()[1])


def velocities(entries):
    """Rows of a time and a velocity; one row where it does not change."""
    text = entries.needed("value" if entries.text("type") == "fixedValue" else "uniformValue")
    numbers = [float(word) for word in re.findall(r"[-+.\d][-+.\deE]*", text)]
    if re.match(r"(uniform|constant)? *\(", text) and len(numbers) == 3:
        return [(0, numbers)]
    if text.startswith("table") and numbers and len(numbers) % 4 == 0:
        return [(numbers[at], numbers[at + 1:at + 4]) for at in range(0, len(numbers), 4)]
    raise foamText.FoamError(f"{entries.where}: velocity '{text[:60]}'; allowed: uniform (X Y Z), constant (X Y Z), "
                             "table ((TIME (X Y Z)) ...)")


def vector(parts):
    return f"({' '.join(f'{part:.10g}' for part in parts)})"


def expression(table):
    """The table as OpenFOAM's expressions have it: straight lines between its times, constant before and after."""
    return f"vector({', '.join(component(table, axis) for axis in range(3))})"


def component(table, axis):
    rows = [(time, velocity[axis]) for time, velocity in table]
    if all(value == rows[0][1] for _, value in rows):
        return f"{rows[0][1]:.10g}"
    text = f"{rows[-1][1]:.10g}"
    for (before, low), (after, high) in reversed(list(zip(rows, rows[1:]))):
        slope = (high - low) / (after - before) if after > before else 0
        line = f"{low:.10g}" if slope == 0 else f"{low:.10g} + {slope:.10g}*(time() - {before:.10g})"
        text = f"((time() < {after:.10g}) ? ({line}) : {text})"
    return f"((time() < {rows[0][0]:.10g}) ? {rows[0][1]:.10g} : {text})" if rows[0][0] > 0 else text
