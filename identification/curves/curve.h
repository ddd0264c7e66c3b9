#pragma once

#include <vector>

namespace clepsydra::identification
{

/// The observable of one run or one measurement as a function of time, in SI units. Times increase.
struct Curve
{
    std::vector<double> time;       // [s]
    std::vector<double> value;      // in the observable's SI unit
    std::vector<Curve> others = {}; // further columns of the same table
};

/// Time at which a falling or rising curve first reaches `level`, interpolated linearly; NaN if it never does.
double timeAtLevel(const Curve& curve, double level);

/// Value at a time, interpolated linearly. Outside the curve it is the nearest end value.
double valueAt(const Curve& curve, double time);

} // namespace clepsydra::identification
