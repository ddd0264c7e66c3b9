#pragma once

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// How many SI units a unit is: 1e-3 for g, mm, ms. \throws std::invalid_argument that lists the known ones
double siUnitsPer(const std::string& unit);

} // namespace clepsydra::identification
