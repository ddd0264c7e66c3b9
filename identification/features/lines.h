#pragma once

#include "curves/curve.h"

namespace clepsydra::identification
{

/// Of c0 + c1 (t - tm) + c2 (t - tm)^2, a parabola through a part of a curve by least squares, tm the middle of the part.
struct Parabola
{
    double c1;
    double c2;
};

/// Mean slope between two times by least squares; NaN with fewer than three points.
double slopeBetween(const Curve& curve, double from, double to);

/// NaN coefficients with fewer than five points.
Parabola parabolaBetween(const Curve& curve, double from, double to);

} // namespace clepsydra::identification
