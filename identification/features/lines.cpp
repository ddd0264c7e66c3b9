#include "features/lines.h"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>

namespace clepsydra::identification
{

namespace
{

/// Coefficients of a polynomial in (t - middle)/half, by least squares over the points between two times.
Eigen::VectorXd polynomial(const Curve& curve, double from, double to, int degree)
{
    const auto begin = std::lower_bound(curve.time.begin(), curve.time.end(), from);
    const auto end = std::upper_bound(begin, curve.time.end(), to);
    const Eigen::Index count = end - begin;
    if (count < degree + 2)
    {
        return Eigen::VectorXd::Constant(degree + 1, std::numeric_limits<double>::quiet_NaN());
    }
    const std::size_t first = begin - curve.time.begin();
    const Eigen::Map<const Eigen::ArrayXd> time(&curve.time[first], count);
    const Eigen::Map<const Eigen::VectorXd> value(&curve.value[first], count);
    const Eigen::ArrayXd scaled = (time - (from + to) / 2) / ((to - from) / 2);
    Eigen::MatrixXd powers(count, degree + 1);
    powers.col(0).setOnes();
    for (int power = 1; power <= degree; ++power)
    {
        powers.col(power) = powers.col(power - 1).array() * scaled;
    }
    return powers.colPivHouseholderQr().solve(value);
}

} // namespace

double slopeBetween(const Curve& curve, double from, double to)
{
    return polynomial(curve, from, to, 1)(1) / ((to - from) / 2);
}

Parabola parabolaBetween(const Curve& curve, double from, double to)
{
    const Eigen::VectorXd c = polynomial(curve, from, to, 2);
    const double half = (to - from) / 2;
    return {c(1) / half, c(2) / (half * half)};
}

} // namespace clepsydra::identification
