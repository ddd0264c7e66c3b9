"""The one particle of cases/tutorials/settlingParticle."""

from rules import Rule, length, number, oneOf, whole

SWITCH = oneOf("on", "off")
RULES = {
    "particleDiameter": length(1e-5, 0.1), "particleDensity": number(0.1, 3e4, "kg/m3"), "release": oneOf("centre", "edge"),
    "edgeGap": length(0, 10), "releaseHeight": length(0, 100), "releaseSpeed": number(-100, 100, "m/s"),
    "fluidDensity": number(0.1, 3e4, "kg/m3"), "fluidViscosity": number(1e-9, 10, "m2/s"),
    "viscosityStep": number(-10, 10), "stepHeight": length(-100, 100), "stepWidth": length(1e-6, 10), "stepLag": number(-100, 100),
    "viscosityGradient": number(-100, 100, "1/m"), "inclination": number(-90, 90, "degrees"),
    "dragLaw": Rule("a word", lambda value: isinstance(value, str)),
    "addedMassCoefficient": number(0, 5), "historyForce": oneOf("none", "Basset", "MeiAdrian"), "lubrication": SWITCH,
    "lubricationReach": number(1e-3, 1e4), "roughness": length(1e-12, 1e-2), "wallCorrection": oneOf("none", "DiFelice1996", "Faxen"),
    "vessel": oneOf("box", "tank"), "cellsHigh": whole(1, 10**4), "cellsAcross": whole(1, 10**4), "cellSize": length(1e-6, 10),
    "tankDiameter": length(1e-4, 100), "tankHeight": length(1e-4, 100), "cellsCore": whole(1, 10**4),
    "cellsRing": whole(1, 10**4), "smoothingBandwidth": length(1e-6, 1e3), "selfInducedVelocityCorrection": oneOf("off", "Oseen"),
    "youngsModulus": number(1e5, 1e12, "Pa"), "restitution": number(0.05, 1), "couplingTimeStep": number(1e-9, 1, "s"),
    "demStep": number(1e-12, 1e-1, "s"), "maxRayleighFraction": number(1e-6, 1e6), "endTime": number(1e-9, 1e5, "s"),
    "stopBelow": length(-100, 100),
}


def findings(text, p, ranks, part, found):
    """Adds to `found`. p: the entries of the text, each of them as RULES says."""
    width = p["cellsAcross"] * p["cellSize"] if p["vessel"] == "box" else p["tankDiameter"]
    height = p["cellsHigh"] * p["cellSize"] if p["vessel"] == "box" else p["tankHeight"]
    if p["particleDiameter"] >= width:
        found.problems.append(f"particleDiameter {p['particleDiameter']:g} m; allowed: less than the vessel's width, {width:g} m")
    if not p["particleDiameter"] / 2 <= p["releaseHeight"] <= height - p["particleDiameter"] / 2:
        found.problems.append(f"releaseHeight {p['releaseHeight']:g} m; allowed: half a particle from floor and top, "
                              f"{p['particleDiameter'] / 2:g} to {height - p['particleDiameter'] / 2:g} m")
    steps = p["couplingTimeStep"] / p["demStep"]
    if round(steps) < 1 or abs(steps - round(steps)) > 1e-6 * steps:
        found.problems.append(f"couplingTimeStep {p['couplingTimeStep']:g} s is {steps:.6g} demSteps; allowed: a whole number")
    found.facts.append(f"vessel: {width:g} m wide, {height:g} m high; particle of {p['particleDiameter']:g} m")
