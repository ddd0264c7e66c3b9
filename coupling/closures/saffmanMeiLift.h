/// \file
/// Lift by shear: P. G. Saffman, J. Fluid Mech. 22, 385 (1965) and 31, 624 (1968); beyond creeping flow R. Mei, Int. J.
/// Multiphase Flow 18, 145 (1992).
///
///     F = 1.615 rho d^3 Re_s^-1/2 f U_r x curl U,     Re_s = rho |curl U| d^2/mu,     Re = rho |U_r| d/mu
///     f = (1 - a) exp(-Re/10) + a,  a = 0.3314 sqrt(Re_s/(2 Re))    Re <= 40
///     f = 0.0524 sqrt(Re_s/2)                                       Re >  40
///
/// Range: isolated particle in linear shear, 0.005 < Re_s/(2 Re) < 0.4, Re up to 100. As published, f drops by 0.018 at
/// Re = 40 (17 % of it at Re_s/(2 Re) = 0.1). Not valid near a wall or in a bed.
#pragma once

#include "closures/liftOnParticle.h"

namespace clepsydra::closures
{

struct SaffmanMeiLift
{
    static constexpr const char* name = "SaffmanLiftForce";
    static constexpr const char* line = "lift in sheared fluid, Re to 100 (Saffman 1965, Mei 1992)";
    static constexpr Rotation rotation = Rotation::ofFluid;

    double operator()(const ParticleInRotation& particle) const noexcept
    {
        // The lower bound is so small that the force is below rounding there.
        constexpr double smallest = 1e-30;
        const double shear = std::max(rotationReynolds(particle), smallest);
        return 1.615 * particle.density * particle.diameter * particle.diameter * particle.diameter / std::sqrt(shear)
               * meiFactor(slipReynolds(particle), shear);
    }

    /// f of the equations above.
    static double meiFactor(double reynolds, double shearReynolds) noexcept
    {
        if (reynolds > 40.0)
        {
            return 0.0524 * std::sqrt(0.5 * shearReynolds);
        }
        const double decay = std::exp(-0.1 * reynolds);
        const double a = reynolds > 0.0 ? 0.3314 * std::sqrt(0.5 * shearReynolds / reynolds) : 0.0;
        return decay + a * (1.0 - decay);
    }
};

} // namespace clepsydra::closures
