#!/usr/bin/python3
"""Compares the particles' mean speed across the bed at three heights with the measured one: its mean, its value on the
axis, the width of the jet, and the rms difference of bands of 20 mm. With --quick the pressure drop through a bed at
rest with the drag law, and the solid volume that particleMeans has found with that of the particles."""

import json
from math import hypot
from pathlib import Path
from typing import Any

import numpy as np

from beds import RUN, Bed, store
from clepsydra import case_files, closures, particle_means, validation

# A fifth: what other codes' beds of this kind differ by from measurements; the width by the distance of points, too.
TOLERANCES = {"mean": 20, "axis": 20, "width": 30}
NAMES = {"mean": "mean speed across the bed", "axis": "speed on the axis", "width": "width of the jet"}
NOT_TRACED = "tried with parcels of twice the diameter, one drag law, one packing and one mesh; not traced"


def main() -> None:
    bed = Bed(RUN)
    if bed["meansFrom"] > 0:
        validation.write(rows_beside_measurement(bed))
        store()
    else:
        validation.write(rows_at_rest(bed))


# --- the jet ---


def rows_beside_measurement(bed: Bed) -> list[dict[str, Any]]:
    measured = json.loads(Path("measured.json").read_text())
    rows = []
    parcels = "" if bed["coarseGraining"] == 1 else f", parcels of {bed['coarseGraining'] ** 3:g} particles"
    for height, features in measured["heights"].items():
        profile = bed.profile(float(height))
        ours, errors = of_profile(profile, features)
        for name, tolerance in TOLERANCES.items():
            reference = features[name]
            rows.append(
                validation.row(
                    f"{NAMES[name]} at {height} of its height, {bed['dragLaw']}{parcels}",
                    "m" if name == "width" else "m/s",
                    reference["value"],
                    measured["source"],
                    "measured",
                    ours[name],
                    hypot(reference["error"], errors[name]),
                    tolerance,
                    finding=NOT_TRACED,
                    repeats=errors[name],
                )
            )
        difference = rms(in_bands(profile, features["bandWidth"]) - np.array(features["bands"]))
        print(
            f"at {height} of the height at rest: rms difference of bands of {1e3 * features['bandWidth']:g} mm "
            f"{difference:.4f} m/s, {difference / features['mean']['value']:.2f} of the measured mean"
        )
    return rows


def of_profile(profile: particle_means.Profile, features: dict[str, Any]) -> tuple[dict[str, float], dict[str, float]]:
    """Values, and the standard errors that the same values of the blocks of time give: the jet swings as a whole, so
    that the errors of neighbouring places are not independent."""
    values = features_of(profile.x, profile.speed, features)
    blocks = [features_of(profile.x, block, features) for block in profile.blocks]
    errors = {name: float(np.nanstd([block[name] for block in blocks], ddof=1) / len(blocks) ** 0.5) for name in values}
    return values, errors


def features_of(x: np.ndarray, speeds: np.ndarray, features: dict[str, Any]) -> dict[str, float]:
    speed = np.nan_to_num(speeds)
    inside = (x >= features["from"]) & (x <= features["to"])
    return {
        "mean": particle_means.mean_across(x[inside], speed[inside]),
        "axis": float(speed[np.argmin(np.abs(x))]),
        "width": particle_means.width_at_half(x, speed),
    }


def in_bands(profile: particle_means.Profile, band: float) -> np.ndarray:
    edges = np.arange(-0.14, 0.14 + band / 2, band)
    fine = np.linspace(edges[0], edges[-1], 10 * (len(edges) - 1), endpoint=False) + band / 20
    return np.interp(fine, profile.x, np.nan_to_num(profile.speed)).reshape(-1, 10).mean(axis=1)


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


# --- the small bed at rest ---


