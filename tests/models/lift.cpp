/// \file
/// The directions of the lift forces; their closures give the magnitude only.

#include "forcesOnParticles.h"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

namespace
{

constexpr double radius = 0.5e-3;

/// Saffman: in U = (k y, 0, 0) a particle that lags is lifted to where the water is faster, +y, one that leads to -y; no part
/// along the flow. The size is the closure's: k = 4 1/s, slip .02 m/s: 1.824549e-7 * 4 * .02 = 1.45964e-8 N.
TEST(Lift, OfShearPointsToTheFasterSideForAParticleThatLags)
{
    for (const double lag : {1.0, -1.0})
    {
        ForcesOnParticles test("forceModels (SaffmanLiftForce);", {1000, 1e-3, Vector3d::Zero()});
        test.engine().addParticle(1, Vector3d::Zero(), radius);
        test.fluidAt(0).velocity = {lag * 0.02, 0, 0};
        test.fluidAt(0).vorticity = {0, 0, -4};
        const Vector3d force = 2500 * sphereVolume(radius) * test.accelerationOf(0);
        EXPECT_NEAR(force.y(), lag * 1.459639e-8, 1e-13);
        EXPECT_NEAR(force.x(), 0, 1e-20);
        EXPECT_NEAR(force.z(), 0, 1e-20);
        EXPECT_LT((test.received(0).impulse - test.engine().timeStep() * force).norm(),
            1e-12 * test.engine().timeStep() * force.norm());
    }
}

/// Magnus: a ball flying along +x with backspin (its top, +y, moving backwards: omega along +z) is lifted, +y.
/// A ball that turns with the fluid, omega = curl U/2, is not. pi/8 rho d^3 .02*4 = 3.141593e-8 N.
TEST(Lift, OfRotationLiftsABallWithBackspin)
{
    ForcesOnParticles test("forceModels (MagnusLiftForce);", {1000, 1e-3, Vector3d::Zero()});
    test.engine().addParticle(1, Vector3d::Zero(), radius);
    test.fluidAt(0).velocity = {-0.02, 0, 0};
    // The fluid turning by -z is, for the lift, the particle turning by +z.
    test.fluidAt(0).vorticity = {0, 0, -8};
    const Vector3d force = 2500 * sphereVolume(radius) * test.accelerationOf(0);
    EXPECT_NEAR(force.y(), 3.141593e-8, 1e-13);
    EXPECT_NEAR(force.x(), 0, 1e-20);
}

} // namespace

} // namespace clepsydra::tests
