/// \file
/// L. Schiller & A. Naumann, Z. Ver. Dtsch. Ing. 77, 318 (1933): drag of an isolated particle.
///
///     C_d = 24/Re (1 + 0.15 Re^0.687)   Re < 1000,      C_d = 0.44   above (Newton's regime)
///     F   = pi/8 C_d rho d^2 |U_r| U_r,                 Re = rho |U_r| d/mu
///
/// Switching AT Re = 1000 would make C_d jump from 0.4383 to 0.44. As in most codes, C_d is the larger of the two here.
/// They cross at Re = 988.95, so the drag is continuous and C_d = 0.44 above that. Accuracy: about 5 % below the
/// crossing; valid up to the drag crisis near Re = 2e5. The law does not depend on the void fraction, so it is valid
/// for dilute suspensions only.
#pragma once

#include "closures/particleInFluid.h"

namespace clepsydra::closures
{

/// C_d Re/24 of an isolated particle: its drag in units of Stokes' drag.
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
