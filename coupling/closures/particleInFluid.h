/// \file
/// What every drag law is given, and the few quantities that most laws share.
///
/// Contract of a drag law: a stateless functor
///
///     struct MyDrag
///     {
///         static constexpr const char* name = "MyDrag";
///         static constexpr const char* line = "drag of what, in which range (source)";
///         double operator()(const ParticleInFluid&) const noexcept;   // Sp >= 0 [kg/s]
///     };
///
/// with the drag force on the particle F = Sp (U_f - u_p), U_f being the interstitial velocity. F is the whole drag of
/// MODEL A (Zhou, Kuang, Chu & Yu, J. Fluid Mech. 661, 2010): the force that stands BESIDE the separate force
/// -V_p grad p of the pressure gradient. A law published as an exchange coefficient beta [kg/(m3 s)] of model A
/// gives Sp = beta V_p/(1 - eps). Model B's drag is Sp/eps, see ParticleForces.
///
/// A law is evaluated for every particle at every DEM step, some 1e9 times a day. So: no allocation, powers of eps from
/// the cached logarithm, branches only where the law itself has them, and a finite value at rest. At rest a law
/// returns its own creeping limit. The FORCE Sp |U_r| of every law here rises with |U_r|; Sp itself need not
/// (Di Felice's and Rong's exponents dip near Re = 30).
#pragma once

#include "closures/constants.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::closures
{

/// What a drag law may know about a particle and the fluid around it. SI units.
/// Expected: all > 0 but slipSpeed >= 0; 0 < voidFraction <= 1; logVoidFraction belongs to voidFraction.
struct ParticleInFluid
{
    double diameter;         // m
    double voidFraction;     // fluid's share of the volume around the particle
    double logVoidFraction;  // natural logarithm, cached once per interval
    double slipSpeed;        // |U_f - u_p|, interstitial (not superficial), m/s
    double density;          // of the fluid, kg/m3
    double dynamicViscosity; // Pa s
};

/// Fills in the logarithm. For start-up, tests and tools; the time loop caches it itself.
inline ParticleInFluid makeParticleInFluid(
    double diameter, double voidFraction, double slipSpeed, double density, double dynamicViscosity)
{
    return {diameter, voidFraction, std::log(voidFraction), slipSpeed, density, dynamicViscosity};
}

/// rho |U_r| d/mu, with the interstitial slip: for laws of an isolated particle.
inline double isolatedReynolds(const ParticleInFluid& particle) noexcept
{
    return particle.density * particle.slipSpeed * particle.diameter / particle.dynamicViscosity;
}

/// rho eps |U_r| d/mu, with the superficial slip: what nearly all laws of suspensions and beds mean by Re.
inline double superficialReynolds(const ParticleInFluid& particle) noexcept
{
    return particle.voidFraction * isolatedReynolds(particle);
}

/// 3 pi mu d: Sp of an isolated particle in creeping flow, the unit in which the laws are written here. With it
/// C_d = 24/Re f turns into Sp = 3 pi mu d f, which has no 0/0 at rest.
inline double stokesCoefficient(const ParticleInFluid& particle) noexcept
{
    return 3.0 * pi * particle.dynamicViscosity * particle.diameter;
}

/// 1 - eps, kept above zero so that a law may take its logarithm; the laws tend to their isolated-particle values there.
/// Nothing physical is clipped: eps outside (0, 1] is for the conservation check to find.
inline double solidFraction(const ParticleInFluid& particle) noexcept
{
    return std::max(1.0 - particle.voidFraction, 1e-30);
}

/// Natural logarithm of a Reynolds number, finite at rest. The floor is so low that Re^0.3 is below rounding there.
inline double logReynolds(double reynolds) noexcept
{
    return std::log(std::max(reynolds, 1e-60));
}

/// eps^exponent from the cached logarithm.
inline double powerOfVoidFraction(const ParticleInFluid& particle, double exponent) noexcept
{
    return std::exp(exponent * particle.logVoidFraction);
}

} // namespace clepsydra::closures
