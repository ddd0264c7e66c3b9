#pragma once

#include <Eigen/Core>

#include <random>
#include <vector>

namespace clepsydra::identification
{

/// What repeats at one and the same setting tell about noise: deviations from their own mean, so that only the spread
/// is left, pooled over settings.
class Scatter
{
public:
    /// Adds repeats (one per row, NaN = missing) of one setting. Fewer than two say nothing.
    void add(const Eigen::MatrixXd& repeats);

    /// Degrees of freedom: repeats minus settings.
    double degreesOfFreedom() const
    {
        return nu_;
    }

    /// One deviation per row, scaled so that its squares are unbiased.
    Eigen::MatrixXd deviations() const;

private:
    std::vector<Eigen::RowVectorXd> deviations_;
    double nu_ = 0.0;
};

/// Covariance of one run's features.
struct Covariance
{
    Eigen::MatrixXd matrix;
    double nu = 0.0;        // degrees of freedom behind it
    double shrinkage = 0.0; // 0: as pooled; 1: no correlations left
};

/// Pooled covariance; with fewer than 8 degrees of freedom per feature its correlations are shrunk towards none.
/// Ledoit & Wolf, J. Multivar. Anal. 88, 365 (2004); target and intensity for standardised features as in Schaefer &
/// Strimmer, Stat. Appl. Genet. Mol. Biol. 4, 32 (2005).
/// \param deviations  one per row, mean zero; NaN entries are left out pair by pair
Covariance pooledCovariance(const Eigen::MatrixXd& deviations, double nu);

} // namespace clepsydra::identification
