"""Names that the truths and the answers of the record have, and what they are called today.

The record stays as it was committed; whatever reads it applies this table, after the hashes have been checked.
"""

import re
from typing import Any

# Of effects and of a case's entries: wherever the word stands.
NAMES = {
    "beadDiameter": "particleDiameter",
    "beadDensity": "particleDensity",
    "beadCount": "particleCount",
    "momentumOfLeavingBeads": "momentumOfLeavingParticles",
    "couplingInterval": "couplingTimeStep",
    "smoothingLength": "smoothingBandwidth",
}
# Keys of a report, where they are keys.
KEYS = {
    "misfit": "chiSquare",
    "wrongNamesOfFoils": "wrongNamesOfDecoys",
    "foils": "decoys",
}
OLD_NAME = re.compile(r"\b(" + "|".join(NAMES) + r")\b")


def today(content: Any) -> Any:
    """What JSON holds, with today's names."""
    if isinstance(content, dict):
        return {KEYS.get(key, renamed(key)): today(value) for key, value in content.items()}
    if isinstance(content, list):
        return [today(one) for one in content]
    return renamed(content) if isinstance(content, str) else content


def renamed(text: str) -> str:
    return OLD_NAME.sub(lambda found: NAMES[found[0]], text)
