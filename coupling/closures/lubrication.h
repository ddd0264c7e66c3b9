/// \file
/// Lubrication force in the normal direction. Between two spheres it is the leading term of lubrication theory: R. G.
/// Cox, Int. J. Multiphase Flow 1, 343 (1974); S. Kim & S. J. Karrila, Microhydrodynamics (1991), ch. 9. Between a
/// sphere and a wall it is H. Brenner's factor f of gap/R (1961; see wallCorrection.h), as R. G. Cox & H. Brenner,
/// Chem. Eng. Sci. 22, 1753 (1967), apply it to a falling sphere; its leading term is the same with R_eff = R.
///
///     F = c v_n,     c = 6 pi mu R_eff^2 (1/max(h, roughness) - 1/reach)      R_eff = R1 R2/(R1 + R2)
///     at a wall      c = 6 pi mu R (f(max(h, roughness)/R) - f(reach/R))      for 0 <= h < reach, else 0
///
/// h is the gap between the surfaces, v_n the speed of approach. The roughness is the gap at which asperities of the
/// surfaces touch. Without it c is unbounded and the surfaces never touch (Davis, Serayssol & Hinch, J. Fluid Mech.
/// 163, 479 (1986); glass beads: 0.1..5 um). Beyond `reach` the drag law contains the whole force; subtracting the
/// value at `reach` makes the force continuous. Tangential terms grow only as ln(1/h) and are left out.
///
/// In contact, h < 0, the force is zero: the asperities keep the film at the thickness of the roughness, and the solids
/// deform. A force that continued there would damp a bounce in proportion to the softness of the contact, and DEM
/// contacts are softened. E. Biegert, B. Vowinckel & E. Meiburg, J. Comput. Phys. 340, 105 (2017), eq. 21, leave it out
/// as well.
///
/// Range: gap Reynolds number rho v h/mu << 1; between spheres h << R. At a wall, a reach of many radii gives the
/// correction of Stokes' drag in creeping flow; at larger Re the wake shields the particle from distant walls, and the
/// reach is a few radii.
#pragma once

#include "closures/constants.h"
#include "closures/wallCorrection.h"

#include <algorithm>

namespace clepsydra::closures
{

/// Effective radius R_eff of two spheres [m].
inline double effectiveRadius(double first, double second) noexcept
{
    return first * second / (first + second);
}

/// c [kg/s].
/// \param dynamicViscosity  [Pa s]
/// \param radius  R_eff [m]
/// \param gap  h, negative in contact [m]
/// \param roughness, reach  [m], > 0; c is zero where the roughness exceeds the reach
inline double squeezeCoefficient(
    double dynamicViscosity, double radius, double gap, double roughness, double reach) noexcept
{
    const double film = std::max(gap, roughness);
    return gap < 0.0 || film >= reach ? 0.0
                                      : 6.0 * pi * dynamicViscosity * radius * radius * (1.0 / film - 1.0 / reach);
}

/// c at a wall [kg/s].
/// \param radius  of the sphere [m]; the other parameters as above
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
