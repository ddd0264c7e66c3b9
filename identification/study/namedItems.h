#pragma once

#include "study/yaml.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Names of conditions, features, effects, ...
template<class Item>
std::vector<std::string> namesOfItems(const std::vector<Item>& items)
{
    std::vector<std::string> names(items.size());
    std::transform(items.begin(), items.end(), names.begin(), [](const Item& item) { return item.name; });
    return names;
}

/// Which item a place names. \throws StudyError that lists them
template<class Item>
std::size_t indexOf(const YamlPlace& place, const std::vector<Item>& items)
{
    const auto names = namesOfItems(items);
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), place.oneOf(names)) - names.begin());
}

/// \throws StudyError where an item before the last has the last one's name. \param kind  as "effects"
template<class Item>
void requireOwnName(const YamlPlace& place, const std::vector<Item>& items, const std::string& kind)
{
    const auto& name = items.back().name;
    if (std::any_of(items.begin(), items.end() - 1, [&](const Item& item) { return item.name == name; }))
    {
        (place.has("name") ? place.at("name") : place)
            .fail("there are two " + kind + " named '" + name + "': give them names of their own");
    }
}

} // namespace clepsydra::identification
