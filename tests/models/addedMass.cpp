/// \file
/// virtualMassForce: implicit in the particle's inertia, and its whole reaction acts on the fluid.

#include "closures/addedMass.h"
#include "forcesOnParticles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clepsydra::tests
{

namespace
{

constexpr double radius = 1e-3;

/// From rest in still water: (1 - r) g/(1 + r/2), r = rho_f/rho_p: 4.970 m/s2 for glass (2540), 0.316 at a density
/// ratio of 1.05, upwards for particles lighter than water, even nearly without mass. Without added mass glass starts with
/// 5.95 m/s2; with an explicit one, -m_a (dv/dt of the last step), light particles blow up within a few steps.
TEST(VirtualMass, GivesTheAccelerationFromRestAtAnyDensity)
{
    for (const double density : {2540.0, 1050.0, 900.0, 500.0, 10.0})
    {
        ForcesOnParticles test("forceModels (virtualMassForce Archimedes);");
        test.engine().addParticle(1, Vector3d::Zero(), radius, density);
        const double expected = closures::accelerationFromRest(9.81, 1000, density, 0.5);
        for (int step = 0; step < 100; ++step)
        {
            EXPECT_NEAR(test.accelerationOf(0).z() / -expected, 1, 1e-9) << density << " kg/m3, step " << step;
        }
    }
}

/// With drag the particle reaches the same terminal velocity with added mass and without, at density ratios around 1, in
/// steps ten times as long as the relaxation of the light particle's own mass would allow an explicit added mass.
TEST(VirtualMass, LeavesTheTerminalVelocity)
{
    for (const double density : {1050.0, 950.0, 100.0})
    {
        ForcesOnParticles with("forceModels (StokesDrag virtualMassForce Archimedes);", {1000, 1, {0, 0, -9.81}});
        ForcesOnParticles without("forceModels (StokesDrag Archimedes);", {1000, 1, {0, 0, -9.81}});
        with.engine().addParticle(1, Vector3d::Zero(), radius, density);
        without.engine().addParticle(1, Vector3d::Zero(), radius, density);
        with.engine().advance(1000);
        without.engine().advance(1000);
        const double terminal = -2.0 / 9 * (density - 1000) * 9.81 * radius * radius;
        EXPECT_NEAR(with.engine().particles().velocity(2, 0) / terminal, 1, 1e-6);
        EXPECT_NEAR(without.engine().particles().velocity(2, 0) / terminal, 1, 1e-6);
    }
}

/// A particle with the fluid's density in a fluid that accelerates goes with it, when it also feels the pressure gradient
/// that accelerates the fluid: (rho V + m_a) a = dv/dt (m + m_a). With the sign of DU/Dt wrong it lags by two thirds.
TEST(VirtualMass, CarriesANeutralParticleWithTheFluid)
{
    ForcesOnParticles test("forceModels (virtualMassForce gradPForce);", {1000, 1e-3, Vector3d::Zero()});
    test.engine().addParticle(1, Vector3d::Zero(), radius, 1000);
    test.fluidAt(0).acceleration = {3, -2, 1};
    test.fluidAt(0).pressureGradient = -1000 * test.fluidAt(0).acceleration;
    EXPECT_LT((test.accelerationOf(0) - test.fluidAt(0).acceleration).norm(), 1e-9);
}

/// Third law: what the fluid is given is the particle's gain of momentum less the impulse of gravity and of Archimedes'
/// force, whose reaction the fluid has already. An account without the added mass lacks a third of it.
TEST(VirtualMass, IsGivenToTheFluid)
{
    ForcesOnParticles test("forceModels (DiFeliceDrag virtualMassForce Archimedes);");
    test.engine().addParticle(1, Vector3d::Zero(), radius, 1050, {0.1, 0, 0});
    test.fluidAt(0).acceleration = {0, 5, 0};
    const double mass = 1050 * sphereVolume(radius);
    const Vector3d before = mass * test.engine().particles().velocity.col(0);
    test.engine().advance(50);
    const Vector3d gained = mass * test.engine().particles().velocity.col(0) - before;
    const Vector3d byGravityAndBuoyancy =
        50 * test.engine().timeStep() * Vector3d(0, 0, -9.81) * (mass - 1000 * sphereVolume(radius));
    EXPECT_LT((test.received(0).impulse - (gained - byGravityAndBuoyancy)).norm(), 1e-12 * gained.norm());
    EXPECT_GT(std::abs(test.received(0).impulse.y()), 0.1 * std::abs(gained.y()));
}

/// A particle that the engine holds fast does not accelerate, whatever pulls at it: what it gives to the fluid is the part of
/// the fluid's own acceleration, m_a DU/Dt per unit of time. As a free particle it would add 4.97 m/s2 of its own.
TEST(VirtualMass, OfAFixedParticleIsThatOfAParticleWithoutAcceleration)
{
    ForcesOnParticles test("forceModels (virtualMassForce Archimedes);");
    test.engine().addParticle(1, Vector3d::Zero(), radius, 2540);
    test.engine().holdParticle(1);
    test.fluidAt(0).acceleration = {0, 5, 0};
    test.engine().advance(50);
    const Vector3d expected =
        50 * test.engine().timeStep() * closures::addedMass(0.5, 1000, sphereVolume(radius)) * Vector3d(0, 5, 0);
    EXPECT_LT((test.received(0).impulse - expected).norm(), 1e-12 * expected.norm());
}

/// Zuber's coefficient, 2.75 at eps = .4, instead of 1/2: (1 - r) g/(1 + 2.75 r).
TEST(VirtualMass, TakesZubersCoefficient)
{
    ForcesOnParticles test("forceModels (virtualMassForce Archimedes); virtualMassForceProps { law Zuber; }");
    test.engine().addParticle(1, Vector3d::Zero(), radius, 2500);
    test.fluidAt(0).voidFraction = 0.4;
    EXPECT_NEAR(test.accelerationOf(0).z(), -0.6 * 9.81 / (1 + 2.75 * 0.4), 1e-9);
}

/// A constant coefficient beside Zuber's law would be without effect.
TEST(VirtualMass, RefusesACoefficientBesideZubersLaw)
{
    EXPECT_THROW(ForcesOnParticles("forceModels (virtualMassForce); virtualMassForceProps { law Zuber; Cadd 0.7; }"),
        Foam::IOerror);
}

/// It asks for DU/Dt, which is not sampled otherwise.
TEST(VirtualMass, AsksForTheFluidsAcceleration)
{
    EXPECT_TRUE(ForcesOnParticles("forceModels (StokesDrag virtualMassForce);").forces().needs().acceleration);
    EXPECT_FALSE(ForcesOnParticles("forceModels (StokesDrag);").forces().needs().acceleration);
}

} // namespace

} // namespace clepsydra::tests
