#pragma once

#include <Eigen/Core>

namespace clepsydra::identification
{

/// Deviations of repeated runs from their means, pooled over settings, from which the noise is estimated.
class Scatter
{
public:
    /// Adds repeats of one setting (one per row, NaN = missing). Fewer than two are ignored.
    void add(const Eigen::MatrixXd& repeats);

    /// Degrees of freedom: number of repeats minus number of settings.
    double degreesOfFreedom() const
    {
        return nu_;
    }

    /// One deviation per row, scaled so that its squares are unbiased.
    const Eigen::MatrixXd& deviations() const
    {
        return deviations_;
    }

private:
    Eigen::MatrixXd deviations_;
    double nu_ = 0.0;
};

/// Covariance of one run's features.
struct Covariance
{
    Eigen::MatrixXd matrix;
    double nu = 0.0;        // degrees of freedom of the estimate
    double shrinkage = 0.0; // 0: correlations as estimated; 1: correlations set to zero
};

/// Pooled covariance. With fewer than 8 degrees of freedom per feature its correlations are shrunk towards zero.
/// Ledoit & Wolf, J. Multivar. Anal. 88, 365 (2004); target and intensity for standardised features as in Schaefer &
/// Strimmer, Stat. Appl. Genet. Mol. Biol. 4, 32 (2005).
/// \param deviations  one per row, mean zero; NaN entries are left out pair by pair
/// \param nu  degrees of freedom of the deviations
Covariance pooledCovariance(const Eigen::MatrixXd& deviations, double nu);

} // namespace clepsydra::identification
