#pragma once

#include <string>

namespace clepsydra::identification
{

/// Size of a unit in SI units: 1e-3 for g, mm and ms. \throws std::invalid_argument listing the known units
double siUnitsPer(const std::string& unit);

/// Quantity that a unit measures: time, mass, length, speed, mass rate, pressure or share; empty if the unit is
/// unknown.
std::string quantityOf(const std::string& unit);

/// The known unit that a text stands for, as s for "sec" or "seconds"; empty if there is none.
std::string unitMeant(const std::string& text);

} // namespace clepsydra::identification
