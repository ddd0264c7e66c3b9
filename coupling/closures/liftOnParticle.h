/// \file
/// What every lift law is given.
///
/// Contract of a lift law: a stateless functor
///
///     struct MyLift
///     {
///         static constexpr const char* name = "MyLiftForce";
///         static constexpr const char* line = "lift of what, in which range (source)";
///         static constexpr Rotation rotation = Rotation::ofFluid;
///         double operator()(const ParticleInRotation&) const noexcept;   // C >= 0 [kg]
///     };
///
/// with the force F = C (U_f - u_p) x w, w being the rotation that the law speaks of. At rest, or where nothing
/// rotates, C is finite.
#pragma once

#include "closures/constants.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::closures
{

enum class Rotation
{
    ofFluid,               // w = curl U
    ofParticleAgainstFluid // w = omega_p - curl U/2
};

/// SI units. Expected: all > 0, but slipSpeed and rotation >= 0.
struct ParticleInRotation
{
    double diameter;         // m
    double slipSpeed;        // |U_f - u_p|, interstitial, m/s
    double rotation;         // |w|, 1/s
    double density;          // of the fluid, kg/m3
    double dynamicViscosity; // Pa s
};

/// rho |U_r| d/mu
inline double slipReynolds(const ParticleInRotation& particle) noexcept
{
    return particle.density * particle.slipSpeed * particle.diameter / particle.dynamicViscosity;
}

/// rho |w| d^2/mu
inline double rotationReynolds(const ParticleInRotation& particle) noexcept
{
    return particle.density * particle.rotation * particle.diameter * particle.diameter / particle.dynamicViscosity;
}

} // namespace clepsydra::closures
