// Particles that leave through a floor and are inserted while water flows, by the real program.

#include "support/testCase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace clepsydra::tests
{

namespace
{

constexpr double interval = 1e-3;

/// Thirty-six particles fall in water out of a box whose floor lets them through, and not the water, which comes and goes at
/// the top. Others are inserted, one every 10 ms.
void sieve(TestCase& test, bool inserts, bool openForWater = true)
{
    test.box.upper = {0.012, 0.012, 0.024};
    test.cells = {6, 6, 12};
    if (openForWater)
    {
        test.setThroughFlow("uniform (0 0 0)");
    }
    test.dem.particles = simpleLattice(Box{{0, 0, 0}, {0.012, 0.012, 0.012}}, {3, 3, 4});
    jitter(test.dem.particles, 2e-4, 11);
    test.dem.timeStep = 4e-5;
    test.dem.dumpEvery = 25;
    // below the DEM box
    test.dem.floor = -0.01;
    test.coupling().set("particleOutlets", "(inlet)");
    test.control().set("functions/flux/type", "particleFlux").set("writeFormat", "binary").set("writePrecision", "16");
    if (inserts)
    {
        test.dem.more =
            "region upper block 0.002 0.01 0.002 0.01 0.018 0.0225 units box\n"
            "fix sphere all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius "
            "constant 0.001\n"
            "fix spheres all particledistribution/discrete 32452843 1 sphere 1.0\n"
            "fix pour all insert/rate/region seed 86028121 distributiontemplate spheres nparticles INF "
            "particlerate 100 insert_every 250 overlapcheck yes all_in yes vel constant 0. 0. -0.1 region upper\n";
    }
    test.setTimes(0.2, interval, 0.1);
}

std::vector<std::vector<double>> flux(const TestCase& test, const std::string& start = "0")
{
    return test.table("postProcessing/flux/" + start + "/flux.dat");
}

void expectBalancesToClose(TestCase& test)
{
    test.setTimes(0.1, interval, 0.1);
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const auto balances = test.conservationSummary();
    EXPECT_GT(balances["particlesInserted"], 5);
    EXPECT_GT(balances["particlesLeft"], 5);
    EXPECT_EQ(balances["particlesLost"], 0);
    EXPECT_EQ(
        balances["particlesEnd"], 36 + balances["particlesInserted"].get<int>() - balances["particlesLeft"].get<int>());
    EXPECT_LT(balances["insertionError"].get<double>(), 1e-12);
    EXPECT_LT(balances["momentumError"].get<double>(), 1e-9);
}

/// Of particleFlux's columns.
enum Column
{
    time = 0,
    insertedParticles = 1,
    leftParticles = 7,
    leftMass = 8,
    leftMomentumZ = 11,
    leftRate = 12,
};

} // namespace

// All particles leave, each counted with its mass and a momentum downwards; the balances of volume and momentum close; and
// although the floor is an outlet for particles, no water goes through it, so that what the particles leave comes in at the top. A
// program that kept the particles would lose them at the end of the DEM box, which is an error; one that took them out and
// left their volume would not close the balances.
TEST(OpenBoundaries, ParticlesFallThroughAFloorThatHoldsTheWater)
{
    TestCase test;
    sieve(test, false);
    test.control().set("functions/through",
        "{ type surfaceFieldValue; libs (\"libfieldFunctionObjects.so\"); regionType "
        "patch; name inlet; operation sum; fields (phi); writeFields no; }");
    test.setTimes(0.5, interval, 0.5);
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;

    const auto last = flux(test).back();
    EXPECT_EQ(last[leftParticles], 36);
    const double mass = 36 * 2500 * M_PI / 6 * std::pow(test.dem.diameter, 3);
    EXPECT_NEAR(last[leftMass], mass, 1e-6 * mass);
    EXPECT_LT(last[leftMomentumZ], -0.1 * mass);
    // The rate [kg/s] is that over the time since the row before, whatever the interval of the rows.
    const auto rows = flux(test);
    double left = 0;
    for (std::size_t row = 1; row < rows.size(); ++row)
    {
        const double since = rows[row][time] - rows[row - 1][time];
        EXPECT_NEAR(since * rows[row][leftRate], rows[row][leftMass] - rows[row - 1][leftMass], 1e-9 * mass);
        left += since * rows[row][leftRate];
    }
    EXPECT_NEAR(left, mass, 1e-6 * mass);
    const auto balances = test.conservationSummary();
    EXPECT_EQ(balances["particlesLeft"], 36);
    EXPECT_EQ(balances["particlesEnd"], 0);
    EXPECT_EQ(balances["particlesLost"], 0);
    EXPECT_LT(balances["insertionError"].get<double>(), 1e-12);
    EXPECT_LT(balances["momentumError"].get<double>(), 1e-9);
    EXPECT_EQ(test.layerMeans("voidFraction", "0.5").minCoeff(), 1);
    for (const auto& row : test.table("postProcessing/through/0/surfaceFieldValue.dat"))
    {
        EXPECT_NEAR(row[1], 0, 1e-20);
    }
}

// Stopped while particles are on their way in and out, and resumed, the run ends as the one that was never stopped, to the
// last bit, and goes on counting. One that forgets how far a particle has come, or counts again, differs.
TEST(OpenBoundaries, StoppedAndResumedIsNeverStopped)
{
    TestCase through;
    TestCase stopped;
    for (TestCase* test : {&through, &stopped})
    {
        sieve(*test, true);
        test->coupling().set("insertionTime", "0.02");
    }
    const Outcome whole = through.run();
    ASSERT_TRUE(whole.succeeded()) << whole.output;
    stopped.setTimes(0.1, interval, 0.1);
    const Outcome first = stopped.run();
    ASSERT_TRUE(first.succeeded()) << first.output;
    const Outcome second = stopped.runCommand("echo \"endTime 0.2;\" >> system/controlDict && $SOLVER");
    ASSERT_TRUE(second.succeeded()) << second.output;

    const auto rows = flux(through);
    const auto resumed = flux(stopped, "0.1");
    EXPECT_EQ(rows.back(), resumed.back());
    EXPECT_EQ(rows.size(), resumed.size() + 100);
    EXPECT_GT(rows.back()[insertedParticles], 15);
    EXPECT_GT(rows.back()[leftParticles], resumed.front()[leftParticles]);
    EXPECT_GT(resumed.front()[leftParticles], 0);
    EXPECT_TRUE(through.runCommand(TestCase::sameCheckpoint("0.2", stopped)).succeeded());
}

// On two ranks, cut in the middle of the outlet, the same particles leave, and the same is where they are on the way. A
// program in which each rank knows its own outlet faces only would lose particles that live on the other.
TEST(OpenBoundaries, TwoRanksAreAsOne)
{
    TestCase serial;
    TestCase parallel;
    for (TestCase* test : {&serial, &parallel})
    {
        sieve(*test, false);
        test->control().set("writeFormat", "ascii");
        test->setTimes(0.08, interval, 0.08);
    }
    const Outcome alone = serial.run();
    ASSERT_TRUE(alone.succeeded()) << alone.output;
    const Outcome together = parallel.run(2);
    ASSERT_TRUE(together.succeeded()) << together.output;
    const auto one = flux(serial).back();
    const auto two = flux(parallel).back();
    EXPECT_GT(one[leftParticles], 5);
    EXPECT_EQ(one[leftParticles], two[leftParticles]);
    EXPECT_NEAR(one[leftMomentumZ], two[leftMomentumZ], 1e-5 * std::abs(one[leftMomentumZ]));
    const double difference =
        (serial.field("voidFraction", "0.08") - parallel.field("voidFraction", "0.08")).cwiseAbs().maxCoeff();
    std::cout << "void fractions differ by " << difference << std::endl;
    EXPECT_LT(difference, 1e-6);
}

// Particles come into an open box, where water makes room for them, and go: all balances close.
TEST(OpenBoundaries, ParticlesComeAndGoInAnOpenBox)
{
    TestCase test;
    sieve(test, true);
    expectBalancesToClose(test);
}

// The same in a tank that is closed for water, whose walls are all outlets for particles. The water has no room to give or to
// fill, so that d(eps)/dt must stay out of its continuity; particles, volume and momentum are recorded as ever. Particles that lean
// on the sides, where the DEM script has walls, do not leave there.
TEST(OpenBoundaries, ParticlesComeAndGoInAClosedBox)
{
    TestCase test;
    sieve(test, true, false);
    test.coupling().set("particleOutlets", "(walls)").set("useDDTvoidfraction", "off");
    expectBalancesToClose(test);
}

} // namespace clepsydra::tests
