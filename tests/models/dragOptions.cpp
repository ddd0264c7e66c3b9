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

/// Sp of a particle of 3 mm at 0.1 m/s in water with a void fraction of .5, among others of a mean diameter of 2 mm.
double coefficientAmongOthers(const std::string& properties, double sauterMeanDiameter = 0.002)
{
    ForcesOnParticles test(properties, {1000, 1e-3, Vector3d::Zero()});
    test.engine().addParticle(1, Vector3d::Zero(), 0.0015, 2500, {0.1, 0, 0});
    test.fluidAt(0).voidFraction = 0.5;
    test.fluidAt(0).logVoidFraction = std::log(0.5);
    test.fluidAt(0).sauterMeanDiameter = sauterMeanDiameter;
    test.accelerationOf(0);
    return test.received(0).implicitCoefficientTime / test.engine().timeStep();
}

/// The values worked out by hand in polydisperseDrag.cpp of the closures' tests, through the dictionary; `factor`
/// multiplies them. An entry that is not read gives 9.0077e-4, the law with the particle's own diameter.
TEST(Polydispersity, IsReadFromTheDragLawsProperties)
{
    const std::string law = "forceModels (BeetstraDrag); BeetstraDragProps { polydispersity ";
    EXPECT_NEAR(coefficientAmongOthers(law + "Beetstra; }"), 1.069054567e-3, 1e-11);
    EXPECT_NEAR(coefficientAmongOthers(law + "BeetstraCubic; }"), 1.222998425e-3, 1e-11);
    EXPECT_NEAR(coefficientAmongOthers(law + "YinSundaresan; }"), 1.297846816e-3, 1e-11);
    EXPECT_NEAR(coefficientAmongOthers(law + "Beetstra; factor 2; }"), 2.138109134e-3, 1e-11);
}

/// Without the entry, and with `none`, the diameter of the others does not matter at all; among particles of its own
/// size, and where nothing has been sampled, the particle has the same drag with any law but the cubic one.
TEST(Polydispersity, LeavesEqualSpheresAsTheyAre)
{
    const std::string law = "forceModels (BeetstraDrag); ";
    const double plain = coefficientAmongOthers(law);
    EXPECT_EQ(coefficientAmongOthers(law, 0.003), plain);
    EXPECT_EQ(coefficientAmongOthers(law + "BeetstraDragProps { polydispersity none; }"), plain);
    for (const std::string name : {"Beetstra", "YinSundaresan"})
    {
        const std::string withOption = law + "BeetstraDragProps { polydispersity " + name + "; }";
        EXPECT_NEAR(coefficientAmongOthers(withOption, 0.003) / plain, 1, 1e-14) << name;
        EXPECT_NEAR(coefficientAmongOthers(withOption, 0) / plain, 1, 1e-14) << name;
        EXPECT_GT(std::abs(coefficientAmongOthers(withOption, 0.002) / plain - 1), 0.1) << name;
    }
}

/// A name that is not known is refused with those that are; a law of isolated particles takes no mixture.
TEST(Polydispersity, RefusesWhatItCannotUse)
{
    const auto error = [](const std::string& properties) {
        return errorOf([&] { ForcesOnParticles test(properties); });
    };
    EXPECT_NE(error("forceModels (RongDrag); RongDragProps { polydispersity Bestra; }").find("BeetstraCubic"),
        std::string::npos);
    for (const std::string law : {"StokesDrag", "SchillerNaumannDrag", "BrownLawlerDrag", "MorrisonDrag"})
    {
        EXPECT_NE(error("forceModels (" + law + "); " + law + "Props { polydispersity Beetstra; }").find("isolated"),
            std::string::npos)
            << law;
    }
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
