/// \file
/// Torque of a fluid on a sphere that rotates relative to it. w = curl U/2 - omega_p is the rotation of the fluid
/// relative to the particle; Re_r = rho |w| d^2/mu.
///
/// Creeping flow, exact for Re_r -> 0 (G. Kirchhoff 1876, in H. Lamb, Hydrodynamics, 6th ed. 1932, art. 334):
///
///     T = pi mu d^3 w = 8 pi mu R^3 w
///
/// S. C. R. Dennis, S. N. Singh & D. B. Ingham, J. Fluid Mech. 101, 257 (1980), a fit to their computed steady flows
/// around a sphere that rotates alone in fluid at rest:
///
///     T = 1/2 rho R^5 C |w| w,     C = 12.9 Re_r^-1/2 + 128.4 Re_r^-1     80 < Re_r < 4000
///                                  C = 64 pi Re_r^-1                       creeping flow
///
/// In terms of rho |w| R^2/mu, the Reynolds number of the paper, C is 6.45 Re^-1/2 + 32.1 Re^-1 from 20 to 1000, and
/// 16 pi/Re. The larger of the two is taken; they meet at Re_r = 31.7, so that the torque has no jump. There it is 5 %
/// too small: the next term of the expansion in creeping flow is a factor 1 + Re_r^2/19200 (Bickley 1938).
///
/// Range: isolated sphere without slip, steady. A torque that changes within R^2/nu (1 s for 2 mm in water) is larger,
/// because the rotating layer around the sphere is still thin.
///
/// A torque law is a stateless functor:
///
///     struct MyTorque
///     {
///         static constexpr const char* name = "MyTorque";
///         static constexpr const char* line = "torque in which range (source)";
///         double operator()(const ParticleInRotation&) const noexcept;   // C_t >= 0 [N m s]
///     };
///
/// The torque on the particle is T = C_t w. C_t is finite without rotation.
#pragma once

#include "closures/liftOnParticle.h"

namespace clepsydra::closures
{

struct StokesTorque
{
    static constexpr const char* name = "StokesTorque";
    static constexpr const char* line = "torque on rotating particles, Re_r -> 0 (Kirchhoff 1876)";

    double operator()(const ParticleInRotation& particle) const noexcept
    {
        return pi * particle.dynamicViscosity * particle.diameter * particle.diameter * particle.diameter;
    }
};

struct DennisTorque
{
    static constexpr const char* name = "DennisTorque";
    static constexpr const char* line = "torque on rotating particles, Re_r to 4000 (Dennis, Singh & Ingham 1980)";

    double operator()(const ParticleInRotation& particle) const noexcept
    {
        const double ofFit = (12.9 * std::sqrt(rotationReynolds(particle)) + 128.4) / (64.0 * pi);
        return StokesTorque{}(particle)*std::max(1.0, ofFit);
    }
};

} // namespace clepsydra::closures
