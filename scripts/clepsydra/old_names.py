"""Names that entries of a file `parameters` had before version 1.0.0. An old name is refused with the new one."""

NEW_NAMES = {
    "beadDiameter": "particleDiameter",
    "beadDensity": "particleDensity",
    "beadCount": "particleCount",
    "beadOutlets": "particleOutlets",
    "drawBeads": "drawParticles",
    "couplingInterval": "couplingTimeStep",
    "smoothingLength": "smoothingBandwidth",
    "selfDisturbance": "selfInducedVelocityCorrection",
    "pourDuration": "fillingDuration",
    "pourTime": "fillingTime",
}
