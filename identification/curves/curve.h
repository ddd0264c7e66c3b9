#pragma once

#include <vector>

namespace clepsydra::identification
{

/// One observable of one run or one measurement: value against time, in SI units, times increasing.
struct Curve
{
    std::vector<double> time;  // [s]
    std::vector<double> value; // unit of the observable
};

/// When a falling or rising curve first reaches `level`, interpolated linearly; NaN if it never does.
double timeAtLevel(const Curve& curve, double level);

/// Value at a time, interpolated linearly, the end values outside.
double valueAt(const Curve& curve, double time);

} // namespace clepsydra::identification
