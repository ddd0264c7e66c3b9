/// \file
/// Drag laws with `factor` and with `wallCorrection`.

#include "closures/wallCorrection.h"
#include "forcesOnParticles.h"
#include "support/errorOf.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clepsydra::tests
{

namespace
{

constexpr double radius = 1e-3;

Vector3d dragOn(const std::string& properties, const Vector3d& position, const Vector3d& velocity)
{
    ForcesOnParticles test(properties, {1000, 1e-3, Vector3d::Zero()});
    test.engine().addParticle(1, position, radius, 2500, velocity);
    Vector3d force = 2500 * sphereVolume(radius) * test.accelerationOf(0);
    EXPECT_LT((test.received(0).impulse - test.engine().timeStep() * force).norm(), 1e-14 * force.norm());
    return force;
}

/// `factor` multiplies the drag, also of a law whose properties are found by a pattern, as the hopper's case writes them.
/// A factor that is not read leaves 1.
TEST(DragFactor, MultipliesTheDrag)
{
    const Vector3d velocity(0.01, 0, -0.01);
    const Vector3d plain = dragOn("forceModels (DiFeliceDrag);", Vector3d::Zero(), velocity);
    const Vector3d larger =
        dragOn("forceModels (DiFeliceDrag); \".*DragProps\" { factor 1.25; }", Vector3d::Zero(), velocity);
    EXPECT_LT((larger - 1.25 * plain).norm(), 1e-10 * plain.norm());
    EXPECT_THROW(ForcesOnParticles("forceModels (StokesDrag); StokesDragProps { factor -1; }"), Foam::IOerror);
}

/// Half a diameter above a plane's surface (lambda = .5) Stokes' drag of 1.884956e-5 * .01 N grows 1.386 times along the
/// plane and 2.125 times towards it. One factor for both directions fails.
TEST(WallCorrection, OfAPlaneDependsOnTheDirection)
{
    const Vector3d force = dragOn("forceModels (StokesDrag); StokesDragProps { wallCorrection"
                                  " { law Faxen; walls ( ((0 0 1) (0 0 3)) ); } }",
        {0.2, 0.3, 1 + 2 * radius}, {0.01, 0, -0.01});
    EXPECT_NEAR(force.x(), -1.884956e-7 * 1.3861252, 1e-13);
    EXPECT_NEAR(force.z(), 1.884956e-7 * 2.125, 1e-13);
}

/// Halfway between two planes five diameters apart each of them adds its part (Oseen), and the sum is within 1 % of what
/// Faxen found for two walls together, 1/(1 - 1.004 L + 0.418 L^3 + 0.21 L^4 - 0.169 L^5) with L = radius/distance = 0.2. A
/// correction that takes one of the planes only is 11 % short. Which plane is named first does not matter.
TEST(WallCorrection, OfTwoPlanesIsTheSumOfBoth)
{
    const std::string below = "((0 0 0) (0 0 1))";
    const std::string above = "((0 0 0.01) (0 0 -1))";
    const auto factorBetween = [&](const std::string& planes, const Vector3d& velocity) {
        const Vector3d force = dragOn(
            "forceModels (StokesDrag); StokesDragProps { wallCorrection { law Faxen; walls ( " + planes + " ); } }",
            {0, 0, 5 * radius}, velocity);
        return force.norm() / (1.884956e-5 * velocity.norm());
    };
    const Vector3d along(0.01, 0, 0);
    const double L = 0.2;
    const double faxen = 1 / (1 - 1.004 * L + 0.418 * std::pow(L, 3) + 0.21 * std::pow(L, 4) - 0.169 * std::pow(L, 5));
    EXPECT_NEAR(factorBetween(below + above, along) / faxen, 1, 0.02);
    for (const Vector3d& velocity : {along, Vector3d(0, 0, 0.01)})
    {
        const double one = factorBetween(below, velocity);
        EXPECT_GT(one, 1.1);
        EXPECT_NEAR(factorBetween(above, velocity), one, 1e-6) << "the particle is halfway";
        EXPECT_NEAR(factorBetween(below + above, velocity), 2 * one - 1, 1e-6);
        EXPECT_NEAR(factorBetween(above + below, velocity), 2 * one - 1, 1e-6);
    }
}

/// In a tube the particle at speed k v has the drag of the free particle at v: it settles k times as fast. Here d/D = .2,
/// Re = 200 at k v. The correction as a factor on the drag coefficient at the same speed fails.
TEST(WallCorrection, OfATubeSlowsTheParticleByDiFelicesRatio)
{
    const double freeSpeed = 0.2;
    const double ratio = closures::diFeliceWallVelocityRatio(0.2, 400);
    const double inTube = dragOn("forceModels (SchillerNaumannDrag); SchillerNaumannDragProps"
                                 " { wallCorrection { law DiFelice1996; tubeDiameter 0.01; } }",
        Vector3d::Zero(), {0, 0, -ratio * freeSpeed})
                              .z();
    const double free = dragOn("forceModels (SchillerNaumannDrag);", Vector3d::Zero(), {0, 0, -freeSpeed}).z();
    EXPECT_NEAR(inTube / free, 1, 1e-5);
    EXPECT_NEAR(ratio, 0.868586, 1e-6);
}

/// A normal that points away from the particles is an error that names the plane. Taken for a wall that the particle touches it
/// gives 3.1 times the drag, wherever the particle is.
TEST(WallCorrection, RefusesAPlaneThatTheParticleIsBehind)
{
    ForcesOnParticles test(
        "forceModels (StokesDrag); StokesDragProps { wallCorrection { law Faxen; walls ( ((0 0 1) (0 0 -1)) ); } }");
    test.engine().addParticle(1, {0, 0, 2}, radius);
    EXPECT_NE(errorOf([&] { test.engine().advance(1); }).find("plane through (0 0 1)"), std::string::npos);
}

/// A mistake in the entry is refused, a tube without the law that it is for, too.
TEST(WallCorrection, RefusesWhatItCannotUse)
{
    for (const std::string entry : {"law Oseen;", "tubeDiameter 0.094;", "law DiFelice1996;",
             "law DiFelice1996; tubeDiameter -1;", "law Faxen;", "law Faxen; walls ( ((0 0 0) (0 0 0)) );"})
    {
        EXPECT_THROW(
            ForcesOnParticles("forceModels (StokesDrag); StokesDragProps { wallCorrection { " + entry + " } }"),
            Foam::IOerror)
            << entry;
    }
}

} // namespace

} // namespace clepsydra::tests