def rows_at_rest(bed: Bed) -> list[dict[str, Any]]:
    ours, law = pressure_drops(bed)
    means = case_files.columns(bed.run, "particleMeans")
    last = means[:, means[0] == means[0, -1]]
    solid = np.sum(last[5] / last[4]) * particle_volume(bed)
    by_fraction = np.sum(last[11]) * bed["binWidth"] * bed["binHeight"] * bed["depth"]
    return [
        validation.row(
            "pressure drop within the bed at rest, above the jet",
            "Pa",
            law,
            f"{bed['dragLaw']}, cells' void fraction",
            "computed",
            ours,
            1e-3 * ours,
            2,
        ),
        validation.row(
            "solid volume in the bins of particleMeans",
            "m3",
            bed["particleCount"] * particle_volume(bed),
            "number and diameter",
            "computed",
            by_fraction,
            abs(by_fraction - solid) + 1e-9 * solid,
            0.001,
        ),
    ]


def particle_volume(bed: Bed) -> float:
    return float(np.pi / 6 * bed["particleDiameter"] ** 3)


def pressure_drops(bed: Bed) -> tuple[float, float]:
    """Between the lowest and the highest layer of cells with uniform flow: from the width of the vessel above
    the floor to five diameters below the top. The drag law's: its gradient in each layer, by the trapezoidal rule."""
    cell = bed["height"] / bed["cellsUp"]
    void_fractions, areas = layers(bed, "voidFraction")
    pressure = bed["fluidDensity"] * np.average(layers(bed, "p")[0], axis=1, weights=areas)
    solid = np.average(1 - void_fractions, axis=1, weights=areas)
    top = solid.sum() * cell / solid.max()
    middles = (np.arange(len(pressure)) + 0.5) * cell
    inside = np.flatnonzero((middles > bed["width"]) & (middles < top - 5 * bed["particleDiameter"]))
    if len(inside) < 3:
        raise SystemExit(f"{bed.run}: the bed is {top:g} m high; its uniform part has {len(inside)} layers of cells")
    gradients = [layer_gradient(bed, void_fractions[layer], areas) for layer in inside]
    return float(pressure[inside[0]] - pressure[inside[-1]]), float(np.trapz(gradients, dx=cell))


def layers(bed: Bed, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Values above the floor, a row for each layer of cells, and the cells' shares of its area. The mesh has three
    blocks there: left, middle and right."""
    values = case_files.field(bed.run, case_files.times(bed.run)[-1], name)[:, 0]
    up, deep = int(bed["cellsUp"]), int(bed["cellsDeep"])
    side = (bed["width"] - bed["channelWidth"]) / 2
    blocks, areas, start = [], [], 0
    for count, width in (("cellsBeside", side), ("cellsInChannel", bed["channelWidth"]), ("cellsBeside", side)):
        cells = int(bed[count]) * deep
        blocks.append(values[start : start + cells * up].reshape(up, cells))
        areas.append(np.full(cells, width / bed["width"] / cells))
        start += cells * up
    return np.hstack(blocks), np.concatenate(areas)


def layer_gradient(bed: Bed, void_fractions: np.ndarray, areas: np.ndarray) -> float:
    """The gradient [Pa/m] that is the same in all cells of a layer and lets all of the air pass: more of it where there
    are fewer particles, at the walls."""
    velocity = bed["jetVelocity"] * bed["channelWidth"] / bed["width"]
    trials = velocity * np.geomspace(0.5, 2, 15)
    curves = [gradients(bed, one, trials) for one in void_fractions]
    common = np.geomspace(max(curve[0] for curve in curves), min(curve[-1] for curve in curves), 200)
    passing = sum(area * np.interp(common, curve, trials) for area, curve in zip(areas, curves))
    return float(np.interp(velocity, passing, common))


def gradients(bed: Bed, void_fraction: float, velocities: np.ndarray) -> np.ndarray:
    """[Pa/m] at superficial velocities, by the drag law."""
    return closures.bed_pressure_gradients(velocities, void_fraction, bed.parameters)


main()
