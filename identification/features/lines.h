#pragma once

#include "curves/curve.h"

namespace clepsydra::identification
{

/// Coefficients of the least-squares parabola c0 + c1 (t - tm) + c2 (t - tm)^2 through a part of a curve with middle
/// tm.
struct Parabola
{
    double c1;
    double c2;
};

/// Slope of the least-squares line between two times; NaN with fewer than three points.
double slopeBetween(const Curve& curve, double from, double to);

/// Least-squares parabola between two times; NaN coefficients with fewer than four points.
Parabola parabolaBetween(const Curve& curve, double from, double to);

} // namespace clepsydra::identification
