#pragma once

#include <limits>
#include <sstream>
#include <string>

namespace clepsydra
{

/// Text of a number with so many digits that reading it gives the same number, to the bit.
inline std::string exactText(double number)
{
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    text << number;
    return text.str();
}

} // namespace clepsydra
