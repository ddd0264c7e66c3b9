#pragma once

#include <Eigen/Core>

namespace clepsydra::identification
{

/// Deviations of repeated runs from their means, pooled over settings, from which the noise is estimated.
struct Scatter
{
    Eigen::MatrixXd deviations; // one per row, mean zero, scaled so that their squares are unbiased; NaN = missing
    double freedom = 0.0;       // degrees of freedom: number of repeats minus number of settings

    /// Adds repeats of one setting (one per row, NaN = missing). Fewer than two are ignored.
    void add(const Eigen::MatrixXd& repeats);
};

/// Covariance of one run's features.
struct Covariance
{
    Eigen::MatrixXd matrix;
    double freedom = 0.0; // degrees of freedom of the estimate
};

/// Pooled covariance; missing values are left out pair by pair. With fewer than 8 degrees of freedom per feature its
/// correlations are shrunk towards zero.
/// Ledoit & Wolf, J. Multivar. Anal. 88, 365 (2004); target and intensity for standardised features as in Schaefer &
/// Strimmer, Stat. Appl. Genet. Mol. Biol. 4, 32 (2005).
Covariance pooledCovariance(const Scatter& scatter);

} // namespace clepsydra::identification
