/// \file
/// R. Beetstra, M. A. van der Hoef & J. A. M. Kuipers, AIChE J. 53, 489 (2007), eq. 16: drag in arrays of equal
/// spheres, from lattice-Boltzmann simulations. With phi = 1 - eps:
///
///     F = 10 phi/eps^2 + eps^2 (1 + 1.5 sqrt(phi))
///         + 0.413 Re/(24 eps^2) [1/eps + 3 phi eps + 8.4 Re^-0.343]/[1 + 10^(3 phi) Re^-(1 + 4 phi)/2]
///     drag = 3 pi mu d eps U_r F,     Re = rho eps |U_r| d/mu
///
/// F is the drag without the pressure gradient's share, which is the drag of model A: at Re = 0 and large phi it gives
/// Carman's pressure drop. Range of the simulations: Re up to 1000, phi from 0.1 to 0.6. At eps = 1 and Re = 100 the
/// drag is 16 % above Schiller & Naumann's drag of an isolated particle. This is the monodisperse form; the paper's
/// correction for mixtures of sizes is in polydisperseDrag.h.
#pragma once

#include "closures/particleInFluid.h"

namespace clepsydra::closures
{

struct BeetstraDrag
{
    static constexpr const char* name = "BeetstraDrag";
    static constexpr const char* line = "drag of beds, Re to 1000 (Beetstra et al. 2007)";

    /// F at Re = 0: Carman's pressure drop at large phi, Stokes' drag at phi = 0.
    static double creeping(const ParticleInFluid& particle) noexcept
    {
        const double eps2 = particle.voidFraction * particle.voidFraction;
        const double phi = solidFraction(particle);
        return 10.0 * phi / eps2 + eps2 * (1.0 + 1.5 * std::sqrt(phi));
    }

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        constexpr double logOf10 = 2.302585092994045684;
        const double eps = particle.voidFraction;
        const double phi = solidFraction(particle);
        const double reynolds = superficialReynolds(particle);
        const double logRe = logReynolds(reynolds);

        const double inertial = 0.413 * reynolds / (24.0 * eps * eps)
                                * (1.0 / eps + 3.0 * phi * eps + 8.4 * std::exp(-0.343 * logRe))
                                / (1.0 + std::exp(3.0 * phi * logOf10 - 0.5 * (1.0 + 4.0 * phi) * logRe));
        return stokesCoefficient(particle) * eps * (creeping(particle) + inertial);
    }
};

} // namespace clepsydra::closures
