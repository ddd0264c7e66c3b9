#pragma once

#include <Eigen/Core>

#include <random>
#include <vector>

namespace clepsydra::identification
{

/// One held-out condition under one prediction.
struct Prediction
{
    Eigen::VectorXd mean;           // of the features
    Eigen::VectorXd variance;       // of the mean: seeds, the simulation's own error; not that of the fit
    Eigen::MatrixXd dataCovariance; // of one measurement
};

/// A number with its standard error.
struct Estimate
{
    double value = 0.0;
    double standardError = 0.0;
};

struct HeldOutScore
{
    Estimate rmsLogError; // root mean square, over conditions and log features, of measured minus predicted means
    Estimate crps;        // continuous ranked probability score, mean over measurements; smaller is better
};

/// What was measured there.
struct HeldOutData
{
    Eigen::MatrixXd features;         // repeats by rows
    Eigen::MatrixXd meanShare;        // see shareOfMean
    Eigen::VectorXd declaredVariance; // of each value and of the mean, beyond repeats
    Eigen::MatrixXd errorSlopes;      // features by common errors, as commonErrorSlopes gives them

    double commonVariance(Eigen::Index feature) const
    {
        return errorSlopes.row(feature).squaredNorm();
    }
};

/// CRPS of a normal prediction: Gneiting & Raftery, J. Am. Stat. Assoc. 102, 359 (2007), eq. 21.
double crpsOfNormal(double mean, double sd, double observed);

/// Draws of measurement noise, common to all predictions that are compared; common errors are the same in all conditions. By
/// condition: one of the mean's error per row.
std::vector<Eigen::MatrixXd> drawDataNoise(const std::vector<HeldOutData>& data,
    const std::vector<Prediction>& predictions, int draws, std::mt19937_64& random);

/// Score of a prediction with standard errors by redrawing what is uncertain: the measured means and the simulated ones.
/// \param features  by condition: those that enter the error; measured, and predicted by all that are compared
/// \param samples  if given, the draws of the rms error, to compare predictions draw by draw
HeldOutScore heldOutScore(const std::vector<HeldOutData>& data, const std::vector<Prediction>& predictions,
    const std::vector<std::vector<Eigen::Index>>& features, const std::vector<Eigen::MatrixXd>& noise,
    std::mt19937_64& random, std::vector<double>* samples = nullptr);

} // namespace clepsydra::identification
