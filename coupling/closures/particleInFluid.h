/// \file
/// What every drag law receives, and quantities that most laws share.
///
/// A drag law is a stateless functor:
///
///     struct MyDrag
///     {
///         static constexpr const char* name = "MyDrag";
///         static constexpr const char* line = "drag of what, in which range (source)";
///         double operator()(const ParticleInFluid&) const noexcept;   // Sp >= 0 [kg/s]
///     };
///
/// The drag force on the particle is F = Sp (U_f - u_p) with the interstitial velocity U_f. F is the whole drag of
/// MODEL A (Zhou, Kuang, Chu & Yu, J. Fluid Mech. 661, 2010), to which the separate force -V_p grad p of the pressure
/// gradient is ADDED. A law that is published as an exchange coefficient beta [kg/(m3 s)] of model A gives Sp = beta
/// V_p/(1 - eps). Model B's drag is Sp/eps, see ParticleForces.
///
/// A law is evaluated for every particle at every DEM step, about 1e9 times a day. It therefore allocates nothing,
/// computes powers of eps from the cached logarithm, branches only where the law itself does, and is finite at zero
/// slip, where it returns its creeping-flow limit. The FORCE Sp |U_r| of every law here increases with |U_r|; Sp itself
/// need not, because the exponents of Di Felice and Rong have a minimum near Re = 30.
#pragma once

#include "closures/constants.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::closures
{

/// State of a particle and its fluid for a drag law. SI units; all values > 0 except slipSpeed >= 0; 0 < voidFraction
/// <= 1, and logVoidFraction is its logarithm.
struct ParticleInFluid
{
    double diameter;         // m
    double voidFraction;     // fluid's share of the volume around the particle
    double logVoidFraction;  // natural logarithm, cached once per coupling step
    double slipSpeed;        // |U_f - u_p|, interstitial (not superficial), m/s
    double density;          // of the fluid, kg/m3
    double dynamicViscosity; // Pa s
};

/// Computes the logarithm. For start-up, tests and tools; the time loop caches it.
inline ParticleInFluid makeParticleInFluid(
    double diameter, double voidFraction, double slipSpeed, double density, double dynamicViscosity)
{
    return {diameter, voidFraction, std::log(voidFraction), slipSpeed, density, dynamicViscosity};
}

/// rho |U_r| d/mu with the interstitial slip, for laws of an isolated particle.
inline double isolatedReynolds(const ParticleInFluid& particle) noexcept
{
    return particle.density * particle.slipSpeed * particle.diameter / particle.dynamicViscosity;
}

/// rho eps |U_r| d/mu with the superficial slip, which nearly all laws of suspensions and beds mean by Re.
inline double superficialReynolds(const ParticleInFluid& particle) noexcept
{
    return particle.voidFraction * isolatedReynolds(particle);
}

/// 3 pi mu d: Sp of an isolated particle in creeping flow, the unit in which the laws are written here. With it C_d =
/// 24/Re f becomes Sp = 3 pi mu d f, which is finite at zero slip.
inline double stokesCoefficient(const ParticleInFluid& particle) noexcept
{
    return 3.0 * pi * particle.dynamicViscosity * particle.diameter;
}

/// 1 - eps, kept above zero so that a law can take its logarithm; the laws tend to their values for an isolated
/// particle there. No physical value is clipped: the conservation check finds eps outside (0, 1].
inline double solidFraction(const ParticleInFluid& particle) noexcept
{
    return std::max(1.0 - particle.voidFraction, 1e-30);
}

/// Natural logarithm of a Reynolds number, finite at zero slip. The lower bound is so small that Re^0.3 is below
/// rounding there.
inline double logReynolds(double reynolds) noexcept
{
    return std::log(std::max(reynolds, 1e-60));
}

/// eps^exponent, from the cached logarithm.
inline double powerOfVoidFraction(const ParticleInFluid& particle, double exponent) noexcept
{
    return std::exp(exponent * particle.logVoidFraction);
}

} // namespace clepsydra::closures
