/// \file
/// Mass flow rate of a silo or hopper through a circular orifice [kg/s]; 0 where the orifice is narrower than k d.
#pragma once

#include <algorithm>
#include <cmath>

namespace clepsydra::closures
{

/// Dry: W = C rho_bulk sqrt(g) (D - k d)^(5/2). W. A. Beverloo, H. A. Leniger & J. van de Velde, Chem. Eng. Sci. 15,
/// 260 (1961). rho_bulk = rho_p (1 - eps) is the bulk density of the FLOWING bed. C = 0.55..0.65 and k = 1..2 (1.4 for
/// spheres) are fitted. Range: D > 6 d approximately, and D_hopper > 2.5 D.
inline double beverlooRate(double bulkDensity, double gravity, double orificeDiameter, double particleDiameter,
    double c = 0.58, double k = 1.4) noexcept
{
    const double opening = std::max(orificeDiameter - k * particleDiameter, 0.0);
    return c * bulkDensity * std::sqrt(gravity) * opening * opening * std::sqrt(opening);
}

/// Submerged: W = C rho_p v_t d^2 (D/d - k)^2 with the particle's density rho_p and its terminal velocity v_t in the
/// fluid; C = 0.4, k = 2.4. T. J. Wilson, C. R. Pfeifer, N. Mesyngier & D. J. Durian, Papers in Physics 6, 060009
/// (2014).
inline double modifiedBeverlooRate(double particleDensity, double terminalVelocity, double orificeDiameter,
    double particleDiameter, double c = 0.4, double k = 2.4) noexcept
{
    const double opening = std::max(orificeDiameter - k * particleDiameter, 0.0);
    return c * particleDensity * terminalVelocity * opening * opening;
}

} // namespace clepsydra::closures
