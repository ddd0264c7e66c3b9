#pragma once

#include <limits>
#include <sstream>
#include <string>

namespace clepsydra
{

/// A number with as many digits as it takes to read the very same one again.
inline std::string exactText(double number)
{
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    text << number;
    return text.str();
}

} // namespace clepsydra
