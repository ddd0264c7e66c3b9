/// \file
/// historyForce: the motion of a particle that starts in still fluid, and the reaction on the fluid.

#include "closures/historyForce.h"
#include "forcesOnParticles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clepsydra::tests
{

namespace
{

constexpr double radius = 1e-3;
constexpr double viscosity = 0.1;
constexpr double fluidDensity = 1000;
constexpr double pi = closures::pi;

FluidProperties oil()
{
    return {fluidDensity, viscosity, {0, 0, -9.81}};
}

/// Gives the engine a particle, and the memory that the forces ask for.
void addParticle(ForcesOnParticles& test, double density, const Vector3d& velocity = Vector3d::Zero())
{
    test.engine().addParticle(1, Vector3d::Zero(), radius, density, velocity);
    test.engine().requestMemory(test.forces().needs().memory);
}

/// Velocity over the terminal one of a particle that starts from rest, creeping, with Stokes' drag, added mass and Basset's
/// force: with u = sqrt(s) its Laplace transform is ab/(s (u + a)(u + b)), where -a and -b are the roots of
/// M u2 + 6 pi R2 sqrt(rho mu) u + 6 pi mu R, real for particles lighter than 5/8 of the fluid. T. Boggio (1907), in Clift,
/// Grace & Weber, Bubbles, Drops, and Particles (1978), ch. 11.
double boggio(double time, double density)
{
    const double mass = sphereVolume(radius) * (density + 0.5 * fluidDensity);
    const double half = 3 * pi * radius * radius * std::sqrt(fluidDensity * viscosity) / mass;
    const double root = std::sqrt(half * half - 6 * pi * viscosity * radius / mass);
    const double a = half - root;
    const double b = half + root;
    const auto fading = [time](double x) { return std::exp(x * x * time) * std::erfc(x * std::sqrt(time)); };
    return ((1 - fading(a)) * b - (1 - fading(b)) * a) / (b - a);
}

/// A particle of .3 times the fluid's density rises from rest, against the closed solution, from a twentieth of its
/// relaxation time (1.8 ms) to ten of them. Without a history force it has 1 - exp(-1) = .63 of its speed after one
/// relaxation time and all of it after ten; with one .27 and .63.
TEST(HistoryForce, DelaysTheStartAsBoggioSays)
{
    const double density = 300;
    ForcesOnParticles test("forceModels (StokesDrag virtualMassForce historyForce Archimedes);"
                           "historyForceProps { law Basset; }",
        oil());
    addParticle(test, density);
    const double terminal = 2.0 / 9 * (fluidDensity - density) * 9.81 * radius * radius / viscosity;
    double time = 0;
    for (const int steps : {9, 21, 70, 100, 800, 1000})
    {
        test.engine().advance(steps);
        time += steps * test.engine().timeStep();
        EXPECT_NEAR(test.engine().particles().velocity(2, 0) / terminal / boggio(time, density), 1, 0.005)
            << time << " s";
    }
    EXPECT_NEAR(boggio(time, density), 0.65, 0.01);
}

/// Without drag and gravity, a velocity that jumps is soon taken off: m dv/dt = -C int K dv. The fluid is given what the
/// particle has lost, in steps of the explicit sum as in the implicit part.
TEST(HistoryForce, IsGivenToTheFluid)
{
    ForcesOnParticles test("forceModels (StokesDrag historyForce);", {fluidDensity, viscosity, Vector3d::Zero()});
    addParticle(test, 2500, {0.1, 0.02, 0});
    const double mass = 2500 * sphereVolume(radius);
    const Vector3d before = mass * test.engine().particles().velocity.col(0);
    test.engine().advance(300);
    const Vector3d gained = mass * test.engine().particles().velocity.col(0) - before;
    EXPECT_LT((test.received(0).impulse - gained).norm(), 1e-12 * gained.norm());
    EXPECT_GT(gained.norm(), 0.1 * before.norm());
}

/// A particle that goes on with the fluid, whatever that does, has no history with it; one that has always moved through it
/// has none either.
TEST(HistoryForce, BeginsWithTheMotionThatItFinds)
{
    ForcesOnParticles test("forceModels (historyForce);", {fluidDensity, viscosity, Vector3d::Zero()});
    addParticle(test, 2500, {0.1, 0, 0});
    EXPECT_EQ(test.accelerationOf(0), Vector3d(0, 0, 0));
    test.fluidAt(0).velocity = {-0.1, 0, 0};
    EXPECT_LT(test.accelerationOf(0).x(), -1);
}

/// A particle that is inserted, or comes back, has no fluid around it at first, and then finds one that flows: it has no
/// history with that either. If the still fluid that an empty state holds counted, the first step in the flow would be a
/// jump of its whole velocity.
TEST(HistoryForce, BeginsWhereAParticleEntersTheFluid)
{
    ForcesOnParticles test("forceModels (historyForce);", {fluidDensity, viscosity, Vector3d::Zero()});
    addParticle(test, 2500);
    for (int times = 0; times < 2; ++times)
    {
        test.fluidAt(0) = FluidAtParticle();
        test.fluidAt(0).submergedFraction = 0;
        test.engine().advance(3);
        test.fluidAt(0).submergedFraction = 1;
        test.fluidAt(0).velocity = {-0.1, 0, 0};
        EXPECT_EQ(test.accelerationOf(0), Vector3d(0, 0, 0));
        test.fluidAt(0).velocity = {0.1, 0, 0};
        EXPECT_GT(test.accelerationOf(0).x(), 1) << "in the fluid, a jump counts";
    }
}

/// The reaction to a past jump fades as tau^-1/2 with Basset's law, and 19 times faster by 20 tau_M with Mei & Adrian's:
/// (1 + 20^.75)^2 = 109 over what the particle's own slowing takes.
TEST(HistoryForce, FadesFasterWithMeiAndAdriansLaw)
{
    double slowing[2];
    const char* laws[] = {"Basset", "MeiAdrian"};
    for (int i = 0; i < 2; ++i)
    {
        ForcesOnParticles test(
            std::string("forceModels (historyForce); historyForceProps { law ") + laws[i] + "; }", water());
        test.engine().addParticle(1, Vector3d::Zero(), radius, 1e6);
        test.engine().requestMemory(test.forces().needs().memory);
        test.accelerationOf(0);
        test.fluidAt(0).velocity = {0.5, 0, 0};
        test.engine().advance(
            static_cast<int>(20 * std::exp(closures::meiAdrianLogTime(2 * radius, 0.5, 1e-6)) / 1e-5));
        slowing[i] = test.accelerationOf(0).x();
    }
    EXPECT_GT(slowing[1], 0);
    EXPECT_NEAR(slowing[0] / slowing[1], 109, 10);
}

/// It keeps numbers per particle, and asks for DU/Dt, which is not sampled otherwise. A second one would use the same numbers.
TEST(HistoryForce, AsksForMemory)
{
    EXPECT_GT(ForcesOnParticles("forceModels (historyForce);").forces().needs().memory, 3 * closures::historyModes);
    EXPECT_EQ(ForcesOnParticles("forceModels (StokesDrag);").forces().needs().memory, 0);
}

} // namespace

} // namespace clepsydra::tests
