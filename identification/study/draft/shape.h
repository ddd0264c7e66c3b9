#pragma once

#include "curves/curve.h"

#include <vector>

namespace clepsydra::identification
{

/// What the curves of the training conditions have in common, in the unit of their files.
struct Shape
{
    bool falls = false;  // from first value to last, or to its first bounce
    int bounces = 0;     // the fewest of any curve
    double lowest = 0.0; // of the range that all curves pass through
    double highest = 0.0;
    double largestRest = 0.0;  // largest share of the first value that is left at the end
    bool endsFlat = false;     // all of them
    double duration = 0.0;     // of the longest, in its unit of time
    bool hasBlanks = false;    // rows of 0 before or after all others: nothing was seen
    double smallestSeen = 0.0; // beside them
    double largest = 0.0;
};

/// \param curves  at least one, each with three rows or more
/// \param mayHaveBlanks  positions; a scale may well show 0
Shape shapeOf(std::vector<Curve> curves, bool mayHaveBlanks);

} // namespace clepsydra::identification
