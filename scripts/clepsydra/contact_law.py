#!/usr/bin/python3
"""LIGGGHTS' Hertz-Mindlin contact in the coefficients of other codes.

LIGGGHTS 3.8, pair gran model hertz: normal damping 2 sqrt(5/6) b sqrt(S_n m), S_n = 2 E* sqrt(R delta),
b = -ln e/sqrt(ln^2 e + pi^2); tangential the same with S_t = 8 G* sqrt(R delta). Tsuji, Tanaka & Ishida, Powder
Technol. 71, 239 (1992), write alpha sqrt(m k) delta^1/4 with k = 4/3 E* sqrt(R): so alpha = sqrt(5) b.

LAMMPS' pair granular takes alpha as a polynomial in a restitution coefficient, which is not the inverse of the formula
above; tsuji_restitution is what its polynomial must be given. Its tangential damping is a multiple of the normal one:
sqrt(S_t/S_n) = 2 sqrt(G*/E*), G* = Y/(4 (2 - nu) (1 + nu)), E* = Y/(2 (1 - nu^2)). """

import argparse
import math

from scipy.optimize import brentq


def tsuji_damping(restitution: float) -> float:
    """alpha."""
    logarithm = math.log(restitution)
    return math.sqrt(5) * -logarithm / math.sqrt(logarithm**2 + math.pi**2)


def tsuji_restitution(restitution: float) -> float:
    """What to give to LAMMPS, so that its polynomial returns alpha."""
    coefficients = (1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218)

    def excess(given: float) -> float:
        return sum(c * given**power for power, c in enumerate(coefficients)) - tsuji_damping(restitution)

    return brentq(excess, 0.1, 0.9999)


def tangential_damping(poisson_ratio: float) -> float:
    """Tangential over normal damping."""
    return 2 * math.sqrt((1 - poisson_ratio) / (2 * (2 - poisson_ratio)))


FORMULAS = {
    "tsujiDamping": tsuji_damping,
    "tsujiRestitution": tsuji_restitution,
    "tangentialDamping": tangential_damping,
}


def main() -> None:
    parser = argparse.ArgumentParser(
        description="A contact law's coefficient as another code wants it, from LIGGGHTS'."
    )
    parser.add_argument("quantity", choices=FORMULAS)
    parser.add_argument("value", type=float, help="the restitution coefficient; of tangentialDamping, Poisson's ratio")
    given = parser.parse_args()
    print(FORMULAS[given.quantity](given.value))


if __name__ == "__main__":
    main()
