/// \file
/// The fluid's torque on rotating particles: how the rotation changes in time, against exact solutions of
/// I domega/dt = C_t (curl(U)/2 - omega) + other torques.

#include "forcesOnParticles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clepsydra::tests
{

namespace
{

constexpr double radius = 1e-3;
constexpr double density = 2500;
const FluidProperties restingWater{1000, 1e-3, Vector3d::Zero()};

double inertia(double particleRadius = radius, double particleDensity = density)
{
    return 0.4 * particleDensity * sphereVolume(particleRadius) * particleRadius * particleRadius;
}

Vector3d rotation(ForcesOnParticles& test)
{
    return test.engine().particles().angularVelocity.col(0);
}

/// A 2 mm glass sphere in water, 100 rad/s about an oblique axis, 0.1 s later.
double after(const std::string& law, double duration = 0.1)
{
    const Vector3d axis = Vector3d(1, -2, 3).normalized();
    ForcesOnParticles test("forceModels (" + law + ");", restingWater);
    test.engine().addParticle(1, Vector3d::Zero(), radius, density);
    test.engine().spinParticle(1, 100 * axis);
    test.engine().advance(static_cast<int>(std::lround(duration / test.engine().timeStep())));
    EXPECT_LT(rotation(test).cross(axis).norm(), 1e-12 * 100);
    return rotation(test).dot(axis);
}

} // namespace

/// The relaxation time is I/(8 pi mu R^3) = rho_p R^2/(15 mu) = 1/6 s: 100 exp(-0.6) = 54.881 rad/s.
TEST(Torque, InCreepingFlowIsTheExactExponential)
{
    EXPECT_NEAR(after("StokesTorque"), 100 * std::exp(-0.6), 1e-9);
}

/// With Re_r = 4 s omega, Dennis' law is domega/dt = -6/s (a sqrt(omega) + b) omega with a = 2*12.9/(64 pi),
/// b = 128.4/(64 pi), solved by 1/sqrt(omega) + a/b = (1/10 + a/b) exp(3 b t/s): 37.387 rad/s, a third below Stokes' value.
TEST(Torque, OfDennisIsTheSolutionInClosedForm)
{
    const double b = 128.4 / (64 * M_PI);
    const double ratio = 2 * 12.9 / 128.4;
    const double exact = 1 / std::pow((0.1 + ratio) * std::exp(0.3 * b) - ratio, 2);
    EXPECT_NEAR(exact, 37.387, 1e-2);
    EXPECT_NEAR(after("DennisTorque"), exact, 5e-3);
}

/// At small Re_r Dennis' law is Stokes': 2 mm, from 100 rad/s in a liquid that is a thousand times as viscous.
TEST(Torque, OfDennisIsStokesWhereTheLiquidIsThick)
{
    ForcesOnParticles test("forceModels (DennisTorque);", {1000, 1, Vector3d::Zero()});
    test.engine().addParticle(1, Vector3d::Zero(), radius, density);
    test.engine().spinParticle(1, {0, 0, 100});
    test.engine().advance(10);
    EXPECT_NEAR(rotation(test).z(), 100 * std::exp(-0.6), 1e-9);
}

/// A DEM step of ten relaxation times: the rotation falls by exp(-10) in each. An explicit torque would grow by -9.
TEST(Torque, IsExactAtAnyDemStep)
{
    const double small = 5e-6;
    const double relaxationTime = 1e-6;
    const double viscosity = density * small * small / (15 * relaxationTime);
    ForcesOnParticles test("forceModels (StokesTorque);", {1000, viscosity, Vector3d::Zero()});
    test.engine().addParticle(1, Vector3d::Zero(), small, density);
    test.engine().spinParticle(1, {0, 100, 0});
    test.engine().advance(1);
    EXPECT_NEAR(rotation(test).y(), 100 * std::exp(-10), 1e-10);
    test.engine().advance(5);
    EXPECT_LT(std::abs(rotation(test).y()), 1e-20);
}

/// A constant torque of contacts M turns the particle at M/C_t in the end, also where the DEM step is ten relaxation times.
/// Without the share of the others in the implicit torque it would be ten times as fast.
TEST(Torque, IsInEquilibriumWithATorqueOfContacts)
{
    const double small = 5e-6;
    const double viscosity = density * small * small / 15e-6;
    const double coefficient = 8 * M_PI * viscosity * small * small * small;
    ForcesOnParticles test("forceModels (StokesTorque);", {1000, viscosity, Vector3d::Zero()});
    test.engine().addParticle(1, Vector3d::Zero(), small, density);
    test.engine().spinParticle(1, Vector3d::Zero(), {0, 0, 3 * coefficient});
    test.engine().advance(4);
    EXPECT_NEAR(rotation(test).z(), 3, 1e-12);
}

/// In fluid with the vorticity 2 w a particle ends up turning at w.
TEST(Torque, TurnsAParticleWithTheFluid)
{
    ForcesOnParticles test("forceModels (StokesTorque);", {1000, 1, Vector3d::Zero()});
    test.engine().addParticle(1, Vector3d::Zero(), radius, density);
    test.fluidAt(0).vorticity = {-4, 0, 20};
    test.engine().advance(1000);
    EXPECT_LT((rotation(test) - Vector3d(-2, 0, 10)).norm(), 1e-9);
}

/// What the fluid is charged with is what the particle has lost; of a particle that cannot turn it is the torque itself,
/// which turns nothing; of one that is half in the fluid it is half.
TEST(Torque, ChargesTheFluidWithWhatTheParticleReceives)
{
    ForcesOnParticles test("forceModels (DennisTorque);", restingWater);
    test.engine().addParticle(1, Vector3d::Zero(), radius, density);
    test.engine().spinParticle(1, {0, 30, 0});
    test.engine().advance(50);
    const Vector3d lost = inertia() * (rotation(test) - Vector3d(0, 30, 0));
    EXPECT_LT((test.engine().particles().state[0].angularImpulse - lost).norm(), 1e-10 * lost.norm());
    EXPECT_GT(lost.norm(), 1e-6 * inertia() * 30);

    ForcesOnParticles held("forceModels (StokesTorque);", restingWater);
    held.engine().addParticle(1, Vector3d::Zero(), radius, density);
    held.engine().spinParticle(1, {0, 30, 0});
    held.engine().holdParticle(1);
    held.fluidAt(0).submergedFraction = 0.5;
    held.engine().advance(1);
    EXPECT_NEAR(held.engine().particles().state[0].angularImpulse.y(),
        -0.5 * 8 * M_PI * 1e-3 * 1e-9 * 30 * held.engine().timeStep(), 1e-20);
    EXPECT_EQ(rotation(held), Vector3d(0, 30, 0));
}

/// A torque exerts no force, and forces alone leave the rotation as it is and charge the fluid with no couple.
TEST(Torque, IsApartFromTheForces)
{
    ForcesOnParticles torque("forceModels (DennisTorque);", restingWater);
    torque.engine().addParticle(1, Vector3d::Zero(), radius, density);
    torque.engine().spinParticle(1, {0, 0, 50});
    torque.fluidAt(0).velocity = {0.1, 0, 0};
    EXPECT_EQ(torque.accelerationOf(0), Vector3d::Zero());

    ForcesOnParticles forces("forceModels (MagnusLiftForce);", restingWater);
    forces.engine().addParticle(1, Vector3d::Zero(), radius, density);
    forces.engine().spinParticle(1, {0, 0, 50}, {0, 0, 1e-9});
    forces.fluidAt(0).velocity = {0.1, 0, 0};
    EXPECT_GT(forces.accelerationOf(0).norm(), 1e-3);
    EXPECT_NEAR(rotation(forces).z(), 50 + 1e-9 / inertia() * forces.engine().timeStep(), 1e-12);
    EXPECT_EQ(forces.engine().particles().state[0].angularImpulse, Vector3d::Zero());
}

/// The lift by rotation loses its cause as the torque takes the spin away: with Magnus' lift alone the sideways impulse on a
/// sphere in a uniform stream is pi/8 rho d^3 u omega_0 t, with the torque of Stokes omega_0 tau (1 - exp(-t/tau)) in the
/// place of omega_0 t, to the first order of the splitting. A lift that took another rotation than the torque would keep
/// its value.
TEST(Torque, TakesTheLiftAwayWithTheSpin)
{
    constexpr double speed = 1e3;
    constexpr double spin = 1e-3;
    constexpr int steps = 20000;
    const auto sideways = [&](const std::string& forceModels) {
        // So fast that the sphere's own sideways motion is nothing beside the stream.
        ForcesOnParticles test("forceModels (" + forceModels + ");", restingWater);
        test.engine().addParticle(1, Vector3d::Zero(), radius, density);
        test.engine().spinParticle(1, {0, 0, spin});
        test.fluidAt(0).velocity = {-speed, 0, 0};
        test.engine().advance(steps);
        return density * sphereVolume(radius) * test.engine().particles().velocity(1, 0);
    };
    constexpr double duration = steps * 1e-5;
    const double perRotation = M_PI / 8 * 1000 * std::pow(2 * radius, 3) * speed;
    const double relaxationTime = 1.0 / 6;
    EXPECT_NEAR(sideways("MagnusLiftForce") / (perRotation * spin * duration), 1, 1e-3);
    EXPECT_NEAR(sideways("MagnusLiftForce StokesTorque")
                    / (perRotation * spin * relaxationTime * (1 - std::exp(-duration / relaxationTime))),
        1, 1e-3);
}

} // namespace clepsydra::tests
