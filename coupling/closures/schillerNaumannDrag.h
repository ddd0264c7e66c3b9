/// \file
/// L. Schiller & A. Naumann, Z. Ver. Dtsch. Ing. 77, 318 (1933): the isolated particle.
///
///     C_d = 24/Re (1 + 0.15 Re^0.687)   Re < 1000,      C_d = 0.44   above (Newton's regime)
///     F   = pi/8 C_d rho d^2 |U_r| U_r,                 Re = rho |U_r| d/mu
///
/// A switch AT Re = 1000 jumps from 0.4383 to 0.44. Here C_d is the larger of the two, as in most codes: they cross
/// at Re = 988.95, so the drag is continuous and 0.44 holds from there. Good to about 5 % below that, and up to the
/// drag crisis near Re = 2e5. The void fraction plays no part: dilute only.
#pragma once

#include "closures/particleInFluid.h"

namespace clepsydra::closures
{

/// C_d Re/24 of an isolated particle: drag in units of Stokes' drag.
inline double schillerNaumannFactor(double reynolds) noexcept
{
    return std::max(1.0 + 0.15 * std::exp(0.687 * logReynolds(reynolds)), 0.44 / 24.0 * reynolds);
}

struct SchillerNaumannDrag
{
    static constexpr const char* name = "SchillerNaumannDrag";
    static constexpr const char* line = "drag of isolated particles, Re to 2e5 (Schiller & Naumann 1933)";

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        return stokesCoefficient(particle) * schillerNaumannFactor(isolatedReynolds(particle));
    }
};

} // namespace clepsydra::closures
