#pragma once

#include "lists.h"
#include "study/study.h"
#include "study/yaml.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace clepsydra::identification
{

//--- Named items ----------------------------------------------------------------------------------------------------

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
    return place.indexIn(namesOfItems(items));
}

/// \param kind  of the items, in the plural, for the message: "effects"
/// \throws StudyError if another item has the same name as the last one
template<class Item>
void requireOwnName(const YamlPlace& place, const std::vector<Item>& items, const std::string& kind)
{
    const auto names = namesOfItems(items);
    (place.has("name") ? place.at("name") : place)
        .failIf(std::count(names.begin(), names.end(), names.back()) > 1,
            "there are two " + kind + " named '" + names.back() + "'; give them different names");
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

//--- Formulas -------------------------------------------------------------------------------------------------------

/// Result of a function. An std::invalid_argument that it throws becomes a StudyError with file and line.
template<class Function>
auto checkedAt(const YamlPlace& place, Function function)
{
    try
    {
        return function();
    }
    catch (const std::invalid_argument& error)
    {
        place.fail(error.what());
    }
}

/// Reads a formula. \throws StudyError naming file and line
Expression readFormula(const YamlPlace& place);

/// Value of a formula. \param place  of the formula, for the message \throws StudyError if the value is not finite
double valueOf(const YamlPlace& place, const Expression& formula, const Expression::Variables& variables);

/// Whether a formula gives the unchanged value of an entry, but for rounding.
inline bool isUnchanged(double value, double unchanged)
{
    constexpr double tolerance = 1e-9;
    return std::abs(value - unchanged) <= tolerance * std::abs(unchanged);
}

/// Reads an operation of the measuring chain with the formula of its size: { gain: "0.01*a" }.
/// \throws StudyError naming file, line and the known operations
std::pair<std::string, Expression> readChain(const YamlPlace& place);

//--- Entries --------------------------------------------------------------------------------------------------------

/// Entries of the case's parameter file.
Entries ownEntries(const SimulatorSpecification& simulator);

/// Entries of a run without parameters and effects. The condition's values take precedence over the simulator's, and
/// these over the case's.
Entries plainEntries(const SimulatorSpecification& simulator, const Condition& condition);

/// Entries that an effect sets and the case does not have.
std::vector<std::string> missingEntries(const Effect& effect, const Entries& known);

/// \throws StudyError if the case has no such entry
void requireEntry(const YamlPlace& place, const std::string& entry, const SimulatorSpecification& simulator);

/// Checks a value that is written into the case's parameter file, where more than a value would be executed.
/// \throws StudyError if the value contains characters that end an entry or begin a command
void requireEntryValue(const YamlPlace& value);

/// Reads values of entries. \throws StudyError if the case lacks an entry, or if a value is not allowed
Entries readValues(const YamlPlace& place, const SimulatorSpecification& simulator);

} // namespace clepsydra::identification
