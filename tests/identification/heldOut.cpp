#include "heldOut/gaussianProcess.h"
#include "heldOut/scores.h"
#include "nextRuns/nextExperiment.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <random>

namespace clepsydra::identification::tests
{

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Comparison with the definition, the integral of (F(x) - [x > y])^2.
TEST(HeldOut, CrpsOfANormalPrediction)
{
    for (const double observed : {-1., 0.3, 2.5})
    {
        double integral = 0;
        for (double x = -12; x < 12; x += 1e-3)
        {
            const double f = 0.5 * std::erfc(-(x - 0.5) / (0.8 * std::sqrt(2.))) - (x > observed ? 1 : 0);
            integral += f * f * 1e-3;
        }
        EXPECT_NEAR(crpsOfNormal(0.5, 0.8, observed), integral, 1e-3);
    }
    EXPECT_EQ(crpsOfNormal(1, 0, 3), 2);
}

/// One held-out condition with one feature, measured as 0.2 ± 0.02 in four repeats and predicted as -0.3.
/// \param declared  variance in addition to the scatter of repeats
HeldOutScore scoreWith(double declared)
{
    std::mt19937_64 random(6);
    std::vector<HeldOutData> data(1);
    data[0].features = (Eigen::MatrixXd(4, 1) << 0.1, 0.3, 0.1, 0.3).finished();
    data[0].meanShare = Eigen::MatrixXd::Constant(1, 1, 0.25);
    data[0].declaredVariance = Eigen::VectorXd::Constant(1, declared);
    data[0].errorSlopes = Eigen::MatrixXd::Zero(1, 0);
    std::vector<Prediction> predictions(1);
    predictions[0].mean = Eigen::VectorXd::Constant(1, -0.3);
    predictions[0].variance = Eigen::VectorXd::Constant(1, 0.0003);
    predictions[0].dataCovariance = Eigen::MatrixXd::Constant(1, 1, 0.0004);
    const auto noise = drawDataNoise(data, predictions, 4000, random);
    return heldOutScore(data, predictions, {{0}}, noise, random);
}

/// Far from zero, the standard error of the rms error is sqrt(0.0004/4 + 0.0003) = 0.02, and with an additional
/// declared error sqrt(0.0004/4 + 0.0003 + 0.0012) = 0.04.
TEST(HeldOut, RmsErrorOfMeansAndItsStandardError)
{
    EXPECT_NEAR(scoreWith(0).rmsLogError.value, 0.5, 1e-12);
    EXPECT_NEAR(scoreWith(0).rmsLogError.standardError, 0.02, 0.001);
    EXPECT_NEAR(scoreWith(0.0012).rmsLogError.standardError, 0.04, 0.002);
}

/// One calibration error moves two features in two conditions by the same amount.
TEST(HeldOut, CommonErrorsAreShared)
{
    std::mt19937_64 random(6);
    HeldOutData one;
    one.features = Eigen::MatrixXd::Zero(1, 2);
    one.meanShare = Eigen::MatrixXd::Ones(2, 2);
    one.declaredVariance = Eigen::VectorXd::Zero(2);
    one.errorSlopes = Eigen::Vector2d(0.1, -0.2);
    Prediction exact{Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(2), Eigen::MatrixXd::Zero(2, 2)};
    const auto noise = drawDataNoise({one, one}, {exact, exact}, 4000, random);
    const Eigen::ArrayXd first = noise[0].col(0);
    EXPECT_NEAR(std::sqrt(first.square().mean()), 0.1, 0.005);
    EXPECT_LT((noise[0].col(1).array() + 2 * first).abs().maxCoeff(), 1e-5);
    EXPECT_LT((noise[1].col(0).array() - first).abs().maxCoeff(), 1e-5);
}

/// The process predicts a smooth function between its points, and stays at zero if the data are noise.
TEST(HeldOut, GaussianProcess)
{
    Eigen::MatrixXd at(7, 1);
    at << 0, 1, 2, 3, 4, 5, 6;
    const Eigen::VectorXd values = (at.array() / 2).sin();
    const GaussianProcess process(at, values, Eigen::VectorXd::Constant(7, 1e-6));
    EXPECT_NEAR(process(Eigen::VectorXd::Constant(1, 2.5)).mean, std::sin(1.25), 0.02);
    const GaussianProcess silent(at, 0.01 * values.reverse(), Eigen::VectorXd::Constant(7, 1.));
    EXPECT_NEAR(silent(Eigen::VectorXd::Constant(1, 2.5)).mean, 0, 0.005);
}

/// For two normal distributions of equal variance the mean divergence is half the squared distance. A feature that one
/// of them lacks does not count, and a larger uncertainty of one explanation reduces the divergence.
TEST(NextExperiment, DivergenceOfOutcomes)
{
    const PredictedOutcome a{"a", 0.6, Eigen::Vector2d(2, nan), Eigen::Vector2d(2, 1)};
    const PredictedOutcome b{"b", 0.4, Eigen::Vector2d(0, 5), Eigen::Vector2d(2, 1)};
    EXPECT_NEAR(divergence(a, b), 0.5, 1e-12);
    PredictedOutcome open = b;
    open.sd(0) = 4;
    EXPECT_LT(divergence(a, open), 2 * 0.5) << "the larger width reduces the divergence";
    EXPECT_NEAR(divergence(a, open), 0.25 * (0.25 + 4 - 2 + 4 * (0.25 + 0.0625)), 1e-12);
}

} // namespace

} // namespace clepsydra::identification::tests
