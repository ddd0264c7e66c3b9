/// \file
/// Times that the DEM step and the coupling step must resolve. SI units throughout.
#pragma once

#include "closures/constants.h"

#include <cmath>

namespace clepsydra::closures
{

/// Shear modulus G = E/(2 (1 + nu)) [Pa].
inline double shearModulus(double youngsModulus, double poissonRatio) noexcept
{
    return 0.5 * youngsModulus / (1.0 + poissonRatio);
}

/// Time of a Rayleigh wave over half of a particle's circumference, pi R sqrt(rho/G)/(0.1631 nu + 0.8766) [s], which
/// LIGGGHTS calls the Rayleigh time. DEM steps are usually 0.1..0.3 of it. Li, Xu & Thornton, Powder Technol. 160, 219
/// (2005).
inline double rayleighTime(double radius, double density, double shearModulus, double poissonRatio) noexcept
{
    return pi * radius * std::sqrt(density / shearModulus) / (0.1631 * poissonRatio + 0.8766);
}

/// Duration of an elastic Hertz collision, T = 2.8683 (m*^2/(R* E*^2 v))^(1/5) with the speed of approach v [s]
/// (Johnson, Contact Mechanics, 1985, section 11.4, who prints 2.87). The effective values are 1/m* = 1/m1 + 1/m2, 1/R*
/// = 1/R1 + 1/R2, 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
inline double hertzCollisionTime(
    double effectiveMass, double effectiveRadius, double effectiveModulus, double approachSpeed) noexcept
{
    const double ratio = effectiveMass / effectiveModulus;
    return 2.8682656992 * std::pow(ratio * ratio / (effectiveRadius * approachSpeed), 0.2);
}

/// The same for two equal particles of one material: m* = m/2, R* = R/2, E* = E/(2 (1 - nu^2)).
inline double hertzCollisionTimeOfEqualParticles(
    double radius, double density, double youngsModulus, double poissonRatio, double approachSpeed) noexcept
{
    const double mass = 4.0 / 3.0 * pi * radius * radius * radius * density;
    return hertzCollisionTime(
        0.5 * mass, 0.5 * radius, 0.5 * youngsModulus / (1.0 - poissonRatio * poissonRatio), approachSpeed);
}

/// Time in which drag brings a particle to the fluid's velocity, inertia/Sp [s]. The inertia is the particle's mass
/// plus its added mass, where that force is selected.
inline double relaxationTime(double inertia, double dragCoefficient) noexcept
{
    return inertia / dragCoefficient;
}

} // namespace clepsydra::closures
