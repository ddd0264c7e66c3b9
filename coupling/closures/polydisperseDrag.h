/// \file
/// Drag on one particle among particles of other sizes, from a drag law for equal spheres.
///
/// The drag law is evaluated for a bed of equal spheres that have the same void fraction and the local Sauter mean
/// diameter <d> = sum n d^3/sum n d^2. A polydispersity law turns the result f = Sp/(3 pi mu <d>) into the drag of the
/// particle of diameter d:
///
///     Sp = 3 pi mu d g(y, eps, f),     y = d/<d>
///
/// A polydispersity law is a stateless functor like a drag law, with name, line and
///
///     double operator()(double y, double voidFraction, double f) const noexcept;     // g
///
/// ALL LAWS HERE ARE WRITTEN FOR MODEL A, whose drag does not include the force -V_p grad p of the pressure gradient.
///
/// M. A. van der Hoef, R. Beetstra & J. A. M. Kuipers, J. Fluid Mech. 528, 233 (2005), for creeping flow, and R.
/// Beetstra, M. A. van der Hoef & J. A. M. Kuipers, AIChE J. 53, 489 (2007), with the erratum on p. 3020, for Re up to
/// 1000: lattice-Boltzmann simulations of bidisperse arrays with phi from 0.1 to 0.6 and diameter ratios up to 4. The
/// papers give the TOTAL force, with the pressure gradient, in units of 3 pi mu d eps U_r:
///
///     F_i = [eps y + (1 - eps) y^2 + 0.064 eps y^3] F(<d>, eps),     F(<d>, eps) = f/eps^2
///
/// The share (1 - eps) y^2 is the force of the pressure gradient, which is proportional to the particle's volume. Model
/// A adds it separately, so that g = (y + 0.064 y^3) f remains for the drag. Public codes of model A use it with the
/// cubic term of the fit and without:
///
///     Beetstra        g = y f                    f in a bed of equal spheres; the drag of all particles together is
///                                                that of equal spheres of diameter <d>
///     BeetstraCubic   g = (y + 0.064 y^3) f      as fitted, which matters for large particles among small ones; in a
///                                                bed of equal spheres it is 6.4 % above the drag law
///
/// X. Yin & S. Sundaresan, AIChE J. 55, 1352 (2009), from simulations of creeping flow; W. Holloway, X. Yin & S.
/// Sundaresan, AIChE J. 56, 1995 (2010), use it at finite Re. phi from 0.2 to 0.4:
///
///     F_i = 1/eps + (F - 1/eps) [a y + (1 - a) y^2],     a = 1 - 2.660 phi + 9.096 phi^2 - 11.338 phi^3
///
/// with F = f/eps, which is without the pressure gradient, hence g = 1 + (f - 1)[a y + (1 - a) y^2]. A particle that is
/// small compared with the others has Stokes' drag, and a bed of equal spheres the drag law's. The papers' drag between
/// particles of different size that move relative to each other is not included.
#pragma once

#include "closures/particleInFluid.h"

#include <string>
#include <tuple>
#include <vector>

namespace clepsydra::closures
{

struct BeetstraPolydispersity
{
    static constexpr const char* name = "Beetstra";
    static constexpr const char* line = "mixtures: factor y = d/<d>, 1 for equal spheres (Beetstra et al. 2007)";

    double operator()(double y, double /*voidFraction*/, double f) const noexcept
    {
        return y * f;
    }
};

struct BeetstraCubicPolydispersity
{
    static constexpr const char* name = "BeetstraCubic";
    static constexpr const char* line = "mixtures: factor y + 0.064 y^3, 1.064 at y = 1 (Beetstra et al. 2007)";

    double operator()(double y, double /*voidFraction*/, double f) const noexcept
    {
        return y * (1.0 + 0.064 * y * y) * f;
    }
};

struct YinSundaresanPolydispersity
{
    static constexpr const char* name = "YinSundaresan";
    static constexpr const char* line = "mixtures: Stokes drag, small among large ones (Yin & Sundaresan 2009)";

    double operator()(double y, double voidFraction, double f) const noexcept
    {
        const double phi = 1.0 - voidFraction;
        const double a = 1.0 + phi * (-2.660 + phi * (9.096 - 11.338 * phi));
        return 1.0 + (f - 1.0) * y * (a + (1.0 - a) * y);
    }
};

// A polydispersity law is added to the programs by one line here.
// clang-format off
using PolydispersityLaws = std::tuple<
    BeetstraPolydispersity,
    BeetstraCubicPolydispersity,
    YinSundaresanPolydispersity
>;
// clang-format on

inline std::vector<std::string> polydispersityLawNames()
{
    return std::apply([](const auto&... law) { return std::vector<std::string>{law.name...}; }, PolydispersityLaws{});
}

/// Sp of a particle in a mixture [kg/s].
/// \param particle  with its own diameter
/// \param sauterMeanDiameter  of the particles around it [m]
template<class PolydispersityLaw, class DragLaw>
double polydisperseDrag(const PolydispersityLaw& polydispersity, const DragLaw& drag, const ParticleInFluid& particle,
    double sauterMeanDiameter)
{
    ParticleInFluid mean = particle;
    mean.diameter = sauterMeanDiameter;
    return stokesCoefficient(particle)
           * polydispersity(
               particle.diameter / sauterMeanDiameter, particle.voidFraction, drag(mean) / stokesCoefficient(mean));
}

} // namespace clepsydra::closures
