#include "report/numbers.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace clepsydra::identification
{

namespace
{

int powerOfTen(double value)
{
    return static_cast<int>(std::floor(std::log10(std::abs(value))));
}

} // namespace

std::string rounded(double value, int digits)
{
    if (value == 0.0 || !std::isfinite(value))
    {
        return std::isfinite(value) ? "0" : "-";
    }
    const double unit = std::pow(10.0, powerOfTen(value) + 1 - digits);
    const double near = std::round(value / unit) * unit;
    const int power = powerOfTen(near * (1.0 + 1e-9)); // .0999 has become .1
    std::ostringstream text;
    const bool isPlain = power >= -4 && power <= 6;
    text << (isPlain ? std::fixed : std::scientific)
         << std::setprecision(isPlain ? std::max(0, digits - 1 - power) : digits - 1) << near;
    return text.str();
}

std::string percent(double share)
{
    constexpr double least = 0.01;
    return share < least ? "<1 %" : share > 1.0 - least ? ">99 %" : std::to_string(std::lround(100.0 * share)) + " %";
}

std::string withError(const Estimate& estimate)
{
    constexpr int exact = 4;
    const auto& [value, error] = estimate;
    if (!(error > 0.0) || !std::isfinite(error))
    {
        return rounded(value, exact);
    }
    const int digits = value == 0.0 ? 2 : std::clamp(powerOfTen(value) - powerOfTen(error) + 2, 1, 9);
    return rounded(value, digits) + " +- " + rounded(error);
}

} // namespace clepsydra::identification
