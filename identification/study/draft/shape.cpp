#include "study/draft/shape.h"

#include "lists.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace clepsydra::identification
{

namespace
{

/// Removes rows of exactly 0 if three or more of them stand before or after all others: 0 then means that the camera
/// saw nothing.
bool dropBlanks(Curve& curve)
{
    constexpr std::ptrdiff_t fewest = 3;
    const auto isSeen = [](double value) { return value != 0.0; };
    const auto before = std::find_if(curve.value.begin(), curve.value.end(), isSeen) - curve.value.begin();
    const auto after = std::find_if(curve.value.rbegin(), curve.value.rend(), isSeen) - curve.value.rbegin();
    if (std::max(before, after) < fewest || std::count_if(curve.value.begin(), curve.value.end(), isSeen) < fewest)
    {
        return false;
    }
    const auto seen = numbersWhere(curve.value.size(), [&](std::size_t i) { return isSeen(curve.value[i]); });
    curve = {mapped(seen, [&](std::size_t i) { return curve.time[i]; }),
        mapped(seen, [&](std::size_t i) { return curve.value[i]; })};
    return true;
}

/// Number of times that a falling curve turns and rises by more than its scatter.
int bouncesOf(const Curve& curve)
{
    const auto [lowest, highest] = std::minmax_element(curve.value.begin(), curve.value.end());
    const double threshold = 0.03 * (*highest - *lowest);
    int bounces = 0;
    bool isFalling = true;
    double turn = curve.value.front();
    for (const double value : curve.value)
    {
        turn = isFalling ? std::min(turn, value) : std::max(turn, value);
        if (std::abs(value - turn) > threshold)
        {
            bounces += isFalling ? 1 : 0;
            isFalling = !isFalling;
            turn = value;
        }
    }
    return bounces;
}

} // namespace

Shape shapeOf(std::vector<Curve> curves, bool mayHaveBlanks)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Shape shape;
    shape.lowest = -infinity;
    shape.highest = infinity;
    shape.smallestSeen = infinity;
    shape.largest = -infinity;
    shape.bounces = std::numeric_limits<int>::max();
    shape.endsFlat = true;
    int falling = 0;
    for (auto& curve : curves)
    {
        shape.hasBlanks = (mayHaveBlanks && dropBlanks(curve)) || shape.hasBlanks;
        const auto [lowest, highest] = std::minmax_element(curve.value.begin(), curve.value.end());
        const double range = *highest - *lowest;
        const double first = curve.value.front();
        const double last = curve.value.back();
        // A bouncing particle is highest at the start.
        const bool falls = first - *lowest > 0.5 * range;
        falling += falls ? 1 : -1;
        shape.bounces = std::min(shape.bounces, falls ? bouncesOf(curve) : 0);
        shape.lowest = std::max(shape.lowest, *lowest);
        shape.highest = std::min(shape.highest, *highest);
        shape.largest = std::max(shape.largest, *highest);
        shape.smallestSeen = std::min(shape.smallestSeen, *lowest);
        shape.largestRest = std::max(shape.largestRest, last / first);
        const double nearEnd = valueAt(curve, 0.1 * curve.time.front() + 0.9 * curve.time.back());
        shape.endsFlat = shape.endsFlat && std::abs(nearEnd - last) < 0.01 * range;
        shape.duration = std::max(shape.duration, curve.time.back() - curve.time.front());
    }
    shape.falls = falling > 0;
    return shape;
}

} // namespace clepsydra::identification
