/// \file
/// Model B against model A, at the particle.

#include "forcesOnParticles.h"

#include "closures/diFeliceDrag.h"

#include "error.H"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

namespace
{

constexpr double radius = 1e-3;
constexpr double voidFraction = 0.45;
constexpr double speed = 0.1;

/// Force on a fixed particle in a uniform bed with steady upward flow [N]; in model A the pressure gradient is what drag
/// makes it, eps grad p = -n F_drag.
double forceInBed(const std::string& couplingProperties)
{
    ForcesOnParticles test(couplingProperties, {1000, 1e-3, Vector3d::Zero()});
    test.engine().addParticle(1, Vector3d::Zero(), radius);
    FluidAtParticle& fluid = test.fluidAt(0);
    fluid.voidFraction = voidFraction;
    fluid.logVoidFraction = std::log(voidFraction);
    fluid.velocity = {0, 0, speed};
    const double drag =
        speed * closures::DiFeliceDrag{}(closures::makeParticleInFluid(2 * radius, voidFraction, speed, 1000, 1e-3));
    fluid.pressureGradient = {0, 0, -drag * (1 - voidFraction) / sphereVolume(radius) / voidFraction};
    return test.accelerationOf(0).z() * 2500 * sphereVolume(radius);
}

/// In a uniform bed both models put the same force on a particle: drag/eps. Model A's drag alone is .45 of it.
TEST(ModelType, BothGiveTheSameForceInAUniformBed)
{
    const double a = forceInBed("modelType A; forceModels (DiFeliceDrag gradPForce);");
    const double b = forceInBed("modelType B; forceModels (DiFeliceDrag);");
    EXPECT_NEAR(b / a, 1, 1e-9);
    EXPECT_NEAR(b / forceInBed("modelType A; forceModels (DiFeliceDrag);"), 1 / voidFraction, 1e-9);
}

/// In model B all that acts on the particle from the fluid is given back: the fluid's equation holds none of it.
TEST(ModelType, InBTheFluidIsGivenAll)
{
    ForcesOnParticles test("modelType B; forceModels (DiFeliceDrag virtualMassForce);", {1000, 1e-3, Vector3d::Zero()});
    test.engine().addParticle(1, Vector3d::Zero(), radius);
    test.fluidAt(0).voidFraction = voidFraction;
    test.fluidAt(0).velocity = {0, 0, speed};
    const Vector3d gained = 2500 * sphereVolume(radius) * test.engine().timeStep() * test.accelerationOf(0);
    EXPECT_LT((test.received(0).impulse - gained).norm(), 1e-12 * gained.norm());
}

/// Forces that model B has in its drag already are refused, with the reason.
TEST(ModelType, BRefusesThePressureGradientOnTheParticles)
{
    for (const std::string name : {"gradPForce", "viscForce"})
    {
        try
        {
            const ForcesOnParticles taken("modelType B; forceModels (DiFeliceDrag " + name + ");");
            FAIL() << name << " was taken";
        }
        catch (const Foam::IOerror& error)
        {
            EXPECT_NE(error.message().find(name), std::string::npos) << error.message();
            EXPECT_NE(error.message().find("model B"), std::string::npos) << error.message();
        }
    }
}

} // namespace

} // namespace clepsydra::tests
