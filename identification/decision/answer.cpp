#include "decision/answer.h"

#include <array>
#include <cmath>

namespace clepsydra::identification
{

std::string nameOf(Decision decision)
{
    constexpr std::array names = {"noResidual", "named", "set", "unknown"};
    return names[static_cast<std::size_t>(decision)];
}

std::string nameOf(const Study& study, const std::vector<std::size_t>& effects)
{
    std::string name;
    for (const auto e : effects)
    {
        name += (name.empty() ? "" : " with ") + study.effects[e].name;
    }
    return name.empty() ? "no effect" : name;
}

std::optional<bool> agreesWithMeasurement(const Effect& effect, const EffectFinding& finding)
{
    if (!effect.measured || !finding.alone)
    {
        return std::nullopt;
    }
    return std::abs(finding.alone->amplitude - effect.measured->mean)
           <= 2.0 * std::hypot(finding.alone->sd, effect.measured->sd);
}

} // namespace clepsydra::identification
