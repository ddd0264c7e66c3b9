#pragma once

#include "engine/particles.h"

#include <string>

namespace LAMMPS_NS
{
class LAMMPS;
}

namespace clepsydra
{

/// What LIGGGHTS takes without a word, and what goes wrong later. Each throws a DemEngineError that names the particle, its place and
/// what is allowed.

/// "the box, (0 0 0) m to (1 1 1) m"
std::string boxText(const LAMMPS_NS::LAMMPS& program);

/// LIGGGHTS forgets particles outside the box.
void requireParticlesInBox(const LAMMPS_NS::LAMMPS& program);

/// Particles that start deep in each other fly apart as from an explosion.
void requireNoDeepOverlap(const LAMMPS_NS::LAMMPS& program, const ParticlePairs& pairs);

/// Where all else but the fluid has given a particle a force (or a place) that is no number.
void requireFiniteForces(const LAMMPS_NS::LAMMPS& program);

/// None of the materials' frictions is negative.
void requireNoNegativeFriction(const LAMMPS_NS::LAMMPS& program);

} // namespace clepsydra
