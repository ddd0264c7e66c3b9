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
    void add(const Scatter& other);

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

/// Pooled covariance; with fewer than 3 degrees of freedom per feature its correlations are shrunk towards none.
/// Ledoit & Wolf, J. Multivar. Anal. 88, 365 (2004); target and intensity for standardised features as in Schaefer &
/// Strimmer, Stat. Appl. Genet. Mol. Biol. 4, 32 (2005).
/// \param deviations  one per row, mean zero; NaN entries are left out pair by pair
Covariance pooledCovariance(const Eigen::MatrixXd& deviations, double nu);

/// Noise of a study. One run of the simulator and one measurement may differ in noise.
struct Noise
{
    Covariance data;
    Covariance simulation;
    bool pooled = false;        // the same repeats stand behind both
    Eigen::VectorXd modelError; // sd of what no repeat shows (resolution), declared by the user, independent

    /// Both covariances estimated anew from as many repeats, if these were the truth.
    Noise redrawn(std::mt19937_64& random) const;
};

/// Chooses where the noise of the data comes from: their own repeats if these suffice (3 per feature) or if the
/// simulator has no noise, else data and simulation together.
/// \param alike  false: data and simulation scatter differently and must not be put together
/// \param declared  every number measured has a declared error: repeats may be missing then, and the data's covariance is
///     zero, for declared errors are added feature by feature
Noise noiseModel(const Scatter& data, const Scatter& simulation, const Eigen::VectorXd& modelError, bool alike = true,
    bool declared = false);

} // namespace clepsydra::identification
