/// \file
/// Lift by rotation (Magnus). w = omega_p - curl U/2 is the particle's rotation relative to the fluid; Re_r = rho |w|
/// d^2/mu.
///
/// S. I. Rubinow & J. B. Keller, J. Fluid Mech. 11, 447 (1961), exact for Re, Re_r -> 0:
///
///     F = pi/8 rho d^3 U_r x w
///
/// B. Oesterle & T. Bui Dinh, Exp. Fluids 25, 16 (1998), measured at 10 < Re < 140 and 1 < Re_r/Re < 6; the limit for
/// small Re is Rubinow & Keller's lift:
///
///     F = pi/8 rho d^2 C |U_r| U_r x w/|w|,     C = 0.45 + (Re_r/Re - 0.45) exp(-0.05684 Re_r^0.4 Re^0.3)
///
/// At Re = 100 and Re_r = 200 Rubinow & Keller's lift is 2.9 times as large.
#pragma once

#include "closures/liftOnParticle.h"

namespace clepsydra::closures
{

struct RubinowKellerLift
{
    static constexpr const char* name = "MagnusLiftForce";
    static constexpr const char* line = "lift of rotating particles, Re -> 0 (Rubinow & Keller 1961)";
    static constexpr Rotation rotation = Rotation::ofParticleAgainstFluid;

    double operator()(const ParticleInRotation& particle) const noexcept
    {
        return pi / 8.0 * particle.density * particle.diameter * particle.diameter * particle.diameter;
    }
};

struct OesterleBuiDinhLift
{
    static constexpr const char* name = "MagnusLiftForceOesterle";
    static constexpr const char* line = "lift of rotating particles, Re to 140 (Oesterle & Bui Dinh 1998)";
    static constexpr Rotation rotation = Rotation::ofParticleAgainstFluid;

    double operator()(const ParticleInRotation& particle) const noexcept
    {
        constexpr double slowest = 1e-30; // 1/s: no rotation, no force
        const double turning = std::max(particle.rotation, slowest);
        const double decay =
            std::exp(-0.05684 * std::pow(rotationReynolds(particle), 0.4) * std::pow(slipReynolds(particle), 0.3));
        // C |U_r|/(d |w|), which is regular at U_r = 0.
        const double part = decay + 0.45 * (1.0 - decay) * particle.slipSpeed / (particle.diameter * turning);
        return RubinowKellerLift{}(particle)*part;
    }
};

} // namespace clepsydra::closures
