#pragma once

#include "engine/particles.h"

#include <string>
#include <vector>

namespace LAMMPS_NS
{
class LAMMPS;
}

namespace clepsydra
{

/// Checks of input that LIGGGHTS accepts without a message and that fails later. Each throws a DemEngineError that
/// names the particle, its position and what is allowed.

/// Text for messages: "the box, (0 0 0) m to (1 1 1) m".
std::string boxText(const LAMMPS_NS::LAMMPS& program);

/// Text for messages where no particle is left on a rank: which one left the box last, where and how fast.
std::string lastParticleText(const LAMMPS_NS::LAMMPS& program);

/// All particles are in the box. LIGGGHTS drops particles outside it.
void requireParticlesInBox(const LAMMPS_NS::LAMMPS& program);

/// No particles overlap deeply at the start or where one is inserted, because their contact force would throw them
/// apart.
/// \param isExamined  for each own particle, whether its pairs are examined; empty for all
void requireNoDeepOverlap(
    const LAMMPS_NS::LAMMPS& program, const ParticlePairs& pairs, const std::vector<bool>& isExamined = {});

/// All positions and all forces except the fluid's are finite numbers.
void requireFiniteForces(const LAMMPS_NS::LAMMPS& program);

/// No friction coefficient of the materials is negative.
void requireNoNegativeFriction(const LAMMPS_NS::LAMMPS& program);

} // namespace clepsydra
