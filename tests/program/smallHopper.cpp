/// \file
/// The quick hopper, smaller still: filled, discharged dry and under water.

#include "quickHopper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

namespace
{

using namespace clepsydra::tests;

constexpr int particleCount = 300;

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

/// Every particle is found again, in the hopper or in the tank, and massInHopper counts those that a look at the drawn
/// particles finds inside.
void expectAllParticlesAccountedFor(const QuickHopper& hopper, const std::string& step)
{
    SCOPED_TRACE(step);
    const double radius = 0.5 * hopper.parameter("particleDiameter");
    std::set<int> ids;
    int inside = 0;
    int outside = 0;
    for (const DrawnParticle& particle : hopper.lastParticles(step))
    {
        ids.insert(particle.id);
        const double fromAxis = particle.position.head<2>().norm();
        const double z = particle.position.z();
        if (z > 0 && z < hopper.parameter("hopperHeight") && fromAxis < 0.5 * hopper.parameter("hopperDiameter"))
        {
            ++inside;
        }
        // Contacts are soft: a particle may sink into a wall a little.
        else if (z > -hopper.parameter("tankDepth") + 0.9 * radius && z < 0
                 && fromAxis < 0.5 * hopper.parameter("tankDiameter") - 0.9 * radius)
        {
            ++outside;
        }
    }
    EXPECT_EQ(ids.size(), static_cast<std::size_t>(particleCount));
    EXPECT_EQ(inside, static_cast<int>(hopper.table(step, "massInHopper/0/massInHopper.dat").back()[2]));
    EXPECT_EQ(inside + outside, particleCount);
    std::cout << step << ": " << inside << " particles in the hopper, " << outside << " in the tank" << std::endl;
}

/// 300 particles, one packing, both media: the particles flow, water slows them, none gets lost, and the balances of solid volume
/// and momentum close to rounding. A program that moved no particles would have no rate; one without the fluid's forces
/// the same rate in both media, one with buoyancy alone .78 of it; one that lost particles or part of their volume or momentum
/// would miss the counts.
TEST(SmallHopper, EveryParticleIsAccountedFor)
{
    QuickHopper hopper({{"particleCount", std::to_string(particleCount)}, {"hopperDiameter", "0.015"},
        {"orificeDiameter", "0.009"}, {"hopperHeight", "0.04"}, {"tankDiameter", "0.04"}, {"tankDepth", "0.025"},
        {"waterAboveRim", "0.01"}, {"fillingTime", "0.8"}, {"dryTime", "1.5"}, {"submergedTime", "2"}});
    const Outcome filled = hopper.filling();
    ASSERT_TRUE(filled.succeeded()) << filled.output;
    std::map<std::string, double> rate;
    for (const std::string step : {"dry", "submerged"})
    {
        const Outcome discharged = hopper.run(step);
        ASSERT_TRUE(discharged.succeeded()) << discharged.output;
        const auto massInHopper = hopper.table(step, "massInHopper/0/massInHopper.dat");
        rate[step] = meanRate(massInHopper, 0.95, 0.6);
        std::cout << step << ": " << rate[step] << " g/s, " << massInHopper.back()[0] << " s simulated in "
                  << discharged.wallSeconds << " s" << std::endl;
        expectAllParticlesAccountedFor(hopper, step);

        const nlohmann::json balances = hopper.conservation(step);
        EXPECT_EQ(balances["particlesStart"], particleCount);
        EXPECT_EQ(balances["particlesEnd"], particleCount);
        EXPECT_EQ(balances["particlesLost"], 0);
        const auto volumeError = balances["solidVolumeError"].get<double>();
        const auto momentumError = balances["momentumError"].get<double>();
        std::cout << step << ": errors of solid volume " << volumeError << ", of momentum " << momentumError
                  << std::endl;
        EXPECT_LT(std::abs(volumeError), 1e-12);
        EXPECT_LT(std::abs(momentumError), 1e-9);
    }
    std::cout << "filling " << filled.wallSeconds << " s, submerged/dry " << rate["submerged"] / rate["dry"]
              << std::endl;
    EXPECT_NEAR(rate["dry"], dryRate.mean, dryRate.allowed());
    EXPECT_NEAR(rate["submerged"], submergedRate.mean, submergedRate.allowed());
    EXPECT_NEAR(rate["submerged"] / rate["dry"], ratioOfRates.mean, ratioOfRates.allowed());
}

/// The softest particles that parameters.rules of the case allows. LIGGGHTS alone refuses particles of less than 5 MPa.
TEST(SmallHopper, ParticlesMayBeAsSoftAsTheRulesSay)
{
    QuickHopper hopper(
        {{"particleCount", "20"}, {"youngsModulus", "1e5"}, {"fillingDuration", "0.04"}, {"fillingTime", "0.06"}});
    const Outcome filled = hopper.filling();
    EXPECT_TRUE(filled.succeeded()) << filled.output;
}

} // namespace
