#pragma once

#include <string>

namespace clepsydra::identification
{

/// How many SI units a unit is: 1e-3 for g, mm, ms. \throws std::invalid_argument that lists the known ones
double siUnitsPer(const std::string& unit);

/// What a unit measures: time, mass, length, speed, mass rate, pressure or share; empty where it is not known.
std::string quantityOf(const std::string& unit);

/// The known unit that people may mean, as s by "sec" or "seconds"; empty where there is none.
std::string unitMeant(const std::string& text);

} // namespace clepsydra::identification
