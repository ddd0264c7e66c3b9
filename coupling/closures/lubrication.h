/// \file
/// Normal squeeze of the fluid between two near spheres: leading term of lubrication theory, R. G. Cox, Int. J.
/// Multiphase Flow 1, 343 (1974); S. Kim & S. J. Karrila, Microhydrodynamics (1991), ch. 9. Between a sphere and a wall:
/// H. Brenner's factor f of its gap over R (1961; wallCorrection.h), as R. G. Cox & H. Brenner, Chem. Eng. Sci. 22, 1753
/// (1967), take it for a falling sphere, whose leading term is the same with R_eff = R.
///
///     F = c v_n,     c = 6 pi mu R_eff^2 (1/max(h, roughness) - 1/reach)      R_eff = R1 R2/(R1 + R2)
///     at a wall      c = 6 pi mu R (f(max(h, roughness)/R) - f(reach/R))      for 0 <= h < reach, else 0
///
/// h is the gap between the surfaces, v_n the speed of approach. The roughness is the gap at which the surfaces'
/// asperities touch: without it c has no bound and no contact ever happens (Davis, Serayssol & Hinch, J. Fluid Mech.
/// 163, 479 (1986); glass beads: 0.1..5 um). Beyond `reach` the drag law has all of the force; subtracting its value
/// there makes the force continuous. Tangential parts, which grow as ln(1/h) only, are left out.
///
/// In contact, h < 0, there is none: the asperities hold the film at one roughness, and it is the solids that give way.
/// A force that went on there would damp a bounce by as much as the contact is soft, and DEM's contacts are softened
/// (left out as well by E. Biegert, B. Vowinckel & E. Meiburg, J. Comput. Phys. 340, 105 (2017), eq. 21).
///
/// Range: gap Reynolds number rho v h/mu << 1, between spheres h << R. At a wall it is what a reach of many radii adds to
/// Stokes' drag in creeping flow; at larger Re the wake hides the wall from afar, and the reach is a few radii.
#pragma once

#include "closures/constants.h"
#include "closures/wallCorrection.h"

#include <algorithm>

namespace clepsydra::closures
{

/// R_eff of two spheres [m].
inline double effectiveRadius(double first, double second) noexcept
{
    return first * second / (first + second);
}

/// c [kg/s] \param dynamicViscosity  [Pa s] \param radius  R_eff [m] \param gap  h, negative in contact [m]
/// \param roughness, reach  [m], > 0; none with a roughness beyond the reach
inline double squeezeCoefficient(
    double dynamicViscosity, double radius, double gap, double roughness, double reach) noexcept
{
    const double film = std::max(gap, roughness);
    return gap < 0.0 || film >= reach ? 0.0
                                      : 6.0 * pi * dynamicViscosity * radius * radius * (1.0 / film - 1.0 / reach);
}

/// c [kg/s] at a wall. \param radius  of the sphere [m]; the others as above
inline double wallSqueezeCoefficient(
    double dynamicViscosity, double radius, double gap, double roughness, double reach) noexcept
{
    const double film = std::max(gap, roughness);
    return gap < 0.0 || film >= reach
               ? 0.0
               : 6.0 * pi * dynamicViscosity * radius
                     * (brennerPerpendicularFactor(film / radius) - brennerPerpendicularFactor(reach / radius));
}

} // namespace clepsydra::closures
