/// \file
/// Added mass: the mass of fluid that is accelerated together with a particle.
///
///     F = m_a (DU/Dt - dv/dt),     m_a = C_m rho_f V_p,     DU/Dt = dU/dt + U.grad U
///
/// C_m = 1/2 for an isolated sphere in any flow, viscous or not (Auton, Hunt & Prud'homme, J. Fluid Mech. 197, 241
/// (1988)). In a suspension of solid fraction phi = 1 - eps each sphere moves against the return flow of the others:
/// C_m = (1 + 2 phi)/(2 (1 - phi)) from a cell model by N. Zuber, Chem. Eng. Sci. 19, 897 (1964). It holds for phi up
/// to about 0.3; above that, a particle is always within reach of others. At eps = 0.4 it gives 2.75.
///
/// The tests check a consequence: released from rest a particle accelerates by (1 - rho_f/rho_p) g/(1 + C_m
/// rho_f/rho_p).
#pragma once

namespace clepsydra::closures
{

inline constexpr double isolatedAddedMassCoefficient = 0.5;

/// C_m after Zuber [-]. \param voidFraction  in (0, 1]
inline double zuberAddedMassCoefficient(double voidFraction) noexcept
{
    const double solid = 1.0 - voidFraction;
    return 0.5 * (1.0 + 2.0 * solid) / (1.0 - solid);
}

/// m_a [kg].
/// \param coefficient  C_m [-]
/// \param density  of the fluid [kg/m3]
/// \param volume  of the particle [m3]
inline double addedMass(double coefficient, double density, double volume) noexcept
{
    return coefficient * density * volume;
}

/// Acceleration of a particle that is released in fluid at rest [m/s2].
inline double accelerationFromRest(
    double gravity, double fluidDensity, double particleDensity, double coefficient) noexcept
{
    const double ratio = fluidDensity / particleDensity;
    return (1.0 - ratio) * gravity / (1.0 + coefficient * ratio);
}

} // namespace clepsydra::closures
