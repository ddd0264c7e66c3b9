/// \file
/// lubricationForce between particles of the fake engine and at a wall.

#include "closures/wallCorrection.h"
#include "forcesOnParticles.h"
#include "support/errorOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace clepsydra::tests
{

namespace
{

constexpr double radius = 1e-3;
const FluidProperties weightlessWater{1000, 1e-3, {0, 0, 0}};

/// Two particles of 2 mm, 10 um apart, approaching by 2 cm/s, reach 0.05 (R1 + R2) = 100 um: 4.241150e-4 kg/s * .02 m/s
/// push them apart, along the line between them only, equal and opposite, and the fluid is given nothing. The third
/// particle, beyond the reach, feels nothing.
TEST(Lubrication, PushesApproachingParticlesApart)
{
    ForcesOnParticles test(
        "forceModels (lubricationForce); lubricationForceProps { roughness 1e-6; reach 0.05; }", weightlessWater);
    EXPECT_EQ(test.forces().needs().pairReach, 0.05);
    test.engine().requestPairs(0.05, submergedFractionInState);
    test.engine().addParticle(1, {0, 0, 0}, radius, 2500, {0.01, 0.003, 0});
    test.engine().addParticle(2, {2.01e-3, 0, 0}, radius, 2500, {-0.01, 0.007, 0});
    test.engine().addParticle(3, {0, 2.101e-3, 0}, radius, 2500, {0, -1, 0});
    const Eigen::Matrix3Xd before = test.engine().particles().velocity;
    test.engine().advance(1);
    const Eigen::Matrix3Xd force =
        (test.engine().particles().velocity - before) * 2500 * sphereVolume(radius) / test.engine().timeStep();
    EXPECT_NEAR(force(0, 0), -8.482300e-6, 1e-11);
    EXPECT_LT((force.col(0) + force.col(1)).norm(), 1e-16);
    EXPECT_NEAR(force(1, 0), 0, 1e-16);
    EXPECT_NEAR(force.col(2).norm(), 0, 1e-20);
    EXPECT_EQ(test.received(0).impulse.norm(), 0);
}

/// At a wall: 10 um above it, reach 0.05*2 R = 100 um, sinking by 1 cm/s: 1.698360e-3*.01 upwards; sliding costs nothing.
TEST(Lubrication, SlowsTheApproachToAWall)
{
    ForcesOnParticles test("forceModels (lubricationForce); lubricationForceProps"
                           " { roughness 1e-6; reach 0.05; walls ( ((5 5 0.1) (0 0 2)) ); }",
        weightlessWater);
    test.engine().addParticle(1, {0, 0, 0.1 + radius + 1e-5}, radius, 2500, {0.3, 0, -0.01});
    const Vector3d force = 2500 * sphereVolume(radius) * test.accelerationOf(0);
    EXPECT_NEAR(force.z(), 1.698360e-5, 1e-10);
    EXPECT_NEAR(force.x(), 0, 1e-16);
}

/// Stokes' drag with the wall felt from afar is Brenner's at every gap; so it is with a wallCorrection that goes as near as
/// a fifth of a radius, and from there on lubrication at its default reach: neither a gap between the two nor an overlap.
/// Faxen's series in place of Brenner's factor is 19 % low at half a radius, and lubrication on top of it 30 % high at a
/// tenth.
TEST(Lubrication, AndStokesDragAreBrennersFromAfarToTheTouch)
{
    const std::string walls = "walls ( ((0 0 0) (0 0 1)) );";
    const std::string fromAfar = "forceModels (StokesDrag lubricationForce); lubricationForceProps"
                                 " { roughness 1e-8; wallReach 1e6; "
                                 + walls + " }";
    const std::string inTwo = "forceModels (StokesDrag lubricationForce); lubricationForceProps { roughness 1e-8; "
                              + walls + " } StokesDragProps { wallCorrection { law Faxen; " + walls + " } }";
    for (const double gap : {0.01, 0.1, 0.199, 0.201, 0.5, 1.0, 5.0})
    {
        const double expected = 0.01 * 1.884955592e-5 * closures::brennerPerpendicularFactor(gap);
        for (const std::string& properties : {fromAfar, inTwo})
        {
            ForcesOnParticles test(properties, weightlessWater);
            test.engine().addParticle(1, {0, 0, (1 + gap) * radius}, radius, 2500, {0, 0, -0.01});
            const double force = 2500 * sphereVolume(radius) * test.accelerationOf(0).z();
            EXPECT_NEAR(force / expected, 1, 1e-5) << gap << ' ' << properties;
        }
    }
}

/// The reach at walls is not that between particles, whose neighbour lists must not grow with it.
TEST(Lubrication, HasAReachOfItsOwnAtWalls)
{
    const std::string begin = "forceModels (lubricationForce); lubricationForceProps { roughness 1e-6; ";
    const auto forceAt = [&](double gap, const std::string& reach) {
        ForcesOnParticles test(begin + reach + " walls ( ((0 0 0) (0 0 1)) ); }", weightlessWater);
        EXPECT_EQ(test.forces().needs().pairReach, 0.05);
        test.engine().addParticle(1, {0, 0, radius + gap}, radius, 2500, {0, 0, -0.01});
        return test.accelerationOf(0).z();
    };
    EXPECT_EQ(forceAt(1.1e-4, "reach 0.05;"), 0);
    EXPECT_GT(forceAt(1.1e-4, "reach 0.05; wallReach 1;"), 0);
    EXPECT_GT(forceAt(1.9e-3, "reach 0.05; wallReach 1;"), 0);
    EXPECT_EQ(forceAt(2.1e-3, "reach 0.05; wallReach 1;"), 0);
    EXPECT_THROW(ForcesOnParticles(begin + "wallReach 0; }"), Foam::IOerror);
}

/// A roughness above the reach was accepted, and the force was zero everywhere.
TEST(Lubrication, RefusesARoughnessAboveItsReach)
{
    const auto errorWith = [](const std::string& properties) {
        ForcesOnParticles test("forceModels (lubricationForce); lubricationForceProps { roughness 1e-4; " + properties
                                   + "walls ( ((0 0 0) (0 0 1)) ); }",
            weightlessWater);
        test.engine().requestPairs(0.1, submergedFractionInState);
        test.engine().addParticle(1, {0, 0, 1.05 * radius}, radius, 2500, {0, 0, -0.01});
        test.engine().addParticle(2, {0, 0, 3.07 * radius}, radius, 2500, {0, 0, -0.01});
        return errorOf([&] { test.engine().advance(1); });
    };
    EXPECT_THAT(errorWith("reach 0.04; wallReach 1; "), testing::HasSubstr("larger reach"));
    EXPECT_THAT(errorWith("reach 0.1; wallReach 0.04; "), testing::HasSubstr("larger wallReach"));
    EXPECT_EQ(errorWith("reach 0.06; "), "");
}

/// Where there is no fluid there is no film. A wall's force is that of SlowsTheApproachToAWall times the part of the particle in
/// the fluid; two particles have that of PushesApproachingParticlesApart times the smaller part, so that it stays equal and
/// opposite. A particle out of the fluid may be as smooth as it likes.
TEST(Lubrication, IsInTheFluidOnly)
{
    for (const double part : {0.0, 0.3})
    {
        ForcesOnParticles atWall("forceModels (lubricationForce); lubricationForceProps"
                                 " { roughness 1e-6; reach 0.05; walls ( ((5 5 0.1) (0 0 2)) ); }",
            weightlessWater);
        atWall.engine().addParticle(1, {0, 0, 0.1 + radius + 1e-5}, radius, 2500, {0, 0, -0.01});
        atWall.fluidAt(0).submergedFraction = part;
        EXPECT_NEAR(2500 * sphereVolume(radius) * atWall.accelerationOf(0).z(), part * 1.698360e-5, 1e-10);

        ForcesOnParticles pair(
            "forceModels (lubricationForce); lubricationForceProps { roughness 1e-6; reach 0.05; }", weightlessWater);
        pair.engine().requestPairs(0.05, submergedFractionInState);
        pair.engine().addParticle(1, {0, 0, 0}, radius, 2500, {0.01, 0, 0});
        pair.engine().addParticle(2, {2.01e-3, 0, 0}, radius, 2500, {-0.01, 0, 0});
        pair.fluidAt(0).submergedFraction = 0.7;
        pair.fluidAt(1).submergedFraction = part;
        const Eigen::Matrix3Xd before = pair.engine().particles().velocity;
        pair.engine().advance(1);
        const Eigen::Matrix3Xd force =
            (pair.engine().particles().velocity - before) * 2500 * sphereVolume(radius) / pair.engine().timeStep();
        EXPECT_NEAR(force(0, 0), part * -8.482300e-6, 1e-11);
        EXPECT_LT((force.col(0) + force.col(1)).norm(), 1e-16);
    }
    ForcesOnParticles smooth(
        "forceModels (lubricationForce); lubricationForceProps { roughness 1e-9; walls ( ((0 0 0) (0 0 1)) ); }",
        weightlessWater);
    smooth.engine().addParticle(1, {0, 0, radius}, radius, 2500, {0, 0, -0.01});
    smooth.fluidAt(0).submergedFraction = 0;
    EXPECT_NO_THROW(smooth.engine().advance(1));
}

/// A step that is too long for so smooth a particle is an error with the longest step: m/c = 1.047198e-5/1.884956e-8*1e-9 =
/// .56 us here. Left alone the particle would bounce off the squeezed film with more than it brought.
TEST(Lubrication, RefusesAStepThatItCannotDamp)
{
    ForcesOnParticles test(
        "forceModels (lubricationForce); lubricationForceProps { roughness 1e-9; walls ( ((0 0 0) (0 0 1)) ); }",
        weightlessWater);
    test.engine().addParticle(1, {0, 0, radius}, radius, 2500, {0, 0, -0.01});
    try
    {
        test.engine().advance(1);
        FAIL() << "the step was taken";
    }
    catch (const Foam::error& error)
    {
        EXPECT_NE(error.message().find("steps up to 2.77"), std::string::npos) << error.message();
    }
}

/// A large particle could take the step, the small one beside it could not, in whichever order they are listed. A look at the
/// first one only takes the step in one order.
TEST(Lubrication, RefusesAStepThatTheSmallerOfTwoParticlesCannotTake)
{
    for (const double first : {radius, 0.1 * radius})
    {
        const double second = 1.1 * radius - first;
        ForcesOnParticles test(
            "forceModels (lubricationForce); lubricationForceProps { roughness 1e-9; }", weightlessWater);
        test.engine().requestPairs(0.1, submergedFractionInState);
        test.engine().addParticle(1, {0, 0, 0}, first);
        test.engine().addParticle(2, {1.1 * radius, 0, 0}, second);
        EXPECT_THROW(test.engine().advance(1), Foam::error) << first;
    }
}

/// The roughness has no default: results depend on it.
TEST(Lubrication, AsksForARoughness)
{
    EXPECT_THROW(ForcesOnParticles("forceModels (lubricationForce);"), Foam::IOerror);
}

} // namespace

} // namespace clepsydra::tests
