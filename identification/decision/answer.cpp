#include "decision/answer.h"

#include <cmath>

namespace clepsydra::identification
{

std::string nameOf(Decision decision)
{
    switch (decision)
    {
        case Decision::noResidual:
            return "noResidual";
        case Decision::named:
            return "named";
        case Decision::set:
            return "set";
        case Decision::unknown:
            break;
    }
    return "unknown";
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
