#!/usr/bin/python3
"""Compares two sizes in one bed with the drag laws in a uniform suspension and with formulas of measurements."""

from pathlib import Path
from typing import Any

import numpy as np

from clepsydra import closures, validation
from clepsydra.column import GRAVITY, Column
from clepsydra.periods import error_by_parts
from clepsydra.picture_style import pyplot

SINGLE_PARTICLE = "BrownLawlerDrag"
ZONE = (0.25, 0.5)  # of the height: what neither the sediment nor the clear water reaches
SETTLING = (0.11, 0.33)  # [s]: after the start, before the large particles have left the zone
STEADY = 0.5  # of the run: after the layers have formed
SLIPS = np.geomspace(1e-3, 1, 400)


class Mixture:
    """Two sizes of particles in a column; index 0 is the larger."""

    def __init__(self, run: Path) -> None:
        self.column = column = Column(run)
        self.law = column["polydispersity"]
        self.diameter = np.array([column["particleDiameter"], column["smallDiameter"]])
        self.count = np.array([column["particleCount"], column["smallCount"]])
        self.volume = np.pi / 6 * self.diameter**3

    def sauter(self, volumes: np.ndarray) -> float:
        """Mean diameter of particles that have these volumes, or shares of it, in sum."""
        return volumes.sum() / (volumes / self.diameter).sum()

    def fluid(self) -> dict[str, Any]:
        return {name: self.column[name] for name in ("fluidDensity", "fluidViscosity")}

    def drag(self, size: int, void_fraction: float, sauter: float, slips: np.ndarray) -> np.ndarray:
        """Drag [N] at each interstitial slip speed by the run's laws."""
        options = self.fluid() | {
            "dragLaw": self.column["dragLaw"],
            "particleDiameter": self.diameter[size],
            "voidFraction": void_fraction,
            "slipSpeed": slips,
        }
        if self.law == "none":
            return slips * closures.values("drag", **options)
        options |= {"polydispersity": self.law, "sauterMeanDiameter": sauter}
        return slips * closures.values("polydisperseDrag", **options)

    def of_one_size(self, size: int, law: str) -> dict[str, Any]:
        return self.fluid() | {
            "dragLaw": law,
            "particleDiameter": self.diameter[size],
            "particleDensity": self.column["particleDensity"],
        }

    def terminal(self, size: int) -> float:
        return closures.value("terminalVelocity", **self.of_one_size(size, SINGLE_PARTICLE))

    def exponent(self, size: int) -> float:
        reynolds = self.terminal(size) * self.diameter[size] / self.column["fluidViscosity"]
        return closures.value("richardsonZakiExponent", reynolds=reynolds, diameterRatio=0)

    def sizes(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(time, particle) of the large and of the small: DEM/in.fill gives the large particles the first ids."""
        large = int(self.count[0])
        return values[:, :large], values[:, large:]


Reference = tuple[float, str, float, str]  # value, source, tolerance in percent, why it may be missed


def beside_both(
    title: str, unit: str, ours: tuple[float, float], by_law: Reference, by_measurements: Reference
) -> list[dict[str, Any]]:
    """Rows of one quantity, with its error, beside the drag law and beside a formula fitted to measurements."""
    return [
        validation.row(name, unit, reference, source, kind, *ours, tolerance, finding)
        for name, kind, (reference, source, tolerance, finding) in (
            (title, "computed", by_law),
            (title + " ", "measured", by_measurements),
        )
    ]


# --- fixed ---------------------------------------------------------------------------------------


def fixed_rows(mixture: Mixture) -> list[dict[str, Any]]:
    column = mixture.column
    p = column["fluidDensity"] * column.layers(column.times()[-1], "p")
    gradient = (p[0] - p[-1]) / column["height"] * len(p) / (len(p) - 1)
    speed = float(column["inletVelocity"].strip("()").split()[2])
    volumes = mixture.count * mixture.volume
    sauter = mixture.sauter(volumes)
    void_fraction = 1 - volumes.sum() / column.area / column["height"]
    slip = np.array([speed / void_fraction])
    drags = [mixture.drag(size, void_fraction, sauter, slip)[0] for size in (0, 1)]
    uniform = (mixture.count * drags).sum() / column.area / column["height"] / void_fraction
    ergun = closures.value(
        "ergunPressureGradient",
        **mixture.fluid(),
        particleDiameter=sauter,
        voidFraction=void_fraction,
        superficialVelocity=speed,
    )
    title = f"dp/dz, fixed, U {speed:g} m/s, {mixture.law}"
    apart = None
    if abs(uniform / ergun - 1) > 0.03:
        apart = (
            f"the drag law with polydispersity {mixture.law} gives {100 * (uniform / ergun - 1):+.1f} % in a uniform"
            " bed of this composition"
        )
    error = 1e-5 * abs(gradient)  # steady and laminar: what the solvers' tolerance leaves
    return [
        validation.row(title, "Pa/m", uniform, "the law in a uniform bed", "computed", gradient, error, 1),
        validation.row(
            title + " ",
            "Pa/m",
            ergun,
            "Ergun 1952 with the Sauter mean diameter, formula",
            "measured",
            gradient,
            error,
            3,
            apart,
        ),
    ]


# --- settling ------------------------------------------------------------------------------------


def net_velocities(slips: np.ndarray, solid: np.ndarray) -> np.ndarray:
    """Against the vessel, downwards, of sizes with these slip velocities where no volume flows in sum."""
    return slips - (solid * slips).sum()


class Settling:
    def __init__(self, mixture: Mixture) -> None:
        self.mixture = mixture
        column = mixture.column
        time, position, velocity = column.particles()
        during = (time > SETTLING[0]) & (time <= SETTLING[1])
        inside = (position[during, :, 2] > ZONE[0] * column["height"]) & (
            position[during, :, 2] < ZONE[1] * column["height"]
        )
        of_sizes = zip(mixture.sizes(-velocity[during, :, 2]), mixture.sizes(inside), mixture.volume)
        zone = (ZONE[1] - ZONE[0]) * column["height"] * column.area
        means, errors, solid = [], [], []
        for speeds, within, volume in of_sizes:
            histories = np.array([speed[here].mean() for speed, here in zip(speeds, within)])
            means.append(histories.mean())
            # particles of a zone, not times of it, are independent of each other
            errors.append(speeds[within].std() / np.sqrt(within.sum(axis=1).mean()))
            solid.append(within.sum(axis=1).mean() * volume / zone)
        self.velocity, self.error = np.array(means), np.array(errors)
        self.solid = np.array(solid)

    def by_laws(self) -> np.ndarray:
        mixture = self.mixture
        void_fraction = 1 - self.solid.sum()
        sauter = mixture.sauter(self.solid)
        excess = mixture.column["particleDensity"] - mixture.column["fluidDensity"]
        weights = mixture.volume * excess * GRAVITY * void_fraction
        slips = [np.interp(weights[size], mixture.drag(size, void_fraction, sauter, SLIPS), SLIPS) for size in (0, 1)]
        return net_velocities(np.array(slips), self.solid)

    def by_measurements(self) -> np.ndarray:
        """Slip v_t eps^(n - 1) of each size, with the void fraction of the whole mixture."""
        void_fraction = 1 - self.solid.sum()
        slips = [self.mixture.terminal(size) * void_fraction ** (self.mixture.exponent(size) - 1) for size in (0, 1)]
        return net_velocities(np.array(slips), self.solid)

    def rows(self) -> list[dict[str, Any]]:
        law = self.mixture.law
        laws, measured = self.by_laws(), self.by_measurements()
        print(
            f"settling, {law}: solid fractions {self.solid[0]:.3f} and {self.solid[1]:.3f}; velocities large and small"
            f" {self.velocity.round(4)} +- {self.error.round(4)}, by the laws {laws.round(4)}, Lockett & Al-Habbooby"
            f" {measured.round(4)} m/s"
        )
        rows = []
        for size, name in enumerate(("large", "small")):
            ours, error = self.velocity[size], self.error[size]
            rows += beside_both(
                f"v of the {name}, settling, {law}",
                "m/s",
                (ours, error),
                (laws[size], "the laws in a uniform suspension", 3, COLLISIONS),
                (
                    measured[size],
                    f"Lockett & Al-Habbooby 1973, formula, v_t by {SINGLE_PARTICLE}",
                    10,
                    f"the laws in a uniform suspension have {100 * (laws[size] / measured[size] - 1):+.1f} %; the"
                    " formula takes no account of the other size but for its volume",
                ),
            )
        return rows


COLLISIONS = (
    "in a uniform suspension of the laws neither size feels the other's particles, whereas here large ones run into"
    " small ones: we think that the contacts slow the large and carry the small along"
)


# --- fluidised -----------------------------------------------------------------------------------


class Fluidised:
    def __init__(self, mixture: Mixture) -> None:
        self.mixture = mixture
        column = mixture.column
        self.time, position, _ = column.particles()
        self.heights = [of_size[:, :, 2] for of_size in mixture.sizes(position)]
        late = self.time > STEADY * column["endTime"]
        self.means = np.array([heights[late].mean() for heights in self.heights])
        self.errors = np.array([error_by_parts(heights[late].mean(axis=1)) for heights in self.heights])
        self.purities = np.array(
            [self.share_below(large, small) for large, small in zip(*(h[late] for h in self.heights))]
        )
        time, velocity = column.top_velocity()
        self.velocity = velocity[time > STEADY * column["endTime"]].mean()

    def share_below(self, large: np.ndarray, small: np.ndarray) -> float:
        """Of the lower half of the solids the share that is of the large particles, which are half of the solids."""
        volumes = np.repeat(self.mixture.volume, [len(large), len(small)])[np.argsort(np.append(large, small))]
        lower = volumes[np.cumsum(volumes) <= volumes.sum() / 2]
        return lower[lower > self.mixture.volume[1]].sum() / lower.sum()

    def stacked(self, void_fractions: np.ndarray) -> np.ndarray:
        """Mean heights of two layers, the large particles below: Epstein's serial model."""
        mixture = self.mixture
        layers = mixture.count * mixture.volume / mixture.column.area / (1 - void_fractions)
        return np.array([layers[0] / 2, layers[0] + layers[1] / 2])

    def by_law(self) -> np.ndarray:
        grid = np.linspace(0.36, 0.98, 125)
        found = []
        for size in (0, 1):
            options = self.mixture.of_one_size(size, self.mixture.column["dragLaw"])
            speeds = closures.values("hinderedSettlingVelocity", voidFraction=grid, **options)
            found.append(np.interp(self.velocity, speeds, grid))
        return np.array(found)

    def by_measurements(self) -> np.ndarray:
        return np.array(
            [(self.velocity / self.mixture.terminal(size)) ** (1 / self.mixture.exponent(size)) for size in (0, 1)]
        )

    def rows(self) -> list[dict[str, Any]]:
        law = self.mixture.law
        own, measured = self.by_law(), self.by_measurements()
        print(
            f"fluidised, {law}: U {self.velocity:.4f} m/s; mean heights large and small"
            f" {(1000 * self.means).round(2)} +- {(1000 * self.errors).round(2)} mm; void fractions of the layers by"
            f" the law {own.round(3)}, by Richardson & Zaki {measured.round(3)}"
        )
        rows = []
        for size, name in enumerate(("large", "small")):
            ours, error = 1000 * self.means[size], 1000 * self.errors[size]
            rows += beside_both(
                f"mean height of the {name}, {law}",
                "mm",
                (ours, error),
                (
                    1000 * self.stacked(own)[size],
                    f"{self.mixture.column['dragLaw']}, layers one above the other",
                    5,
                    DENSER,
                ),
                (
                    1000 * self.stacked(measured)[size],
                    f"Richardson & Zaki 1954 for each layer, formula, v_t by {SINGLE_PARTICLE}",
                    10,
                    DENSER,
                ),
            )
        rows.append(
            validation.row(
                f"share of the large in the lower half of the solids, {law}",
                "1",
                1,
                "layers that do not mix",
                "computed",
                np.mean(self.purities),
                error_by_parts(self.purities),
                5,
            )
        )
        return rows


DENSER = (
    "waves make a fluidised bed denser than a uniform one of the same drag law, as in liquidFluidisedBed, and carry"
    " particles of either size into the other layer; with half the bandwidth the small are another 3 % lower"
)


def plot(settled: list[Settling], beds: list[Fluidised]) -> None:
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4.5))
    for index, one in enumerate(settled):
        left.errorbar(one.by_laws(), one.velocity, one.error, fmt=f"C{index}o", label=one.mixture.law)
        left.plot(one.by_laws(), one.by_measurements(), f"C{index}x")
    limits = [0, left.get_xlim()[1]]
    left.plot(limits, limits, "k-", linewidth=0.5)
    left.set_xlabel("settling velocity by the laws in a uniform suspension [m/s]")
    left.set_ylabel("here (o), by Lockett & Al-Habbooby (x) [m/s]")
    left.legend(title="polydispersity")
    for index, bed in enumerate(beds):
        for heights, style in zip(bed.heights, ("-", "--")):
            right.plot(bed.time, 1000 * heights.mean(axis=1), f"C{index}{style}", label=bed.mixture.law)
        for height in bed.stacked(bed.by_measurements()):
            right.axhline(1000 * height, color="k", linestyle=":", linewidth=0.8)
    right.set_xlabel("t [s]")
    right.set_ylabel("mean height [mm]: large (-), small (--)")
    right.set_title("dotted: pure layers by Richardson & Zaki", fontsize=9)
    right.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig("results/bidisperseBed.png", dpi=120)


runs = {run.name: Mixture(run) for run in sorted(Path("runs").iterdir())}
settled = [Settling(mixture) for name, mixture in runs.items() if name.startswith("settling")]
beds = [Fluidised(mixture) for name, mixture in runs.items() if name.startswith("fluidised")]
rows = [row for name, mixture in runs.items() if name.startswith("fixed") for row in fixed_rows(mixture)]
rows += [row for one in settled for row in one.rows()] + [row for bed in beds for row in bed.rows()]
validation.write(rows)
if settled:
    plot(settled, beds)
