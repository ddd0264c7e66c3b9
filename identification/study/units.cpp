#include "study/units.h"

#include <map>
#include <stdexcept>

namespace clepsydra::identification
{

double siUnitsPer(const std::string& unit)
{
    static const std::map<std::string, double> units = {
        {"s", 1.0},
        {"ms", 1e-3},
        {"min", 60.0},
        {"h", 3600.0},
        {"kg", 1.0},
        {"g", 1e-3},
        {"mg", 1e-6},
        {"m", 1.0},
        {"cm", 1e-2},
        {"mm", 1e-3},
        {"um", 1e-6},
        {"kg/s", 1.0},
        {"g/s", 1e-3},
        {"g/min", 1e-3 / 60.0},
        {"m/s", 1.0},
        {"cm/s", 1e-2},
        {"mm/s", 1e-3},
        {"Pa", 1.0},
        {"kPa", 1e3},
        {"1", 1.0},
        {"%", 1e-2},
    };
    const auto found = units.find(unit);
    if (found == units.end())
    {
        std::string known;
        for (const auto& [name, factor] : units)
        {
            known += ' ' + name;
        }
        throw std::invalid_argument("unknown unit '" + unit + "'; known:" + known);
    }
    return found->second;
}

} // namespace clepsydra::identification
