#include "study/units.h"

#include "words/didYouMean.h"

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
};

const std::map<std::string, Unit>& units()
{
    static const std::map<std::string, Unit> all = {
        {"s", {1.0, "time"}},
        {"ms", {1e-3, "time"}},
        {"min", {60.0, "time"}},
        {"h", {3600.0, "time"}},
        {"kg", {1.0, "mass"}},
        {"g", {1e-3, "mass"}},
        {"mg", {1e-6, "mass"}},
        {"m", {1.0, "length"}},
        {"cm", {1e-2, "length"}},
        {"mm", {1e-3, "length"}},
        {"um", {1e-6, "length"}},
        {"kg/s", {1.0, "mass rate"}},
        {"g/s", {1e-3, "mass rate"}},
        {"g/min", {1e-3 / 60.0, "mass rate"}},
        {"m/s", {1.0, "speed"}},
        {"cm/s", {1e-2, "speed"}},
        {"mm/s", {1e-3, "speed"}},
        {"Pa", {1.0, "pressure"}},
        {"kPa", {1e3, "pressure"}},
        {"1", {1.0, "share"}},
        {"%", {1e-2, "share"}},
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
    static const std::map<std::string, std::string> otherNames = {
        {"sec", "s"},
        {"secs", "s"},
        {"second", "s"},
        {"seconds", "s"},
        {"msec", "ms"},
        {"minutes", "min"},
        {"gram", "g"},
        {"grams", "g"},
        {"gr", "g"},
        {"meter", "m"},
        {"metre", "m"},
        {"\xC2\xB5m", "um"},
        {"percent", "%"},
        {"m_s", "m/s"},
        {"cm_s", "cm/s"},
        {"mm_s", "mm/s"},
        {"g_s", "g/s"},
        {"kg_s", "kg/s"},
    };
    if (units().count(text) > 0)
    {
        return text;
    }
    const auto found = otherNames.find(text);
    return found == otherNames.end() ? "" : found->second;
}

} // namespace clepsydra::identification
