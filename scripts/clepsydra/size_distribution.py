#!/usr/bin/python3
"""Lines of a LIGGGHTS script for particles whose diameters follow a truncated normal distribution.

Usage: sizeDistribution --mean D (--deviation S | --relativeDeviation S/D) [--cut 2] [--classes 9] [--density 2500]
[--type 1] [--name particles]

LIGGGHTS 3.8 takes one radius per template, so the distribution becomes several templates in one particledistribution:
classes of equal width from D - cut S to D + cut S [m], each with the diameter that keeps its particles' volume,
weighted by number. Use it by `include DEM/in.sizes` and `distributiontemplate <name>` in fix insert; --density may be a
variable of the script, '${particleDensity}'. """

import argparse
import math

from clepsydra import seeds


def density(x: float) -> float:
    return math.exp(-0.5 * x * x) / math.sqrt(2 * math.pi)


def probability(low: float, high: float) -> float:
    return 0.5 * (math.erf(high / math.sqrt(2)) - math.erf(low / math.sqrt(2)))


def mean_cube(mean: float, deviation: float, low: float, high: float) -> float:
    """Of mean + deviation x over the standard normal in [low, high], by Simpson's rule."""
    steps = 200
    width = (high - low) / steps
    total = 0.0
    for i in range(steps + 1):
        x = low + i * width
        weight = 1 if i in (0, steps) else (4 if i % 2 else 2)
        total += weight * density(x) * (mean + deviation * x) ** 3
    return total * width / 3 / probability(low, high)


def classes(mean: float, deviation: float, cut: float, count: int) -> list[tuple[float, float]]:
    """Pairs of diameter and share by number."""
    edges = [-cut + 2 * cut * i / count for i in range(count + 1)]
    whole = probability(-cut, cut)
    return [
        (mean_cube(mean, deviation, low, high) ** (1 / 3), probability(low, high) / whole)
        for low, high in zip(edges, edges[1:])
    ]


def script(options: argparse.Namespace) -> str:
    of_templates = seeds.seeds_from(seeds.ABOVE)
    sizes = classes(options.mean, options.deviation, options.cut, options.classes)
    lines = [
        (
            f"# diameters: normal, mean {options.mean:g} m, deviation {options.deviation:g} m, cut at"
            f" {options.cut:g} deviations"
        ),
        "# written by scripts/sizeDistribution",
    ]
    for number, (diameter, _) in enumerate(sizes, 1):
        lines.append(
            f"fix {options.name}Size{number} all particletemplate/sphere {next(of_templates)} atom_type {options.type} "
            f"density constant {options.density} radius constant {diameter / 2:.9g}"
        )
    shares = " ".join(f"{options.name}Size{number} {share:.9g}" for number, (_, share) in enumerate(sizes, 1))
    lines.append(
        f"fix {options.name} all particledistribution/discrete/numberbased {next(of_templates)} {len(sizes)} {shares}"
    )
    return "\n".join(lines)


def checked(options: argparse.Namespace, parser: argparse.ArgumentParser) -> argparse.Namespace:
    if options.deviation is None:
        options.deviation = options.relativeDeviation * options.mean
    if not options.mean > 0 or not options.deviation > 0 or not options.cut > 0 or options.classes < 1:
        parser.error("--mean, the deviation, --cut and --classes must be > 0")
    if options.cut * options.deviation >= options.mean:
        parser.error("--cut times --deviation must be less than --mean: diameters are positive")
    return options


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, usage=argparse.SUPPRESS
    )
    parser.add_argument("--mean", type=float, required=True)
    deviation = parser.add_mutually_exclusive_group(required=True)
    deviation.add_argument("--deviation", type=float)
    deviation.add_argument("--relativeDeviation", type=float)
    parser.add_argument("--cut", type=float, default=2)
    parser.add_argument("--classes", type=int, default=9)
    parser.add_argument("--density", default="2500")
    parser.add_argument("--type", default="1")
    parser.add_argument("--name", default="particles")
    print(script(checked(parser.parse_args(), parser)))


if __name__ == "__main__":
    main()
