#include "procedure/answer.h"

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

} // namespace clepsydra::identification
