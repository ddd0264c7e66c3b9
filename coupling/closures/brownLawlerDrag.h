/// \file
/// P. P. Brown & D. F. Lawler, J. Environ. Eng. 129, 222 (2003): drag of isolated spheres, fitted to 480 measured
/// points that were corrected for the walls of the vessels.
///
///     C_d = 24/Re (1 + 0.150 Re^0.681) + 0.407/(1 + 8710/Re),      Re = rho |U_r| d/mu < 2e5
///     F   = pi/8 C_d rho d^2 |U_r| U_r
///
/// The tests compare the other laws with this one at eps = 1. It does not depend on the void fraction, so it is valid
/// for dilute suspensions only.
#pragma once

#include "closures/particleInFluid.h"

namespace clepsydra::closures
{

struct BrownLawlerDrag
{
    static constexpr const char* name = "BrownLawlerDrag";
    static constexpr const char* line = "drag of isolated particles, fitted to measurements (Brown & Lawler 2003)";

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        const double reynolds = isolatedReynolds(particle);
        const double factor = 1.0 + 0.150 * std::exp(0.681 * logReynolds(reynolds))
                              + 0.407 / 24.0 * reynolds * reynolds / (reynolds + 8710.0);
        return stokesCoefficient(particle) * factor;
    }
};

} // namespace clepsydra::closures
