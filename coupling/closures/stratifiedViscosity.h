/// \file
/// Viscosity of a liquid at rest that changes with height h: one liquid on another, and an even change besides.
///
///     ln(nu/nu_lower) = -step/2 erfc((height - h)/(sqrt 2 width)) + gradient (h - height)
///
/// Two liquids that mix by diffusion have such an edge, of standard deviation width = sqrt(2 D t): J. Crank, The
/// Mathematics of Diffusion (1975), eq. 2.14. Here it is one of ln nu, which is nearly linear in the share of one liquid
/// in the other (S. Arrhenius, Z. Phys. Chem. 1, 285 (1887)). nu_lower is the lower liquid's, at the edge's height.
///
/// A sphere that sinks through the edge carries liquid from above along: M. Manga & H. A. Stone, J. Fluid Mech. 287, 279
/// (1995). In place of that flow it is taken to feel, at h, the liquid at h + lag d.
///
/// Range: densities that differ by much less than that of the particle and the liquid; an edge that stays where it is.
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

    /// nu/nu_lower [-]. \param diameter  of the particle that feels it; 0: of the liquid as it lies
    double factor(double h, double diameter) const noexcept
    {
        const double above = h + lag * diameter - height;
        return std::exp(gradient * above - 0.5 * step * std::erfc(-above / (std::sqrt(2.0) * width)));
    }
};

} // namespace clepsydra::closures
