/// \file
/// Coupling steps that follow the Courant numbers.

#include "support/testCase.h"
#include "tokens/exactText.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <numeric>

namespace
{

using clepsydra::exactText;
using namespace clepsydra::tests;

constexpr double demStep = 4e-5;
constexpr double largestCourantNumber = 0.02;
constexpr double smoothingBandwidth = 6e-3;
constexpr int longest = 100; // DEM steps
constexpr int writeSteps = 500;
constexpr int endSteps = 1260;

/// Particles that begin to sink: slow at first, then faster and faster.
void fillIn(TestCase& test)
{
    test.box.upper = {0.02, 0.02, 0.04};
    test.cells = {8, 8, 16};
    test.setTimes(endSteps * demStep, 1e-3, writeSteps * demStep);
    Box cloud;
    cloud.lower = {0.003, 0.004, 0.02};
    cloud.upper = {0.017, 0.016, 0.036};
    test.dem.particles = simpleLattice(cloud, {4, 4, 3});
    test.dem.timeStep = demStep;
    test.dem.dumpEvery = endSteps;
    test.coupling()
        .set("constDiffSmoothingProps/bandwidth", exactText(smoothingBandwidth))
        .set("adjustableCouplingTimeStep", "yes")
        .set("maxCo", exactText(largestCourantNumber))
        .set("minCouplingTimeStep", exactText(demStep))
        .set("maxCouplingTimeStep", exactText(longest * demStep));
    test.control().set("functions/massInHopper/type", "massInHopper").set("functions/massInHopper/patch", "walls");
}

/// Ends of the coupling steps in DEM steps, each of which is a row of m(t). The first is 0.
std::vector<long> ends(const TestCase& test)
{
    std::vector<long> steps;
    for (const auto& row : test.table("postProcessing/massInHopper/0/massInHopper.dat"))
    {
        const double step = row[0] / demStep;
        steps.push_back(std::lround(step));
        EXPECT_NEAR(step, static_cast<double>(steps.back()), 1e-6) << "not a whole number of DEM steps";
    }
    return steps;
}

/// The coupling step grows while the particles are slow and shrinks as they get faster; write times and the end are hit
/// to the DEM step, no coupling step is longer than allowed or more than a fifth (or one step) longer than the one
/// before, and momentum is conserved. On two ranks the coupling steps are the same. A constant coupling step would
/// neither grow nor keep the limit; one that does not look ahead would write at other times.
TEST(AdjustableCouplingTimeStep, FollowsTheParticles)
{
    TestCase test;
    TestCase parallel;
    fillIn(test);
    fillIn(parallel);
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const Outcome together = parallel.run(2);
    ASSERT_TRUE(together.succeeded()) << together.output;

    const std::vector<long> end = ends(test);
    std::vector<long> length;
    std::adjacent_difference(end.begin(), end.end(), std::back_inserter(length));
    length.erase(length.begin());
    EXPECT_EQ(length.front(), 25);
    for (std::size_t i = 1; i < length.size(); ++i)
    {
        EXPECT_GE(length[i], 1);
        EXPECT_LE(length[i], length[i - 1] + std::max(1l, length[i - 1] / 5)) << "coupling step " << i;
    }
    const long most = *std::max_element(length.begin(), length.end());
    EXPECT_GT(most, 45);
    EXPECT_LE(most, longest);
    EXPECT_LT(length.back(), most / 2);
    EXPECT_EQ(end.back(), endSteps);
    EXPECT_TRUE(std::count(end.begin(), end.end(), writeSteps));
    EXPECT_TRUE(std::count(end.begin(), end.end(), 2 * writeSteps));
    EXPECT_EQ(test.times(), std::vector<std::string>({"0.02", "0.04", "0.0504"}));

    const double fastest = test.particleHistory().back().velocity.colwise().norm().maxCoeff();
    const double courant = fastest * static_cast<double>(length.back()) * demStep / smoothingBandwidth;
    std::cout << length.size() << " intervals of up to " << most << " DEM steps, the last of " << length.back()
              << " with a Courant number of " << courant << std::endl;
    EXPECT_LT(courant, 1.05 * largestCourantNumber);
    EXPECT_LT(test.conservationSummary()["momentumError"].get<double>(), 1e-12);
    EXPECT_EQ(ends(parallel), end);
}

} // namespace
