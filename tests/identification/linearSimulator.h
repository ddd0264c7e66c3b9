#pragma once

#include "study/entries.h"
#include "runner/simulator.h"
#include "study/readStudy.h"
#include "temporaryFolder.h"

#include <cmath>
#include <string>
#include <vector>

namespace clepsydra::identification::tests
{

/// m = 1 - W t with ln W = ln(0.1) + 2 (friction - 0.15) + 3 x (1 + edge) + 5 y + curvature x^2. Without curvature the
/// feature is linear, and the library must find its coefficients exactly.
class LinearSimulator final : public Simulator
{
public:
    explicit LinearSimulator(bool runsScatter = false)
        : scatters(runsScatter)
    {}

    bool scatters = false;
    bool failsWithY = false;
    bool failsWithYAtEdge = false;
    bool failsWithNegativeY = false;
    bool failsAlways = false;
    int failuresFirst = 0;
    double curvature = 0.0;

    Entries defaults() const override
    {
        return {{"friction", "0.15"}, {"x", "0"}, {"y", "0"}, {"edge", "0"}, {"seed", "1"}};
    }
    int missing(const std::vector<RunOrder>& orders) override
    {
        return static_cast<int>(orders.size());
    }
    std::vector<RunResult> run(const std::vector<RunOrder>& orders) override
    {
        std::vector<RunResult> results;
        for (const auto& order : orders)
        {
            Entries all = order.entries;
            const auto own = defaults();
            all.insert(own.begin(), own.end());
            const auto p = numbersOf(all);
            if (failsAlways || failuresFirst-- > 0 || (failsWithNegativeY && p.at("y") < 0.0)
                || (p.at("y") != 0.0 && (failsWithY || (failsWithYAtEdge && p.at("edge") != 0.0))))
            {
                results.push_back({{}, failsAlways ? "the power is off" : "y is not possible", 1.0, false});
                continue;
            }
            double rate = 0.1
                          * std::exp(2 * (p.at("friction") - 0.15) + 3 * p.at("x") * (1 + p.at("edge")) + 5 * p.at("y")
                                     + curvature * p.at("x") * p.at("x"));
            rate *= scatters ? 1 + 0.01 * std::sin(static_cast<double>(order.seed)) : 1;
            Curve curve;
            for (int i = 0; i <= 200; ++i)
            {
                curve.time.push_back(i / 200. / rate);
                curve.value.push_back(1 - i / 200.);
            }
            results.push_back({curve, "", 1.0, false});
        }
        return results;
    }
};

/// \param moreParameters  one line per parameter
inline Study linearStudy(const TemporaryFolder& folder, const std::string& seed, const std::string& moreParameters = "")
{
    folder.write("case/parameters", "friction 0.15;\nx 0;\ny 0;\nedge 0;\nseed 1;\n");
    return readStudy(folder.write("study.yaml", R"(study: s
simulator: { case: case, seed: )" + seed + R"( }
observable: { file: f, value: m, features: [ { kind: logMeanRate, from: 0.9, to: 0.3 } ] }
conditions:
  - { name: both, role: training, tags: { medium: water } }
  - { name: dry, role: training, tags: { medium: air } }
  - { name: again, role: heldOut, tags: { medium: water } }
parameters:
  - { name: friction, set: { friction: friction }, prior: { mean: 0.15, sd: 0.02, from: measured }, range: [0, 1] }
)" + moreParameters + R"(effects:
  - { name: x, set: { x: "0.02*a" }, amplitude: [-1, 1] }
  - { name: y, set: { y: "0.04*a" }, actsIn: { medium: water } }
  - { name: clock, chain: { timeFactor: "0.01*a" } }
)"));
}

} // namespace clepsydra::identification::tests
