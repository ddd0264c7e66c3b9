#pragma once

#include "curves/curve.h"

#include <vector>

namespace clepsydra::identification
{

/// Common properties of the curves of the training conditions, in the unit of their files.
struct Shape
{
    bool falls = false;  // whether most curves fall to the end or to the first bounce
    int bounces = 0;     // smallest number of bounces of any curve
    double lowest = 0.0; // limits of the range that all curves pass through
    double highest = 0.0;
    double largestRest = 0.0;  // largest ratio of last to first value
    bool endsFlat = false;     // whether all curves end with a constant value
    double duration = 0.0;     // of the longest curve, in its unit of time
    bool hasBlanks = false;    // whether rows of 0 were removed from the ends of curves
    double smallestSeen = 0.0; // smallest and largest value of the remaining rows
    double largest = 0.0;
};

/// \param curves  at least one, each with three rows or more
/// \param mayHaveBlanks  whether rows of 0 at the ends are missing values, as for positions but not for masses
Shape shapeOf(std::vector<Curve> curves, bool mayHaveBlanks);

} // namespace clepsydra::identification
