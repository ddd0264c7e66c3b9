#include "report/numbers.h"

#include "emulator/distributions.h"

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

/// Whether a number of this magnitude is written without a power of ten.
bool isPlain(int power)
{
    return power >= -4 && power <= 6;
}

std::string withDecimals(double value, int decimals)
{
    std::ostringstream text;
    text << std::fixed << std::setprecision(std::max(0, decimals)) << value;
    return text.str();
}

std::string scientific(double value, int digits)
{
    std::ostringstream text;
    text << std::scientific << std::setprecision(digits - 1) << value;
    return text.str();
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
    const int power = powerOfTen(near * (1.0 + 1e-9)); // rounding may have raised it: 0.0999 has become 0.1
    return isPlain(power) ? withDecimals(near, digits - 1 - power) : scientific(near, digits);
}

std::string percent(double share)
{
    constexpr double least = 0.01;
    return share < least ? "<1 %" : share > 1.0 - least ? ">99 %" : std::to_string(std::lround(100.0 * share)) + " %";
}

std::string pValueText(double pValue)
{
    return pValue <= leastPValue ? "p below 1e-6" : "p = " + rounded(pValue, pValue < 0.1 ? 1 : 2);
}

std::string withError(const Estimate& estimate)
{
    constexpr int exact = 4;
    const auto& [value, error] = estimate;
    if (!(error > 0.0) || !std::isfinite(error))
    {
        return rounded(value, exact);
    }
    const int decimals = 1 - powerOfTen(error);
    if (isPlain(powerOfTen(error)) || (value != 0.0 && isPlain(powerOfTen(value))))
    {
        return withDecimals(value, decimals) + " ± " + withDecimals(error, decimals);
    }
    const int digits = value == 0.0 ? 2 : std::max(1, powerOfTen(value) + decimals + 1);
    return scientific(value, digits) + " ± " + scientific(error, 2);
}

} // namespace clepsydra::identification
