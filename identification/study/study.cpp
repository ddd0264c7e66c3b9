#include "study/study.h"

#include "lists.h"

#include <algorithm>

namespace clepsydra::identification
{

bool acts(const Effect& effect, const Condition& condition)
{
    return std::all_of(effect.actsIn.begin(), effect.actsIn.end(), [&](const auto& rule) {
        const auto tag = condition.tags.find(rule.first);
        return tag != condition.tags.end() && contains(rule.second, tag->second);
    });
}

std::string nameOf(Origin origin)
{
    return origin == Origin::measured ? "measured" : origin == Origin::handbook ? "handbook" : "guess";
}

std::vector<std::size_t> Study::conditionsOf(Role role) const
{
    return numbersWhere(conditions.size(), [&](std::size_t c) { return conditions[c].role == role; });
}

} // namespace clepsydra::identification
