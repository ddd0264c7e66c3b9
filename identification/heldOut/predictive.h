#pragma once

#include <Eigen/Core>

#include <random>

namespace clepsydra::identification
{

/// Features of several conditions under one explanation, to first order in the quantities that training and held-out
/// conditions share: parameters, amplitudes, common errors and the simulation's own error. Each of them has, a priori,
/// mean 0 and variance 1 ("prior standard deviations"), and is independent of the others.
struct LinearModel
{
    Eigen::VectorXd mean;   // at the fitted values of the shared quantities
    Eigen::MatrixXd slopes; // change by one prior standard deviation: features x shared quantities
    Eigen::MatrixXd rest;   // covariance of all errors that are not shared
};

/// The shared quantities after the training data.
struct Shared
{
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
};

/// Best linear unbiased prediction from the first two moments (Kennedy & O'Hagan, J. R. Stat. Soc. B 63, 425 (2001);
/// Goldstein & Wooff, Bayes Linear Statistics (2007), ch. 3). With the slopes S, the rest R and the residual r from the
/// model at the prior means, the shared quantities are z = S'(SS' + R)^-1 r with the covariance
/// V = I - S'(SS' + R)^-1 S.
/// \param fitted  the shared quantities at which `training.mean` holds
Shared sharedAfter(const LinearModel& training, const Eigen::VectorXd& measured, const Eigen::VectorXd& fitted);

/// Distribution of held-out measurements that is predicted before they are read: Student's, since the covariance of the
/// noise is estimated (Sellentin & Heavens, Mon. Not. R. Astron. Soc. 456, L132 (2016)); normal for infinite freedom.
struct Predictive
{
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;
    double freedom = 0.0; // degrees of freedom of the noise
};

/// Prediction with the mean mu* + S* (z - fitted) and the covariance S* V S*' + R*.
/// \param heldOut  model of the held-out features: mu* at the fitted values, S* and R*
Predictive predict(const Shared& shared, const LinearModel& heldOut, const Eigen::VectorXd& fitted, double freedom);

/// Squared distance e' Sigma^-1 e of measurements from their prediction.
double chiSquareOf(const Predictive& predicted, const Eigen::VectorXd& measured);

/// Probability that measurements that follow the prediction are at least as far from it: Fisher's F distribution of
/// the squared distance per feature. It is `leastPValue` at least.
double chanceOf(const Predictive& predicted, const Eigen::VectorXd& measured);

/// Log of the density of measurements under one prediction minus that under another.
struct LogRatio
{
    double value = 0.0;
    double pValue = 1.0; // probability of a ratio at least as large if the other prediction is right

    /// Whether the one prediction is significantly better than the other. A ratio below 0 is not, however rare it is:
    /// the other prediction may be still further from the measurements.
    bool isBeyondChance(double level) const
    {
        return value > 0.0 && pValue <= level;
    }
};

/// Paired comparison of two predictions of the same measurements. The distribution of the ratio if `other` is right
/// comes from draws from `other`.
LogRatio logRatio(const Predictive& one, const Predictive& other, const Eigen::VectorXd& measured, int draws,
    std::mt19937_64& random);

/// A discrepancy without a physical cause: a Gaussian process over the conditions' coordinates (Kennedy & O'Hagan,
/// J. R. Stat. Soc. B 63, 425 (2001)). The kernel is squared exponential with one length for all coordinates, which are
/// scaled by their standard deviations. Variance and length maximise the likelihood of the training data on a grid.
/// \param coordinates  one point per row: first the training data, then the points of the prediction
/// \param residual, covariance  of the training data without the process
/// \param variance  scale of the process' variance
/// \return  slopes at all points with respect to independent shared quantities of variance 1, as `LinearModel` has them
Eigen::MatrixXd discrepancySlopes(const Eigen::MatrixXd& coordinates, const Eigen::VectorXd& residual,
    const Eigen::MatrixXd& covariance, double variance);

} // namespace clepsydra::identification
