/// \file
/// The quick hopper, smaller still: poured, drained dry and under water.

#include "quickHopper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

namespace
{

using namespace clepsydra::tests;

constexpr int beadCount = 300;

/// What five packings (seeds 100003 to 100057) gave. Another compiler's rounding gives another packing.
struct Packings
{
    double mean;
    double deviation;

    /// Three standard deviations of the difference between one packing more and the mean of five.
    double allowed() const
    {
        return 3 * deviation * std::sqrt(1 + 1.0 / 5);
    }
};

constexpr Packings dryRate{7.00, 0.30};       // g/s
constexpr Packings submergedRate{4.76, 0.39}; // g/s
constexpr Packings ratioOfRates{0.680, 0.056};

/// Mean rate [g/s] while the hopper empties from `upper` to `lower` of its fill; 0 if it does not empty so far.
double meanRate(const std::vector<std::vector<double>>& massInHopper, double upper, double lower)
{
    const double fill = massInHopper.front()[1];
    const auto below = [&](double part) {
        return std::find_if(massInHopper.begin(), massInHopper.end(),
            [&](const std::vector<double>& row) { return row[1] < part * fill; });
    };
    const auto first = below(upper);
    const auto last = below(lower);
    return last == massInHopper.end() ? 0 : 1e3 * ((*first)[1] - (*last)[1]) / ((*last)[0] - (*first)[0]);
}

/// Every bead is found again, in the hopper or in the tank, and massInHopper counts those that a look at the drawn
/// beads finds inside.
void expectAllBeadsAccountedFor(const QuickHopper& hopper, const std::string& stage)
{
    SCOPED_TRACE(stage);
    const double radius = 0.5 * hopper.parameter("beadDiameter");
    std::set<int> ids;
    int inside = 0;
    int outside = 0;
    for (const DrawnBead& bead : hopper.lastBeads(stage))
    {
        ids.insert(bead.id);
        const double fromAxis = bead.position.head<2>().norm();
        const double z = bead.position.z();
        if (z > 0 && z < hopper.parameter("hopperHeight") && fromAxis < 0.5 * hopper.parameter("hopperDiameter"))
        {
            ++inside;
        }
        // Contacts are soft: a bead may sink into a wall a little.
        else if (z > -hopper.parameter("tankDepth") + 0.9 * radius && z < 0
                 && fromAxis < 0.5 * hopper.parameter("tankDiameter") - 0.9 * radius)
        {
            ++outside;
        }
    }
    EXPECT_EQ(ids.size(), static_cast<std::size_t>(beadCount));
    EXPECT_EQ(inside, static_cast<int>(hopper.table(stage, "massInHopper/0/massInHopper.dat").back()[2]));
    EXPECT_EQ(inside + outside, beadCount);
    std::cout << stage << ": " << inside << " beads in the hopper, " << outside << " in the tank" << std::endl;
}

/// 300 beads, one packing, both media: the beads flow, water slows them, none gets lost, and the books of solid volume
/// and momentum close to rounding. A program that moved no beads would have no rate; one without the fluid's forces
/// the same rate in both media, one with buoyancy alone .78 of it; one that lost beads or part of their volume or momentum
/// would miss the counts.
TEST(SmallHopper, EveryBeadIsAccountedFor)
{
    QuickHopper hopper({{"beadCount", std::to_string(beadCount)}, {"hopperDiameter", "0.015"},
        {"orificeDiameter", "0.009"}, {"hopperHeight", "0.04"}, {"tankDiameter", "0.04"}, {"tankDepth", "0.025"},
        {"waterAboveRim", "0.01"}, {"pourTime", "0.8"}, {"dryTime", "1.5"}, {"submergedTime", "2"}});
    const Outcome poured = hopper.pour();
    ASSERT_TRUE(poured.succeeded()) << poured.output;
    std::map<std::string, double> rate;
    for (const std::string stage : {"dry", "submerged"})
    {
        const Outcome drained = hopper.run(stage);
        ASSERT_TRUE(drained.succeeded()) << drained.output;
        const auto massInHopper = hopper.table(stage, "massInHopper/0/massInHopper.dat");
        rate[stage] = meanRate(massInHopper, 0.95, 0.6);
        std::cout << stage << ": " << rate[stage] << " g/s, " << massInHopper.back()[0] << " s simulated in "
                  << drained.wallSeconds << " s" << std::endl;
        expectAllBeadsAccountedFor(hopper, stage);

        const nlohmann::json books = hopper.ledger(stage);
        EXPECT_EQ(books["beadsStart"], beadCount);
        EXPECT_EQ(books["beadsEnd"], beadCount);
        EXPECT_EQ(books["beadsLost"], 0);
        const auto volumeError = books["solidVolumeError"].get<double>();
        const auto momentumError = books["momentumError"].get<double>();
        std::cout << stage << ": errors of solid volume " << volumeError << ", of momentum " << momentumError
                  << std::endl;
        EXPECT_LT(std::abs(volumeError), 1e-12);
        EXPECT_LT(std::abs(momentumError), 1e-9);
    }
    std::cout << "pour " << poured.wallSeconds << " s, submerged/dry " << rate["submerged"] / rate["dry"] << std::endl;
    EXPECT_NEAR(rate["dry"], dryRate.mean, dryRate.allowed());
    EXPECT_NEAR(rate["submerged"], submergedRate.mean, submergedRate.allowed());
    EXPECT_NEAR(rate["submerged"] / rate["dry"], ratioOfRates.mean, ratioOfRates.allowed());
}

/// The softest beads that scripts/rules/hopper.py allows. LIGGGHTS refuses beads of less than 5 MPa unless it is told.
TEST(SmallHopper, BeadsMayBeAsSoftAsTheRulesSay)
{
    QuickHopper hopper({{"beadCount", "20"}, {"youngsModulus", "1e5"}, {"pourDuration", "0.04"}, {"pourTime", "0.06"}});
    const Outcome poured = hopper.pour();
    EXPECT_TRUE(poured.succeeded()) << poured.output;
}

} // namespace
