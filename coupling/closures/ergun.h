/// \file
/// S. Ergun, Chem. Eng. Prog. 48, 89 (1952): pressure drop of a packed bed of spheres, and minimum fluidisation.
///
///     dp/L = 150 mu (1 - eps)^2 U/(eps^3 d^2) + 1.75 rho (1 - eps) U^2/(eps^3 d)
///
/// U is the superficial velocity; p is without its hydrostatic part. Range: rho U d/(mu (1 - eps)) up to about 2000,
/// eps = 0.35..0.5. Measurements scatter by about 15 %.
#pragma once

#include <cmath>

namespace clepsydra::closures
{

struct PackedBed
{
    double diameter;         // of the particles, m
    double voidFraction;     // -
    double density;          // of the fluid, kg/m3
    double dynamicViscosity; // Pa s
};

/// Coefficients of dp/L = linear U + quadratic U^2.
struct ErgunCoefficients
{
    double linear;    // Pa s/m2
    double quadratic; // Pa s2/m3
};

inline ErgunCoefficients ergunCoefficients(const PackedBed& bed) noexcept
{
    const double eps3 = bed.voidFraction * bed.voidFraction * bed.voidFraction;
    const double phi = 1.0 - bed.voidFraction;
    return {150.0 * bed.dynamicViscosity * phi * phi / (eps3 * bed.diameter * bed.diameter),
        1.75 * bed.density * phi / (eps3 * bed.diameter)};
}

/// Pressure drop per length [Pa/m]; it has the sign of the velocity.
inline double ergunPressureGradient(const PackedBed& bed, double superficialVelocity) noexcept
{
    const ErgunCoefficients c = ergunCoefficients(bed);
    return (c.linear + c.quadratic * std::abs(superficialVelocity)) * superficialVelocity;
}

/// Buoyant weight of a bed per volume [N/m3], which equals the pressure gradient of any fluidised bed.
inline double buoyantWeightGradient(const PackedBed& bed, double particleDensity, double gravity) noexcept
{
    return (1.0 - bed.voidFraction) * (particleDensity - bed.density) * gravity;
}

/// Superficial velocity at which Ergun's pressure drop balances the bed's buoyant weight [m/s]. This form of the
/// root avoids cancellation for fine particles. \pre particleDensity >= density
inline double minimumFluidisationVelocity(const PackedBed& bed, double particleDensity, double gravity) noexcept
{
    const ErgunCoefficients c = ergunCoefficients(bed);
    const double weight = buoyantWeightGradient(bed, particleDensity, gravity);
    return 2.0 * weight / (c.linear + std::sqrt(c.linear * c.linear + 4.0 * c.quadratic * weight));
}

} // namespace clepsydra::closures
