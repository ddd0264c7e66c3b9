#pragma once

namespace clepsydra::identification
{

/// The study that `traceResidual new` drafts. <word> stands for a guess, and <word|text> for a guess or, without one, for
/// the text. A line is left out if there is no guess for one of its other words, which may stand before it in brackets.
/// `case.` begins the entries of the case.
inline constexpr const char* studyTemplate =
    R"yaml(# Drafted by `traceResidual new`. All values are guesses; check each line. Values "FILL IN"
# could not be guessed; no run starts before they are replaced. All keys: docs/reference/study.md
study: <study>

simulator:
  case: <case>
  seed: <seed|none>            # the entry that changes the packing; none: repeated runs do not differ
  set:                  # your apparatus; an entry that is left out keeps the value of the case
    checked: "FILL IN: the values below are those of the case; make them those of your apparatus, then delete this line"
[case.vessel]    vessel: tank        # or box; see the case's file parameters
    particleDiameter: <case.particleDiameter>    # m
    particleDensity: <case.particleDensity>    # kg/m3
    particleCount: <case.particleCount>    # number of particles in the hopper
    hopperDiameter: <case.hopperDiameter>    # m
    orificeDiameter: <case.orificeDiameter>    # m
    fluidDensity: <case.fluidDensity>    # kg/m3
    fluidViscosity: <case.fluidViscosity>    # m2/s, kinematic
    tankDiameter: <case.tankDiameter>    # m
    tankHeight: <case.tankHeight>    # m
    releaseHeight: <case.releaseHeight>    # m, of the particle's centre above the floor
[case.dryTime]    dryTime: <duration|"FILL IN: s, more than the longest record">    # 1.5 times the longest training record
[case.submergedTime]    submergedTime: <duration|"FILL IN: s, more than the longest record">
[case.endTime]    endTime: <duration|"FILL IN: s, more than the longest record">    # 1.5 times the longest training record
    smoothingBandwidth: <twiceTheTank>    # m, twice the tank's diameter, so that the liquid stays at rest on any mesh
[twiceTheTank]    cellsCore: 2
[twiceTheTank]    cellsRing: 2
[twiceTheTank]    cellsHigh: 8
[twiceTheTank]    couplingTimeStep: 5e-3
[twiceTheTank]    demStep: 1e-4       # there are no contacts
[twiceTheTank]    maxRayleighFraction: 100

observable:
  file: <file|"FILL IN: the table that a run writes, as post/*/m.dat; a folder * stands for start times">
  value: <value|"FILL IN: its column">
[bounces]  offset: -particleDiameter/2       # gives the gap below the particle instead of the height of its centre
[countsDown]  factor: -1            # in the case, upward speeds and positions are positive
[fromRelease]  offset: releaseHeight # the measured position grows while the particle falls: the distance from the release
  # modelError: 0.01    # standard deviation of the model error (mesh, time steps) of each feature
  features:             # all training files pass through these shares of the fill, or these positions [m]
[isOfHopper]    - { name: early, kind: logMeanRate, from: 0.95, to: <share1|"FILL IN: smaller share"> }
[isOfHopper][share1]    - { name: middle, kind: logMeanRate, from: <share1>, to: <share2> }
[isOfHopper][share1]    - { name: late, kind: logMeanRate, from: <share2>, to: <share3> }
[endsFlat]    - { kind: residue }   # all training files end with a constant mass
[isPosition]    - { name: first, kind: logSpeed, from: <position1|"FILL IN: m">, to: <position2|"FILL IN: m"> }
[isPosition]    - { name: second, kind: logSpeed, from: <position2|"FILL IN: m">, to: <position3|"FILL IN: m"> }
    - { name: height1, kind: logBounceHeight, bounce: 1, level: <bounces> }
[bounces]    # - { name: duration1, kind: logBounceDuration, bounce: 1, level: <bounces> }   # to the next contact, if there is one
[isSpeed]    - { kind: logMaximum }
    - { kind: "FILL IN: one of <kinds>" }

measured:               # columns of all files, by name or number
  time:
    column: <timeColumn>
    unit: <timeUnit|"FILL IN: s, ms, min or h">
  value:
    column: <valueColumn>
    unit: <valueUnit|"FILL IN: one of g, kg, mm, m, ...">
[share]    factor: "FILL IN: <share>the mass in the hopper at the start, in kg"
[isReversed]    factor: -1
[isDischarged]    offset: "FILL IN: the mass in the hopper at the start, in kg; the files contain the discharged mass"
    valid: [<lowestValid>, <highestValid>]       # m; rows of 0 before or after all others count as missing

# One item per condition; its files are repeats. Files whose names differ in a mark at the end (10a and 10b, _1 and _2)
# are taken for repeats, all others for conditions; move a file to correct that. A condition with `role: heldOut` enters
# no fit, and the answer is tested on it. Roles are PROPOSED by the names alone, one condition inside the range and one
# at its end: decide now, before any of these values or any result has been seen, and do not change the roles later.
# With fewer than three conditions none is held out, and the prediction cannot be tested.
conditions:
<conditions>
# Fitted parameters have one value in all conditions; the prior is an independent measurement, a handbook's
# value or a guess (from: measured, handbook, guess), never these data
parameters:
[case.friction]  - name: friction
[case.friction]    set: { friction: friction }
[case.friction]    prior:
[case.friction]      mean: "FILL IN: friction between particles, measured independently on a tilted plate"
[case.friction]      sd: "FILL IN: its standard error"
[case.friction]      from: measured
[case.friction]    range: [0.02, 0.8]
[viscosity]  - name: logViscosity  # relative to fluidViscosity above
[viscosity]    set: { fluidViscosity: "fluidViscosity*exp(logViscosity)" }
[viscosity]    prior:
[viscosity]      mean: 0
[viscosity]      sd: "FILL IN: relative standard error of the viscosity, 0.05 for 5 %"
[viscosity]      from: "FILL IN: of the viscosity: measured, handbook or guess"
[viscosity]    range: [-1, 1]
[otherParameter]  - name: "FILL IN: a word"
[otherParameter]    set: "FILL IN: { entry: formula in the parameter's name }"
[otherParameter]    prior: { mean: "FILL IN: number", sd: "FILL IN: number", from: "FILL IN: measured, handbook or guess" }
[otherParameter]    range: "FILL IN: [lowest, highest]"

# Effects that the model may lack. Narrow their ranges to your knowledge; add your own below `effects:`
effectsFrom: <library|"FILL IN: a library, as identification/effects/hopper.yaml">
# withoutEffects: [effects that you have measured or excluded]
# commonErrors: errors common to all repeats, as that of a particle's diameter that was measured once

budget: { runs: 300 }
)yaml";

/// One item of the study's conditions.
inline constexpr const char* conditionTemplate = R"yaml(  - name: <name>
    role: <role>
    tags: { medium: <medium> }
    command: ./Allrun mesh filling <step>
[isSubmerged]    file: steps/submerged/postProcessing/massInHopper/*/massInHopper.dat
    set: { <entry>: <length|"FILL IN: m; or replace the entry by one that differs in this condition"> }   # m, from the name; or another entry that differs here
    measured:
      files:
<files>
)yaml";

} // namespace clepsydra::identification
