// How often all ranks wait for each other in a coupling step. On one rank the same reductions are made as on many, so they can
// be counted here; that there are no others is what tests/scripts/collective_tests.py shows.

#include "conservation/faults.h"

#include "rankTotals.h"

namespace clepsydra::tests
{

namespace
{

/// In each of some coupling steps after the first one.
std::vector<long> reductionsOfSteps(const StreamSetup& setup)
{
    Stream stream(setup);
    const auto asItIs = [](const fvVectorMatrix&) {};
    stream.advance(asItIs, setup.demStepsPerCouplingStep);
    std::vector<long> counts;
    for (int step = 0; step < 5; ++step)
    {
        const long before = RankTotals::reductions();
        stream.advance(asItIs, setup.demStepsPerCouplingStep);
        counts.push_back(RankTotals::reductions() - before);
    }
    return counts;
}

} // namespace

// All checks and balances of a coupling step, the plan of the exchange and the cells to be smoothed: one reduction after
// the particles have been distributed, and one at the end. When each number was reduced by itself there were about thirty.
TEST(Reductions, AreTwoInACouplingStep)
{
    EXPECT_EQ(reductionsOfSteps(StreamSetup()), std::vector<long>(5, 2));
}

// The length of the next coupling step is needed before the particles are distributed: one more, for its two limits.
TEST(Reductions, AreThreeInAnAdjustableCouplingStep)
{
    StreamSetup setup;
    setup.adjustable = true;
    EXPECT_EQ(reductionsOfSteps(setup), std::vector<long>(5, 3));
}

// A particle that leaves the box which its rank has published makes a new plan necessary: the step is distributed again. What
// was wrong in it is found all the same, although no total of the first attempt has been used.
TEST(Reductions, AreRepeatedWhereParticlesLeaveThePlan)
{
    Stream stream{StreamSetup()};
    const auto reductionsOfStep = [&] {
        const long before = RankTotals::reductions();
        stream.advance([](const fvVectorMatrix&) {});
        return RankTotals::reductions() - before;
    };
    reductionsOfStep();
    EXPECT_EQ(reductionsOfStep(), 2);
    stream.engine().moveParticle(1, Vector3d(0.94, 0.25, 0.25));
    EXPECT_GT(reductionsOfStep(), 2);
    EXPECT_EQ(reductionsOfStep(), 2);

    stream.engine().moveParticle(1, Vector3d(0.25, 0.94, 0.25));
    stream.engine().removeParticle(2);
    EXPECT_THAT(errorOf(reductionsOfStep), testing::HasSubstr("1 of 8 particles were lost"));
}

// What is wrong in the DEM steps, in the cells and in the fluid's equation is found in this order, although the first two are
// reduced together: the particles' own loss comes before the error of the volume that follows from it.
TEST(Reductions, ReportALostParticleBeforeTheVolumeThatItTakes)
{
    StreamSetup setup;
    Stream stream(setup);
    stream.advance([](const fvVectorMatrix&) {});
    stream.engine().removeParticle(1);
    const std::string error = errorOf([&] { stream.advance([](const fvVectorMatrix&) {}); });
    EXPECT_THAT(error, testing::HasSubstr("1 of 8 particles were lost"));
    EXPECT_THAT(error, testing::Not(testing::HasSubstr("solidVolumeTolerance")));
}

} // namespace clepsydra::tests
