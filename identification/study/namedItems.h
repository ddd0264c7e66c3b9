#pragma once

#include "lists.h"
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
    return mapped(items, [](const Item& item) { return item.name; });
}

/// Index of the item that a place names. \throws StudyError listing the items if there is no such item
template<class Item>
std::size_t indexOf(const YamlPlace& place, const std::vector<Item>& items)
{
    const auto names = namesOfItems(items);
    return std::find(names.begin(), names.end(), place.oneOf(names)) - names.begin();
}

/// \param kind  of the items, in the plural, for the message: "effects"
/// \throws StudyError if another item has the same name as the last one
template<class Item>
void requireOwnName(const YamlPlace& place, const std::vector<Item>& items, const std::string& kind)
{
    const auto& name = items.back().name;
    if (std::any_of(items.begin(), items.end() - 1, [&](const Item& item) { return item.name == name; }))
    {
        (place.has("name") ? place.at("name") : place)
            .fail("there are two " + kind + " named '" + name + "'; give them different names");
    }
}

/// Reads the items of a list, whose names must differ. \param read  function that reads one item from its place
template<class Read>
auto readNamed(const YamlPlace& list, const std::string& kind, Read read)
{
    std::vector<decltype(read(list))> items;
    for (const auto& place : list.list())
    {
        items.push_back(read(place));
        requireOwnName(place, items, kind);
    }
    return items;
}

} // namespace clepsydra::identification
