#pragma once

#include <Eigen/Core>

#include <cmath>

namespace clepsydra::identification
{

/// Log density of a sum of squares, averaged over a common factor on the variance with an inverse gamma prior. Terms
/// that are equal for all explanations are left out.
inline double logSpread(double trace, double numbers, double freedom)
{
    return std::lgamma((freedom + numbers) / 2.0) - std::lgamma(freedom / 2.0) + freedom / 2.0 * std::log(freedom / 2.0)
           - (freedom + numbers) / 2.0 * std::log((freedom + trace) / 2.0);
}

/// Trace of w s w'.
inline double traceOf(const Eigen::MatrixXd& w, const Eigen::MatrixXd& s)
{
    return w.lazyProduct(s).cwiseProduct(w).sum();
}

} // namespace clepsydra::identification
