#pragma once

#include "heldOut/predictive.h"

#include <Eigen/Core>

#include <random>
#include <utility>
#include <vector>

namespace clepsydra::identification
{

/// Simulation of one held-out condition with an explanation at its fitted setting.
struct Prediction
{
    Eigen::VectorXd mean;           // of the features
    Eigen::VectorXd variance;       // of the mean, from the scatter of runs
    Eigen::MatrixXd dataCovariance; // of one measurement
    Eigen::MatrixXd slopes = {};    // change of the mean by one prior standard deviation of each fitted quantity
};

/// A value with its standard error.
struct Estimate
{
    double value = 0.0;
    double standardError = 0.0;
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

    double commonVariance(Eigen::Index feature) const
    {
        return errorSlopes.row(feature).squaredNorm();
    }
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
