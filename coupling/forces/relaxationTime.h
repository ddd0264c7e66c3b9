#pragma once

#include "closures/parcelScaling.h"
#include "closures/schillerNaumannDrag.h"
#include "closures/timeScales.h"
#include "forces/fluidProperties.h"

namespace clepsydra
{

/// Time in which an isolated particle reaches the velocity of the fluid, by Schiller & Naumann's drag [s]. That of a
/// parcel is that of each of its particles.
/// \param slip  speed of the fluid relative to the particle [m/s]
/// \param coarseGraining  see forces/coarseGraining.h
inline double isolatedRelaxationTime(const ParticlesView& particles, Eigen::Index particle, double slip,
    const FluidProperties& fluid, double coarseGraining)
{
    const double diameter = 2 * particles.radius[particle] / coarseGraining;
    const auto inFluid = closures::makeParticleInFluid(
        diameter, 1.0, slip, fluid.density, fluid.viscosityAt(particles.position.col(particle), diameter));
    return closures::relaxationTime(
        particles.mass[particle], closures::parcelDrag(closures::SchillerNaumannDrag{}, inFluid, coarseGraining));
}

} // namespace clepsydra
