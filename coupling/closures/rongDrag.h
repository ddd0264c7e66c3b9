/// \file
/// L. W. Rong, K. J. Dong & A. B. Yu, Chem. Eng. Sci. 99, 44 (2013): drag in packed beds of uniform spheres, from
/// lattice-Boltzmann simulations.
///
///     F   = 1/8 C_d rho pi d^2 eps^2 |U_r| U_r eps^-beta,     Re = rho eps |U_r| d/mu
///     C_d = (0.63 + 4.8/sqrt(Re))^2
///     beta = 2.65 (eps + 1) - (5.3 - 3.5 eps) eps^2 exp(-(1.5 - log10 Re)^2/2)
///
/// The law has the form of Di Felice's law and is likewise taken as model A's drag: at eps = 0.4 it is then within 8 %
/// of Ergun's equation for Re up to 1000, whereas read as a total force (model B's) it would be 60 % below. Other
/// public codes do the same.
///
/// Range: eps = 0.37..1, Re up to 3000; monodisperse.
#pragma once

#include "closures/diFeliceDrag.h"

namespace clepsydra::closures
{

struct RongDrag
{
    static constexpr const char* name = "RongDrag";
    static constexpr const char* line = "drag of beds, Re to 3000 (Rong et al. 2013)";

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        const double eps = particle.voidFraction;
        const double reynolds = superficialReynolds(particle);
        const double beta = 2.65 * (eps + 1.0) - (5.3 - 3.5 * eps) * eps * eps * transitionBump(reynolds);
        return stokesCoefficient(particle) * dallavalleFactor(reynolds) * powerOfVoidFraction(particle, 1.0 - beta);
    }
};

} // namespace clepsydra::closures
