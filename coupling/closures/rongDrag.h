/// \file
/// L. W. Rong, K. J. Dong & A. B. Yu, Chem. Eng. Sci. 99, 44 (2013): lattice-Boltzmann flow through packed beds of
/// uniform spheres.
///
///     F   = 1/8 C_d rho pi d^2 eps^2 |U_r| U_r eps^-beta,     Re = rho eps |U_r| d/mu
///     C_d = (0.63 + 4.8/sqrt(Re))^2
///     beta = 2.65 (eps + 1) - (5.3 - 3.5 eps) eps^2 exp(-(1.5 - log10 Re)^2/2)
///
/// Built as Di Felice's law, and like it taken as model A's drag: at eps = 0.4 it then lies within 8 % of Ergun's
/// equation for Re up to 1000; read as a total force (model B's) it would lie 60 % below. Public codes do the same.
///
/// Range: eps 0.37..1, Re up to 3000. Monodisperse.
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
