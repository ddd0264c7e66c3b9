/// \file
/// Viscosity of a liquid at rest as a function of the height h: one liquid above another, and a uniform gradient of ln
/// nu.
///
///     ln(nu/nu_lower) = -step/2 erfc((height - h)/(sqrt 2 width)) + gradient (h - height)
///
/// Two liquids that mix by diffusion have an edge of this form with the standard deviation width = sqrt(2 D t): J.
/// Crank, The Mathematics of Diffusion (1975), eq. 2.14. Here the profile is one of ln nu, which is nearly linear in
/// the fraction of one liquid in the other (S. Arrhenius, Z. Phys. Chem. 1, 285 (1887)). nu_lower is the viscosity of
/// the lower liquid at the height of the edge.
///
/// A sphere that sinks through the edge entrains liquid from above: M. Manga & H. A. Stone, J. Fluid Mech. 287, 279
/// (1995). In place of that flow, a sphere at h has the viscosity of the liquid at h + lag d.
///
/// Range: the liquids' densities differ by much less than those of the particle and the liquid, and the edge does not
/// move.
#pragma once

#include <cmath>

namespace clepsydra::closures
{

struct Stratification
{
    double step = 0;     // ln of the lower liquid's viscosity over the upper one's
    double height = 0;   // of the edge's middle, m
    double width = 1;    // of the edge, m, > 0
    double lag = 0;      // in diameters of the particle
    double gradient = 0; // d(ln nu)/dh beside the step, 1/m

    bool isThere() const noexcept
    {
        return step != 0 || gradient != 0;
    }

    /// nu/nu_lower [-]. \param diameter  of the particle on which the liquid acts [m]; 0 for the liquid itself
    double factor(double h, double diameter) const noexcept
    {
        const double above = h + lag * diameter - height;
        return std::exp(gradient * above - 0.5 * step * std::erfc(-above / (std::sqrt(2.0) * width)));
    }
};

} // namespace clepsydra::closures
