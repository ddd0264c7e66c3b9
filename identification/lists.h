#pragma once

#include <algorithm>
#include <iterator>
#include <type_traits>
#include <vector>

namespace clepsydra::identification
{

/// The results of a function for all items.
template<class Items, class Function>
auto mapped(const Items& items, Function function)
{
    std::vector<std::decay_t<decltype(function(*std::begin(items)))>> made;
    made.reserve(items.size());
    std::transform(std::begin(items), std::end(items), std::back_inserter(made), function);
    return made;
}

/// The numbers among 0, 1, ..., count - 1 for which a condition is true.
template<class Number, class Condition>
std::vector<Number> numbersWhere(Number count, Condition isTrue)
{
    std::vector<Number> found;
    for (Number number = 0; number < count; ++number)
    {
        if (isTrue(number))
        {
            found.push_back(number);
        }
    }
    return found;
}

template<class Items, class Item>
bool contains(const Items& items, const Item& item)
{
    return std::find(std::begin(items), std::end(items), item) != std::end(items);
}

template<class Item>
void append(std::vector<Item>& items, const std::vector<Item>& more)
{
    items.insert(items.end(), more.begin(), more.end());
}

/// Removes the items for which a condition is true.
template<class Items, class Condition>
void eraseIf(Items& items, Condition isTrue)
{
    items.erase(std::remove_if(items.begin(), items.end(), isTrue), items.end());
}

} // namespace clepsydra::identification
