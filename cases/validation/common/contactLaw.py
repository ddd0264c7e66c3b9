#!/usr/bin/python3
"""LIGGGHTS' Hertz-Mindlin contact in the coefficients of other codes.

LIGGGHTS 3.8, pair gran model hertz: normal damping 2 sqrt(5/6) b sqrt(S_n m), S_n = 2 E* sqrt(R delta),
b = -ln e/sqrt(ln^2 e + pi^2); tangential the same with S_t = 8 G* sqrt(R delta). Tsuji, Tanaka & Ishida, Powder
Technol. 71, 239 (1992), write alpha sqrt(m k) delta^1/4 with k = 4/3 E* sqrt(R): so alpha = sqrt(5) b.

LAMMPS' pair granular takes alpha as a polynomial in a restitution coefficient, which is not the inverse of the formula
above; tsujiRestitution is what its polynomial must be given. Its tangential damping is a multiple of the normal one:
sqrt(S_t/S_n) = 2 sqrt(G*/E*), G* = Y/(4 (2 - nu) (1 + nu)), E* = Y/(2 (1 - nu^2)).

usage: contactLaw.py tsujiDamping RESTITUTION | tsujiRestitution RESTITUTION | tangentialDamping POISSON_RATIO
"""

import math
import sys

from scipy.optimize import brentq


def tsujiDamping(restitution):
    """alpha."""
    logarithm = math.log(restitution)
    return math.sqrt(5) * -logarithm / math.sqrt(logarithm**2 + math.pi**2)


def tsujiRestitution(restitution):
    """What to give to LAMMPS, so that its polynomial returns alpha."""
    coefficients = (1.2728, -4.2783, 11.087, -22.348, 27.467, -18.022, 4.8218)

    def excess(given):
        return sum(c * given**power for power, c in enumerate(coefficients)) - tsujiDamping(restitution)

    return brentq(excess, 0.1, 0.9999)


def tangentialDamping(poissonRatio):
    """Tangential over normal damping."""
    return 2 * math.sqrt((1 - poissonRatio) / (2 * (2 - poissonRatio)))


if __name__ == "__main__":
    _, quantity, value = sys.argv
    formulas = {formula.__name__: formula for formula in (tsujiDamping, tsujiRestitution, tangentialDamping)}
    print(formulas[quantity](float(value)))
