#include "surrogate/surrogate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

namespace clepsydra::identification::tests
{

namespace
{

constexpr double gravity = 9.81;
constexpr double water = 1000.0;
constexpr double step = 0.05;          // [s]
constexpr double longest = 400.0;      // [s]
constexpr double memoryOfNoise = 0.08; // correlation length of the rate, as a share of the fill

using Numbers = Expression::Variables;

double terminalVelocity(const Numbers& p)
{
    const double d = p.at("particleDiameter");
    double speed = 0.1;
    for (int i = 0; i < 60; ++i)
    {
        const double reynolds = speed * d / p.at("fluidViscosity");
        const double drag = p.at("dragFactor") * 24.0 / reynolds * (1.0 + 0.15 * std::pow(reynolds, 0.687));
        const double next = std::sqrt(4.0 / 3.0 * gravity * d * (p.at("particleDensity") / water - 1.0) / drag);
        speed = std::sqrt(speed * next);
    }
    return speed;
}

/// Rate of the steady flow out of a full hopper.
double steadyRate(const Numbers& p)
{
    const double d = p.at("particleDiameter");
    const double orifice = p.at("orificeDiameter");
    const double density = p.at("particleDensity");
    const bool wet = p.at("submerged") > 0.5;
    const double relative = std::pow(2e-3 / d, 2);
    const double friction = (wet ? 0.38 : 0.25) * (1.0 - std::exp(-p.at("friction") / 0.3));
    double rate = (1.0 - friction) * (1.0 - 1.2 * p.at("rollingFriction"));
    rate *= 1.0 - 0.05 * p.at("cohesion") * (wet ? 0.0 : std::min(relative, 3.0));
    if (!wet)
    {
        rate *= 1.0 - p.at("airDrag") * std::min(relative, 4.0);
        return rate * 0.7 * density * std::sqrt(gravity) * std::pow(std::max(orifice - 1.4 * d, 1e-4), 2.5);
    }
    rate *= 1.0 - 0.06 * p.at("lubrication") * std::min(relative, 4.0);
    rate *= 1.0 - 0.06 * p.at("addedMass") * d / 2e-3;
    const double openings = std::max(orifice / d - 2.4, 0.1);
    return rate * 0.5 * density * terminalVelocity(p) * d * d * openings * openings;
}

/// With `chaos`, as in granular flow, the slightest change of any entry changes the noise of a run with the same seed.
/// The particle's entries are placed between airDrag and chaos, their place in the committed statistics, which the
/// order affects.
std::size_t startOfNoise(const Numbers& p)
{
    auto start = static_cast<std::size_t>(p.at("seed"));
    if (p.at("chaos") > 0.5)
    {
        Numbers ordered;
        for (const auto& [name, value] : p)
        {
            ordered[(name.rfind("particle", 0) == 0 ? "b" : "") + name] = value;
        }
        for (const auto& [name, value] : ordered)
        {
            start = start * 31 + std::hash<double>{}(value);
        }
    }
    return start;
}

} // namespace

Curve discharge(const Entries& entries)
{
    const Numbers p = numbersOf(entries);
    const double fill = p.at("fillMass");
    const double steady = steadyRate(p);
    const double rest = fill * (0.06 + 0.12 * p.at("frictionBottom") + 0.4 * p.at("rollingFriction"));
    const double startTime = 0.05 + 0.4 * p.at("addedMass") * (p.at("submerged") > 0.5 ? 1.0 : 0.0);
    const double spread = p.at("scatter") * (1.0 + 2.0 * p.at("cohesion"));

    std::mt19937_64 random(startOfNoise(p));
    std::normal_distribution<double> normal;
    double wander = spread * normal(random);
    const double restFraction = 1.0 + 0.05 * normal(random);

    Curve curve;
    double mass = fill;
    for (double time = 0.0; time < longest; time += step)
    {
        curve.time.push_back(time);
        curve.value.push_back(mass);
        const double level = mass / fill;
        double rate = steady * std::exp(wander) * (1.0 - std::exp(-time / startTime));
        rate *= 1.0 - 0.12 * (p.at("frictionWall") - 0.15) * (1.3 - level);
        rate *= 1.0 + p.at("pumping") * (p.at("submerged") > 0.5 ? 1.0 : 0.0) / (1.0 + 4.0 * level);
        rate *= 1.0 + p.at("heightLaw") * (level - 0.5);
        rate *= std::tanh(std::max(mass - rest * restFraction, 0.0) / (0.02 * fill));
        const double lost = rate * step;
        if (lost < 1e-7 * fill && time > 1.0)
        {
            break;
        }
        mass -= lost;
        const double fade = std::exp(-lost / (memoryOfNoise * fill));
        wander = wander * fade + spread * std::sqrt(1.0 - fade * fade) * normal(random);
    }
    return curve;
}

SurrogateSimulator::SurrogateSimulator(Entries defaults)
    : defaults_(std::move(defaults))
{}

Entries SurrogateSimulator::defaults() const
{
    return defaults_;
}

std::vector<RunResult> SurrogateSimulator::run(const std::vector<RunOrder>& orders)
{
    std::vector<RunResult> results;
    for (const auto& order : orders)
    {
        Entries entries = order.entries;
        entries.insert(defaults_.begin(), defaults_.end());
        results.push_back({discharge(entries), "", 0.0, false});
    }
    return results;
}

int SurrogateSimulator::missing(const std::vector<RunOrder>& /*unused*/)
{
    return 0; // costs nothing
}

} // namespace clepsydra::identification::tests
