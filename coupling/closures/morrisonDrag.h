/// \file
/// F. A. Morrison, "Data correlation for drag coefficient for sphere", Michigan Technological University (2013): the
/// correlation that the hopper paper cites for its Table I.
///
///     C_d = 24/Re + 2.6 (Re/5)/(1 + (Re/5)^1.52) + 0.411 x^-7.94/(1 + x^-8) + 0.25 y/(1 + y)
///     x = Re/2.63e5, y = Re/1e6, Re = rho |U_r| d/mu < 1e6 (through the drag crisis)
///     F = pi/8 C_d rho d^2 |U_r| U_r
///
/// The third term is written as x^0.06/(1 + x^8) here, which is the same and regular at zero slip. The law is for an
/// isolated particle and does not depend on the void fraction.
#pragma once

#include "closures/particleInFluid.h"

namespace clepsydra::closures
{

struct MorrisonDrag
{
    static constexpr const char* name = "MorrisonDrag";
    static constexpr const char* line = "drag of isolated particles, the hopper paper's C_d (Morrison 2013)";

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        const double reynolds = isolatedReynolds(particle);
        const double fifth = reynolds / 5.0;
        const double x = reynolds / 2.63e5;
        const double x2 = x * x;
        const double x8 = (x2 * x2) * (x2 * x2);
        const double y = reynolds / 1e6;
        const double inertial = 2.6 * fifth / (1.0 + std::exp(1.52 * logReynolds(fifth)))
                                + 0.411 * std::exp(0.06 * logReynolds(x)) / (1.0 + x8) + 0.25 * y / (1.0 + y);
        return stokesCoefficient(particle) * (1.0 + reynolds / 24.0 * inertial);
    }
};

} // namespace clepsydra::closures
