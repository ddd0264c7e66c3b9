/// \file
/// Y. Tang, E. A. J. F. Peters, J. A. M. Kuipers, S. H. L. Kriebitzsch & M. A. van der Hoef, AIChE J. 61, 688 (2015):
/// drag in static arrays of equal spheres, from resolved simulations with an immersed boundary. With phi = 1 - eps:
///
///     F = 10 phi/eps^2 + eps^2 (1 + 1.5 sqrt(phi)) + g(Re) Re
///     g = 0.11 phi (1 + phi) - 0.00456/eps^4 + (0.169 eps + 0.0644/eps^4) Re^-0.343
///     drag = 3 pi mu d eps U_r F,     Re = rho eps |U_r| d/mu
///
/// F is the drag of model A, as in beetstraDrag.h, whose law has the same creeping limit. Range of the simulations: Re
/// up to 1000, phi up to 0.6; monodisperse. Above Re = 1000 g keeps its value there, as in quadratic drag, because the
/// negative term would end in a negative drag.
#pragma once

#include "closures/beetstraDrag.h"

namespace clepsydra::closures
{

struct TangDrag
{
    static constexpr const char* name = "TangDrag";
    static constexpr const char* line = "drag of beds, Re to 1000 (Tang et al. 2015)";

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        constexpr double endOfFit = 1000.0;
        const double eps = particle.voidFraction;
        const double perEps4 = 1.0 / (eps * eps * eps * eps);
        const double phi = solidFraction(particle);
        const double reynolds = superficialReynolds(particle);

        const double inertial =
            0.11 * phi * (1.0 + phi) - 0.00456 * perEps4
            + (0.169 * eps + 0.0644 * perEps4) * std::exp(-0.343 * logReynolds(std::min(reynolds, endOfFit)));
        return stokesCoefficient(particle) * eps * (BeetstraDrag::creeping(particle) + inertial * reynolds);
    }
};

} // namespace clepsydra::closures
