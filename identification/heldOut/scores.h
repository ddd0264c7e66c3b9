#pragma once

#include <Eigen/Core>

#include <random>
#include <vector>

namespace clepsydra::identification
{

/// Prediction of one held-out condition.
struct Prediction
{
    Eigen::VectorXd mean;           // of the features
    Eigen::VectorXd variance;       // of the mean: scatter of runs and model error, without the error of the fit
    Eigen::MatrixXd dataCovariance; // of one measurement
};

/// A value with its standard error.
struct Estimate
{
    double value = 0.0;
    double standardError = 0.0;
};

struct HeldOutScore
{
    Estimate rmsLogError; // root mean square of measured minus predicted means, over conditions and log features
    Estimate crps;        // continuous ranked probability score, mean over measurements; smaller is better
};

/// Measurements of one held-out condition.
struct HeldOutData
{
    Eigen::MatrixXd features;         // one repeat per row
    Eigen::MatrixXd meanShare;        // result of shareOfMean
    Eigen::VectorXd declaredVariance; // of each value and of the mean, in addition to the scatter of repeats
    Eigen::MatrixXd errorSlopes;      // result of commonErrorSlopes: features x common errors

    double commonVariance(Eigen::Index feature) const
    {
        return errorSlopes.row(feature).squaredNorm();
    }
};

/// Continuous ranked probability score of a normal prediction: Gneiting & Raftery, J. Am. Stat. Assoc. 102, 359 (2007),
/// eq. 21.
double crpsOfNormal(double mean, double sd, double observed);

/// Draws of the measurement noise for all predictions that are compared. Each common error is equal in all conditions.
/// \return for each condition, the errors of the measured means, one draw per row
std::vector<Eigen::MatrixXd> drawDataNoise(const std::vector<HeldOutData>& data,
    const std::vector<Prediction>& predictions, int draws, std::mt19937_64& random);

/// Score of a prediction. Its standard errors come from draws of the errors of measured and simulated means.
/// \param features  for each condition, the features that enter the error
/// \param samples  if given, receives the draws of the rms error, for comparing predictions draw by draw
HeldOutScore heldOutScore(const std::vector<HeldOutData>& data, const std::vector<Prediction>& predictions,
    const std::vector<std::vector<Eigen::Index>>& features, const std::vector<Eigen::MatrixXd>& noise,
    std::mt19937_64& random, std::vector<double>* samples = nullptr);

} // namespace clepsydra::identification
