#include "study/study.h"

#include <algorithm>

namespace clepsydra::identification
{

bool acts(const Effect& effect, const Condition& condition)
{
    return std::all_of(effect.actsIn.begin(), effect.actsIn.end(), [&](const auto& rule) {
        const auto tag = condition.tags.find(rule.first);
        return tag != condition.tags.end()
               && std::find(rule.second.begin(), rule.second.end(), tag->second) != rule.second.end();
    });
}

std::vector<std::size_t> Study::conditionsOf(Role role) const
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < conditions.size(); ++i)
    {
        if (conditions[i].role == role)
        {
            found.push_back(i);
        }
    }
    return found;
}

} // namespace clepsydra::identification
