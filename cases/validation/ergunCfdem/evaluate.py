#!/usr/bin/python3
"""Compares pressure gradients and pressure drops of the bed with Koch & Hill's law, and with CFDEMcoupling's results.

The law needs a void fraction. That of the packing comes from the particles' positions, cut by horizontal planes; the
program's own from its cells. The difference of the two pressure drops is what the mesh costs at the bed's ends."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import case_files, closures, parameter_file, validation

# Of CFDEMcoupling-PUBLIC's own run of its tutorial ErgunTestMPI, by its two probes: superficial velocity -> Pa
CFDEM = {0.0038: 54.1, 0.0074: 102.9, 0.011: 149.4}
GRAVITY = 9.81
INNER_DIAMETERS = 3  # from the bottom and from the top, where walls do not order the particles
CELLS_OF_BLOCKS = (64, 32, 32, 32, 32)  # per layer of cells, in the order of the mesh's blocks
AT_ENDS = "the cell layer that the bed's top fills in part, and half a cell below it, have little drag"


class Bed:
    def __init__(self, run: Path) -> None:
        self.run, self.parameters = run, parameter_file.parameters(run / "parameters")
        self.velocity = float(run.name.removeprefix("bed").split("-")[0])
        self.layers = int(self["cellsUp"])
        self.cell_height = self["height"] / self.layers
        self.diameter = self["particleDiameter"]
        self.heights = case_files.dumped_particles(run)[0][1][:, 3]

    def __getitem__(self, name: str) -> Any:
        return self.parameters[name]

    # --- the law ---

    def gradient(self, void_fraction: float) -> float:
        return closures.bed_pressure_gradient(
            self.velocity, void_fraction, {**self.parameters, "dragLaw": "KochHillDrag"}
        )

    @property
    def particle_volume(self) -> float:
        return np.pi / 6 * self.diameter**3

    @property
    def area(self) -> float:
        return np.pi * self["radius"] ** 2

    # --- the packing ---

    def inner_void_fraction(self) -> float:
        margin = INNER_DIAMETERS * self.diameter
        low, high = margin, self.heights.max() - margin
        solid = self.volume_below(high) - self.volume_below(low)
        return float(1 - solid / self.area / (high - low))

    def volume_below(self, height: float) -> float:
        radius = self.diameter / 2
        depth = np.clip(height - self.heights + radius, 0, self.diameter)
        return float(np.sum(np.pi * depth**2 * (3 * radius - depth) / 3))

    def drop_of_packing(self) -> float:
        """If all of the bed were as its inner part is."""
        void_fraction = self.inner_void_fraction()
        return self.gradient(void_fraction) * self.solid_height / (1 - void_fraction)

    def load(self) -> float:
        """Buoyant weight per cross-section [Pa]."""
        return (self["particleDensity"] - self["fluidDensity"]) * GRAVITY * self.solid_height

    @property
    def solid_height(self) -> float:
        return len(self.heights) * self.particle_volume / self.area

    # --- the simulation ---

    def layer_means(self, name: str) -> np.ndarray:
        """Means over the layers of cells by volume, from the bottom up."""
        time = case_files.times(self.run)[-1]
        layer = np.concatenate([np.repeat(np.arange(self.layers), cells) for cells in CELLS_OF_BLOCKS])
        volume = case_files.field(self.run, time, "V")[:, 0]
        values = case_files.field(self.run, time, name)[:, 0]
        return np.bincount(layer, volume * values) / np.bincount(layer, volume)

    def inner_layers(self) -> tuple[int, int]:
        """The first and the last whose middles are INNER_DIAMETERS from the bed's ends."""
        middles = (np.arange(self.layers) + 0.5) * self.cell_height
        margin = INNER_DIAMETERS * self.diameter - self.cell_height / 2
        inner = np.flatnonzero((middles > margin) & (middles < self.heights.max() - margin))
        return int(inner[0]), int(inner[-1])

    def inner_gradients(self) -> tuple[float, float]:
        """Of the pressure, and of the law with the void fraction of the same layers."""
        first, last = self.inner_layers()
        pressure = self["fluidDensity"] * self.layer_means("p")
        ours = (pressure[first] - pressure[last]) / (last - first) / self.cell_height
        weights = np.ones(last - first + 1)
        weights[[0, -1]] = 0.5
        law = [self.gradient(one) for one in self.layer_means("voidFraction")[first : last + 1]]
        return ours, float(np.average(law, weights=weights))

    def drop(self) -> float:
        """From the inlet to the outlet [Pa]."""
        return self["fluidDensity"] * case_files.surface_values(self.run, "inletPressure")[1][-1, 0]

    def drop_between_probes(self) -> float:
        p = np.loadtxt(self.run / "postProcessing/probes/0/p")[-1]
        return self["fluidDensity"] * (p[1] - p[2])


def rows_of(bed: Bed) -> list[dict[str, Any]]:
    where = f"U {bed.velocity:g} m/s, cells of {1e3 * bed.cell_height:.2g} mm"
    solver = 1e-4  # share of a pressure drop that the solvers' tolerance leaves
    drop, of_packing = bed.drop(), bed.drop_of_packing()
    if of_packing > bed.load():
        reference, source = bed.load(), "buoyant weight, which the flow lifts"
    else:
        reference, source = of_packing, "Koch & Hill 2001, packing's void fraction"
    rows = [
        validation.row(
            f"pressure drop, {where}", "Pa", reference, source, "computed", drop, solver * drop, 5, finding=AT_ENDS
        )
    ]
    if reference == of_packing:
        ours, law = bed.inner_gradients()
        source = "Koch & Hill 2001, cells' void fraction"
        rows.append(
            validation.row(f"gradient within the bed, {where}", "Pa/m", law, source, "computed", ours, solver * ours, 5)
        )
    if bed["particleCount"] == 10000 and bed.layers == 24:
        rows.append(
            validation.row(
                f"between the tutorial's probes, {where}",
                "Pa",
                CFDEM[bed.velocity],
                "CFDEMcoupling, its own packing",
                "otherCode",
                bed.drop_between_probes(),
                0.02 * bed.drop_between_probes(),  # one packing from another
                5,
                finding="its void fraction is that of marker points; the rest of the difference is not traced",
            )
        )
    return rows


def main() -> None:
    beds = [Bed(run) for run in sorted(Path("runs").glob("bed*"))]
    validation.write([row for bed in beds for row in rows_of(bed)])
    for bed in beds:
        print(
            f"{bed.run.name}: void fraction of the packing {bed.inner_void_fraction():.4f}, bed"
            f" {1e3 * bed.heights.max():.1f} mm high, {bed.drop():.1f} Pa"
        )


main()
