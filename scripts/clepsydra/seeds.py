"""What LIGGGHTS 3.8 takes for a seed: a prime above 10000, another one for each of its commands."""

import itertools
import math
from typing import Iterator

ABOVE = 10000


def is_seed(number: int) -> bool:
    return number > ABOVE and all(number % divisor for divisor in range(2, math.isqrt(number) + 1))


def seeds_from(number: int) -> Iterator[int]:
    """All of them that are not smaller, in order."""
    return filter(is_seed, itertools.count(number))
