#!/usr/bin/python3
"""LIGGGHTS' Hertz-Mindlin contact in the coefficients of other codes.

LIGGGHTS 3.8, pair gran model hertz: normal damping 2 sqrt(5/6) b sqrt(S_n m), S_n = 2 E* sqrt(R delta),
b = -ln e/sqrt(ln^2 e + pi^2); tangential the same with S_t = 8 G* sqrt(R delta). Tsuji, Tanaka & Ishida, Powder
Technol. 71, 239 (1992), write alpha sqrt(m k) delta^1/4 with k = 4/3 E* sqrt(R): so alpha = sqrt(5) b.

usage: contactLaw.py tsujiDamping RESTITUTION
"""

import math
import sys


def tsujiDamping(restitution):
    """alpha."""
    logarithm = math.log(restitution)
    return math.sqrt(5) * -logarithm / math.sqrt(logarithm**2 + math.pi**2)


if __name__ == "__main__":
    _, quantity, value = sys.argv
    print({"tsujiDamping": tsujiDamping}[quantity](float(value)))
