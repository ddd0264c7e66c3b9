#include "study/units.h"

#include "lists.h"
#include "tokens/didYouMean.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

struct Unit
{
    double si;
    std::string quantity;
    std::vector<std::string> otherNames = {};
};

const std::map<std::string, Unit>& units()
{
    static const std::map<std::string, Unit> all = {
        {"s", {1.0, "time", {"sec", "secs", "second", "seconds"}}},
        {"ms", {1e-3, "time", {"msec"}}},
        {"min", {60.0, "time", {"minutes"}}},
        {"h", {3600.0, "time"}},
        {"kg", {1.0, "mass"}},
        {"g", {1e-3, "mass", {"gram", "grams", "gr"}}},
        {"mg", {1e-6, "mass"}},
        {"m", {1.0, "length", {"meter", "metre"}}},
        {"cm", {1e-2, "length"}},
        {"mm", {1e-3, "length"}},
        {"um", {1e-6, "length", {"\xC2\xB5m"}}},
        {"kg/s", {1.0, "mass rate", {"kg_s"}}},
        {"g/s", {1e-3, "mass rate", {"g_s"}}},
        {"g/min", {1e-3 / 60.0, "mass rate"}},
        {"m/s", {1.0, "speed", {"m_s"}}},
        {"cm/s", {1e-2, "speed", {"cm_s"}}},
        {"mm/s", {1e-3, "speed", {"mm_s"}}},
        {"Pa", {1.0, "pressure"}},
        {"kPa", {1e3, "pressure"}},
        {"1", {1.0, "share"}},
        {"%", {1e-2, "share", {"percent"}}},
        {"1/s", {1.0, "share rate", {"1_s"}}},
        {"%/s", {1e-2, "share rate", {"%_s"}}},
    };
    return all;
}

} // namespace

double siUnitsPer(const std::string& unit)
{
    const auto found = units().find(unit);
    if (found == units().end())
    {
        throw std::invalid_argument("unknown unit '" + unit + "'; known: " + listed(namesOf(units())));
    }
    return found->second.si;
}

std::string quantityOf(const std::string& unit)
{
    const auto found = units().find(unit);
    return found == units().end() ? "" : found->second.quantity;
}

std::string unitMeant(const std::string& text)
{
    const auto isMeant = [&](const auto& unit) { return unit.first == text || contains(unit.second.otherNames, text); };
    const auto found = std::find_if(units().begin(), units().end(), isMeant);
    return found == units().end() ? "" : found->first;
}

} // namespace clepsydra::identification
