/// \file
/// The velocity at a smeared force in its closed-form limits.

#include "closures/selfInducedVelocity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace clepsydra::closures;

constexpr double bandwidth = 6e-3;
constexpr double density = 1100;
constexpr double viscosity = 0.02;

/// Stokes' flow: F/(3 pi^1.5 mu b). Half or twice of it is what a lost factor gives.
TEST(SelfInducedVelocity, IsStokesAtRest)
{
    const double stokes = 1 / (3 * std::pow(pi, 1.5) * viscosity * bandwidth);
    EXPECT_NEAR(velocityPerForce({bandwidth, density, viscosity, 0, 0}) / stokes, 1, 1e-4);
    EXPECT_NEAR(velocityPerForce({bandwidth, density, viscosity, 1e-7, 0}) / stokes, 1, 1e-3);
}

/// Far above Re 1: half of the deficit F/(rho U pi b2) of a wake as wide as the force; b/U instead of b2/nu.
TEST(SelfInducedVelocity, IsHalfTheWakeAtHighReynoldsNumber)
{
    const double speed = 1e4 * viscosity / (density * bandwidth);
    const double wake = 1 / (2 * pi * density * speed * bandwidth * bandwidth);
    EXPECT_NEAR(velocityPerForce({bandwidth, density, viscosity, speed, 0}) / wake, 1, 2e-3);
}

/// Dense neighbours: two thirds of the force per volume at the centre over their resistance (the pressure keeps a third).
TEST(SelfInducedVelocity, IsScreenedByNeighbours)
{
    const double resistance = 1e5 * viscosity / (bandwidth * bandwidth);
    const double screened = 2.0 / 3 / (std::pow(pi, 1.5) * std::pow(bandwidth, 3) * resistance);
    EXPECT_NEAR(velocityPerForce({bandwidth, density, viscosity, 0, resistance}) / screened, 1, 1e-3);
}

} // namespace
