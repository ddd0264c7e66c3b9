#pragma once

#include <Eigen/Core>

#include <random>
#include <utility>
#include <vector>

namespace clepsydra::identification
{

/// A value with its standard error.
struct Estimate
{
    double value = 0.0;
    double standardError = 0.0;
};

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

/// Simulation of one held-out condition with an explanation at its fitted setting.
struct Prediction
{
    Eigen::VectorXd mean;           // of the features
    Eigen::VectorXd variance;       // of the mean, from the scatter of runs
    Eigen::MatrixXd dataCovariance; // of one measurement
    Eigen::MatrixXd slopes = {};    // change of the mean by one prior standard deviation of each fitted quantity
};

/// How well an explanation predicts the held-out measurements.
struct HeldOutScore
{
    Estimate rmsLogError;   // root mean square of measured minus simulated means, over conditions and log features
    Eigen::ArrayXd errors;  // draws of this error, to compare predictions draw by draw
    double chiSquare = 0.0; // distance of the measurements from the joint prediction
    double pValue = 1.0;    // probability that noise alone makes this distance as large
    LogRatio overNull;      // against the prediction without an effect
};

/// Measurements of one held-out condition.
struct HeldOutData
{
    Eigen::VectorXd mean;             // of the features
    Eigen::MatrixXd meanShare;        // result of shareOfMean
    Eigen::VectorXd declaredVariance; // of each value and of the mean, in addition to the scatter of repeats
    /// Change of the features by one standard deviation of each common error, then of the model error of each feature:
    /// errors that are equal in all conditions and for all explanations.
    Eigen::MatrixXd errorSlopes;
};

/// Draws of the errors that all explanations share: noise of the measurements, common errors and model error.
/// \return for each condition, the errors of the measured means, one draw per row
std::vector<Eigen::MatrixXd> drawDataNoise(const std::vector<HeldOutData>& data,
    const std::vector<Prediction>& predictions, int draws, std::mt19937_64& random);

/// Root mean square error of a prediction, and draws of it. Its standard error comes from these draws of the errors of
/// measured and simulated means.
/// \param features  for each condition, the features that enter the error
std::pair<Estimate, Eigen::ArrayXd> rmsError(const std::vector<HeldOutData>& data,
    const std::vector<Prediction>& predictions, const std::vector<std::vector<Eigen::Index>>& features,
    const std::vector<Eigen::MatrixXd>& noise, std::mt19937_64& random);

} // namespace clepsydra::identification
