/// \file
/// R. Di Felice, Int. J. Multiphase Flow 20, 153 (1994), with Dallavalle's (1948) drag of an isolated particle, in the
/// form of Zhu, Zhou, Yang & Yu, Chem. Eng. Sci. 62, 3378 (2007) and Zhou et al., J. Fluid Mech. 661 (2010).
///
///     F   = 1/8 C_d rho pi d^2 eps^2 |U_r| U_r eps^-chi,     Re = rho eps |U_r| d/mu
///     C_d = (0.63 + 4.8/sqrt(Re))^2,     chi = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2/2)
///
/// The law is published per particle and used as model A's drag, so nothing is converted. With C_d Re = (0.63 sqrt(Re)
/// + 4.8)^2 it becomes Sp = pi/8 mu d eps^(1 - chi) (0.63 sqrt(Re) + 4.8)^2, which is regular at zero slip.
///
/// Range: fixed and fluidised beds and isolated particles, Re up to 1e4. For an isolated particle in creeping flow it
/// gives 0.96 of Stokes' drag. At Re = 37..530 Dallavalle's C_d is 13..27 % above Brown & Lawler's, so with it the
/// particles of the hopper paper settle 8..13 % too slowly.
#pragma once

#include "closures/particleInFluid.h"

namespace clepsydra::closures
{

/// C_d Re/24 of an isolated particle, after Dallavalle.
inline double dallavalleFactor(double reynolds) noexcept
{
    const double root = 0.63 * std::sqrt(reynolds) + 4.8;
    return root * root / 24.0;
}

/// exp(-(1.5 - log10 Re)^2/2): the term around Re = 30 in the exponents of Di Felice and of Rong. It vanishes at zero
/// slip.
inline double transitionBump(double reynolds) noexcept
{
    constexpr double logOf10 = 2.302585092994045684;
    const double distance = 1.5 - logReynolds(reynolds) / logOf10;
    return std::exp(-0.5 * distance * distance);
}

struct DiFeliceDrag
{
    static constexpr const char* name = "DiFeliceDrag";
    static constexpr const char* line = "drag from beds to isolated particles, Re to 1e4 (Di Felice 1994)";

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        const double reynolds = superficialReynolds(particle);
        const double chi = 3.7 - 0.65 * transitionBump(reynolds);
        return stokesCoefficient(particle) * dallavalleFactor(reynolds) * powerOfVoidFraction(particle, 1.0 - chi);
    }
};

} // namespace clepsydra::closures
