/// \file
/// How long the rest of a run will take. No test here measures time.

#include "run/costModel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

namespace clepsydra::tests
{

namespace
{

/// Time that a coupling step takes on a machine that the model does not know.
class Machine
{
public:
    void interval(double particles, double demSteps)
    {
        seconds["DEM"] += 3e-7 * particles * demSteps;
        seconds["forces"] += 1e-7 * particles * demSteps;
        seconds["locate"] += 2e-6 * particles;
        seconds["pressure"] += 0.05;
        seconds["output"] += 0.002;
    }

    double total() const
    {
        double all = 0;
        for (const auto& [phase, time] : seconds)
        {
            all += time;
        }
        return all;
    }

    std::map<std::string, double> seconds{{"other", 100}, {"smooth", 0.5}};
};

} // namespace

/// A hundredth of a run has been done while particles came in and the coupling step became longer; then 5000 particles
/// remain, and the coupling step is four times as long as at first. What is left is known to rounding, though the start
/// took longer than all of it; by the wall time so far it would be 4 times as much, and by that without the start 1.9
/// times.
TEST(CostModel, KnowsTheRestOfARunByItsFirstIntervals)
{
    Machine machine;
    CostModel model(machine.seconds);
    for (int interval = 0; interval < 10; ++interval)
    {
        const double particles = 500.0 * interval;
        const double steps = 25 + 5 * interval;
        // A step without particles takes as long as with one.
        machine.interval(std::max(particles, 1.0), steps);
        model.add(particles, steps);
    }
    const std::map<std::string, double> soFar = machine.seconds;
    const double before = machine.total();
    for (int interval = 0; interval < 400; ++interval)
    {
        machine.interval(5000, 100);
    }
    EXPECT_EQ(model.couplingSteps(), 10);
    EXPECT_NEAR(model.secondsLeft(soFar, 5000, 40000, 400) / (machine.total() - before), 1, 1e-12);
}

} // namespace clepsydra::tests
