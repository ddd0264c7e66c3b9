/// \file
/// What every lift law receives, and the interface of a lift law.
///
/// A lift law is a stateless functor:
///
///     struct MyLift
///     {
///         static constexpr const char* name = "MyLiftForce";
///         static constexpr const char* line = "lift of what, in which range (source)";
///         static constexpr Rotation rotation = Rotation::ofFluid;
///         double operator()(const ParticleInRotation&) const noexcept;   // C >= 0 [kg]
///     };
///
/// The force is F = C (U_f - u_p) x w, where w is the rotation that the law refers to. C is finite at zero slip and at
/// zero rotation.
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

/// State of a particle and its fluid for a lift law. SI units; all values > 0 except slipSpeed and rotation >= 0.
struct ParticleInRotation
{
    double diameter;         // m
    double slipSpeed;        // |U_f - u_p|, interstitial, m/s
    double rotation;         // |w|, 1/s
    double density;          // of the fluid, kg/m3
    double dynamicViscosity; // Pa s
};

/// Reynolds number of the slip, rho |U_r| d/mu.
inline double slipReynolds(const ParticleInRotation& particle) noexcept
{
    return particle.density * particle.slipSpeed * particle.diameter / particle.dynamicViscosity;
}

/// Reynolds number of the rotation, rho |w| d^2/mu.
inline double rotationReynolds(const ParticleInRotation& particle) noexcept
{
    return particle.density * particle.rotation * particle.diameter * particle.diameter / particle.dynamicViscosity;
}

} // namespace clepsydra::closures
