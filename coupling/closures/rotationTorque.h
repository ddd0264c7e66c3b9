/// \file
/// Torque of a fluid at rest on a rotating sphere, T = -K w with w = omega_p - curl U/2, the rotation relative to the
/// fluid that the Magnus lift refers to as well, and Re_r = rho |w| d^2/mu.
///
/// S. C. R. Dennis, S. N. Singh & D. B. Ingham, J. Fluid Mech. 101, 257 (1980), write the torque with the radius a:
///
///     T = C_M/2 rho a^5 w^2,     Re_a = rho |w| a^2/mu = Re_r/4
///     C_M = 16 pi/Re_a in creeping flow,     C_M = 6.45/sqrt(Re_a) + 32.1/Re_a for 20 < Re_a < 1000
///
/// Written with the diameter, which is how handbooks print it (e.g. C. Crowe, M. Sommerfeld & Y. Tsuji, Multiphase
/// Flows with Droplets and Particles, 1998), the same formula is C_M = 64 pi/Re_r below Re_r = 32 and 12.9/sqrt(Re_r) +
/// 128.4/Re_r above. The fit to the simulations is thereby extended to the crossing of the two parts, which is at Re_r
/// = 31.73; the larger one is taken here, so that the torque is continuous. Range: Re_r up to 4000, an isolated sphere
/// without slip.
///
/// In units of the torque in creeping flow, pi mu d^3 |w|:
///
///     K = pi mu d^3 max(1, (6.45 sqrt(Re_a) + 32.1)/(16 pi))
#pragma once

#include "closures/liftOnParticle.h"

namespace clepsydra::closures
{

/// K [N m s]; finite without rotation. The slip is not used.
inline double rotationTorqueCoefficient(const ParticleInRotation& particle) noexcept
{
    const double reynoldsOfRadius = 0.25 * rotationReynolds(particle);
    const double fitted = (6.45 * std::sqrt(reynoldsOfRadius) + 32.1) / (16.0 * pi);
    const double creeping = pi * particle.dynamicViscosity * particle.diameter * particle.diameter * particle.diameter;
    return creeping * std::max(1.0, fitted);
}

} // namespace clepsydra::closures
