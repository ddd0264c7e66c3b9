#include "effects/measuringChain.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

namespace clepsydra::identification
{

namespace
{

Eigen::Map<Eigen::ArrayXd> array(std::vector<double>& numbers)
{
    return {numbers.data(), static_cast<Eigen::Index>(numbers.size())};
}

/// Solution y of y' = (v - y)/tau, exact for a piecewise linear curve v.
Curve lagged(Curve curve, double tau)
{
    if (tau <= 0.0)
    {
        return curve;
    }
    const auto original = curve.value;
    for (std::size_t i = 1; i < original.size(); ++i)
    {
        const double step = curve.time[i] - curve.time[i - 1];
        const double slope = (original[i] - original[i - 1]) / step;
        const double fade = std::exp(-step / tau);
        curve.value[i] = original[i] - slope * tau + (curve.value[i - 1] - original[i - 1] + slope * tau) * fade;
    }
    return curve;
}

/// The derivative is the central difference, because a one-sided one would contain the point's own noise.
Curve led(Curve curve, double seconds)
{
    const auto original = curve.value;
    const std::size_t last = original.size() - 1;
    for (std::size_t i = 0; i <= last; ++i)
    {
        const std::size_t before = i == 0 ? 0 : i - 1;
        const std::size_t after = std::min(i + 1, last);
        curve.value[i] += seconds * (original[after] - original[before]) / (curve.time[after] - curve.time[before]);
    }
    return curve;
}

/// The record's time zero is `seconds` after the true one. A positive shift cuts off the beginning; with a negative
/// shift the first value is extended.
Curve shifted(Curve curve, double seconds)
{
    const double begin = curve.time.front();
    const double first = valueAt(curve, begin + seconds);
    array(curve.time) -= seconds;
    const auto kept =
        static_cast<std::ptrdiff_t>(std::upper_bound(curve.time.begin(), curve.time.end(), begin) - curve.time.begin());
    curve.time.erase(curve.time.begin(), curve.time.begin() + kept);
    curve.value.erase(curve.value.begin(), curve.value.begin() + kept);
    curve.time.insert(curve.time.begin(), begin);
    curve.value.insert(curve.value.begin(), first);
    return curve;
}

Curve gained(Curve curve, double gain)
{
    array(curve.value) *= 1.0 + gain;
    return curve;
}

Curve offsetBy(Curve curve, double offset)
{
    array(curve.value) += offset;
    return curve;
}

Curve drifting(Curve curve, double perSecond)
{
    array(curve.value) += perSecond * (array(curve.time) - curve.time.front());
    return curve;
}

Curve stretched(Curve curve, double factor)
{
    const double begin = curve.time.front();
    array(curve.time) = begin + (array(curve.time) - begin) * (1.0 + factor);
    return curve;
}

} // namespace

const std::map<std::string, ChainOperation>& chainOperations()
{
    static const std::map<std::string, ChainOperation> operations = {
        {"lag", {"s", lagged}},
        {"lead", {"s", led}},
        {"shift", {"s", shifted}},
        {"gain", {"", gained}},
        {"offset", {"", offsetBy}},
        {"drift", {"", drifting}},
        {"timeFactor", {"", stretched}},
    };
    return operations;
}

} // namespace clepsydra::identification
