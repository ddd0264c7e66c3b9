/// \file
/// Nusselt number h d/k [-] of the heat transfer between a particle and the fluid, or, with Schmidt's number in place
/// of Prandtl's, Sherwood number of the mass transfer.
///
/// W. E. Ranz & W. R. Marshall, Chem. Eng. Prog. 48, 141 and 173 (1952), measured on evaporating drops; Re up to 200:
///
///     Nu = 2 + 0.6 Re^(1/2) Pr^(1/3),     Re = rho |U_r| d/mu
///
/// D. J. Gunn, Int. J. Heat Mass Transfer 21, 467 (1978), beds and suspensions, eps from 0.35 to 1, Re up to 1e5:
///
///     Nu = (7 - 10 eps + 5 eps^2)(1 + 0.7 Re^0.2 Pr^(1/3)) + (1.33 - 2.40 eps + 1.20 eps^2) Re^0.7 Pr^(1/3)
///     Re = rho eps |U_r| d/mu
///
/// Without slip both are 2 for an isolated particle, which is the exact value of conduction into fluid at rest.
#pragma once

#include <cmath>

namespace clepsydra::closures
{

/// \param reynolds  with the interstitial slip, >= 0
/// \param prandtl  > 0
inline double ranzMarshallNusselt(double reynolds, double prandtl) noexcept
{
    return 2.0 + 0.6 * std::sqrt(reynolds) * std::cbrt(prandtl);
}

/// \param reynolds  with the superficial slip, >= 0
/// \param prandtl  > 0
/// \param voidFraction  in (0, 1]
inline double gunnNusselt(double reynolds, double prandtl, double voidFraction) noexcept
{
    const double eps = voidFraction;
    const double cubeRoot = std::cbrt(prandtl);
    return (7.0 + eps * (-10.0 + 5.0 * eps)) * (1.0 + 0.7 * std::pow(reynolds, 0.2) * cubeRoot)
           + (1.33 + eps * (-2.40 + 1.20 * eps)) * std::pow(reynolds, 0.7) * cubeRoot;
}

} // namespace clepsydra::closures
