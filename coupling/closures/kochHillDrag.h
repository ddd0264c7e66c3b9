/// \file
/// R. J. Hill, D. L. Koch & A. J. C. Ladd, J. Fluid Mech. 448, 213 and 243 (2001); D. L. Koch & R. J. Hill, Annu. Rev.
/// Fluid Mech. 33, 619 (2001): drag in arrays of spheres, from lattice-Boltzmann simulations. With phi = 1 - eps:
///
///     beta = 18 mu eps^2 phi/d^2 [F0 + F3 Re/2],     Sp = beta V_p/phi,     Re = rho eps |U_r| d/mu
///     F0 = (1 + 3 sqrt(phi/2) + 135/64 phi ln(phi) + 16.14 phi)/(1 + 0.681 phi - 8.48 phi^2 + 8.14 phi^3), phi < 0.4
///     F0 = 10 phi/eps^3                                                                                    otherwise
///     F3 = 0.0673 + 0.212 phi + 0.0232/eps^5
///
/// The paper defines Re with the radius, hence the factor 1/2 with the diameter (van Buijtenen et al., Chem. Eng. Sci.
/// 66, 2368 (2011)). F is the total force of the fluid; the factor eps removes the pressure gradient's share, so this
/// beta is model A's. At Re = 0 and phi > 0.4 it gives Carman's pressure drop, 180 mu phi^2 U/(eps^3 d^2).
///
/// THE COEFFICIENT 8.14 IS ALSO PRINTED AS 8.16, which CFDEMcoupling has. With 8.14 the two branches of F0 meet better
/// (18.381 against 18.519, -0.74 %; 18.328 with 8.16, -1.03 %), so it is used here. The remaining jump at phi = 0.4 is
/// the law's own. CFDEMcoupling also evaluates "135/64" as an integer division, 2 instead of 2.109, which matters in
/// comparisons.
///
/// Range: Re up to about 100, phi up to 0.64; monodisperse. At eps = 1 the drag is Stokes' drag times (1 + 0.045 Re),
/// linear in Re, so the law is not valid for an isolated particle above Re of about 100.
#pragma once

#include "closures/particleInFluid.h"

namespace clepsydra::closures
{

struct KochHillDrag
{
    static constexpr const char* name = "KochHillDrag";
    static constexpr const char* line = "drag of beds, Re to about 100 (Hill, Koch & Ladd 2001)";
    static constexpr double switchingSolidFraction = 0.4;

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        const double eps = particle.voidFraction;
        const double eps2 = eps * eps;
        const double f3 = 0.0673 + 0.212 * (1.0 - eps) + 0.0232 / (eps2 * eps2 * eps);
        return stokesCoefficient(particle) * eps2 * (creeping(particle) + 0.5 * f3 * superficialReynolds(particle));
    }

    /// F0, the part that does not depend on Re.
    static double creeping(const ParticleInFluid& particle) noexcept
    {
        const double phi = solidFraction(particle);
        if (phi < switchingSolidFraction)
        {
            return (1.0 + 3.0 * std::sqrt(0.5 * phi) + 135.0 / 64.0 * phi * std::log(phi) + 16.14 * phi)
                   / (1.0 + phi * (0.681 + phi * (-8.48 + phi * 8.14)));
        }
        const double eps = particle.voidFraction;
        return 10.0 * phi / (eps * eps * eps);
    }
};

} // namespace clepsydra::closures
