/// \file
/// D. Gidaspow, Multiphase Flow and Fluidization, Academic Press (1994): S. Ergun, Chem. Eng. Prog. 48, 89 (1952) in
/// dense regions and C. Y. Wen & Y. H. Yu, Chem. Eng. Prog. Symp. Ser. 62, 100 (1966) in dilute ones.
///
///     eps <= 0.8:  beta = 150 (1 - eps)^2 mu/(eps d^2) + 1.75 (1 - eps) rho |U_r|/d
///     eps >  0.8:  beta = 3/4 C_d eps (1 - eps) rho |U_r|/d eps^-2.65
///                  C_d of Schiller & Naumann (see there for Re > 1000), Re = rho eps |U_r| d/mu
///     Sp = beta V_p/(1 - eps)
///
/// beta is the exchange coefficient of model A: with eps grad p = -beta U_r the first line is Ergun's equation for the
/// pressure drop.
///
/// THE LAW IS DISCONTINUOUS at eps = 0.8, and it is implemented as published; the tests check the size of the jump.
/// From Ergun's branch to Wen & Yu's the drag drops to 0.87 at zero slip, 0.95 at Re = 10, 0.58 at Re = 100, 0.35 at Re
/// = 465 and 0.27 at Re = 1000. For 2 mm particles in water that is a factor of three. The two branches can also be
/// selected alone, as ErgunDrag and WenYuDrag.
#pragma once

#include "closures/schillerNaumannDrag.h"

namespace clepsydra::closures
{

/// The branch for dense regions, at any eps. Range: packed beds, eps < 0.8.
struct ErgunDrag
{
    static constexpr const char* name = "ErgunDrag";
    static constexpr const char* line = "drag of packed beds only (Ergun 1952)";

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        const double eps = particle.voidFraction;
        // V_p/(1 - eps) beta = 3 pi mu d [150/18 (1 - eps)/eps + 1.75/18 Re/eps]
        return stokesCoefficient(particle) * (150.0 * (1.0 - eps) + 1.75 * superficialReynolds(particle))
               / (18.0 * eps);
    }
};

/// The branch for dilute regions, at any eps. At eps = 1 it is Schiller & Naumann's law.
struct WenYuDrag
{
    static constexpr const char* name = "WenYuDrag";
    static constexpr const char* line = "drag of dilute suspensions (Wen & Yu 1966)";

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        return stokesCoefficient(particle) * schillerNaumannFactor(superficialReynolds(particle))
               * powerOfVoidFraction(particle, -2.65);
    }
};

struct GidaspowDrag
{
    static constexpr const char* name = "GidaspowDrag";
    static constexpr const char* line = "drag: Ergun in beds, Wen & Yu above a void fraction of 0.8 (Gidaspow 1994)";
    static constexpr double switchingVoidFraction = 0.8;

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        return particle.voidFraction > switchingVoidFraction ? WenYuDrag{}(particle) : ErgunDrag{}(particle);
    }
};

} // namespace clepsydra::closures
