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

/// Against the definition: integral of (F(x) - [x > y])^2.
TEST(HeldOut, CrpsOfANormalPrediction)
{
    for (const double observed : {-1., .3, 2.5})
    {
        double integral = 0;
        for (double x = -12; x < 12; x += 1e-3)
        {
            const double f = .5 * std::erfc(-(x - .5) / (.8 * std::sqrt(2.))) - (x > observed ? 1 : 0);
            integral += f * f * 1e-3;
        }
        EXPECT_NEAR(crpsOfNormal(.5, .8, observed), integral, 1e-3);
    }
    EXPECT_EQ(crpsOfNormal(1, 0, 3), 2);
}

/// One held-out condition with one feature, measured .2 +- .02 four times and predicted as -.3. \param declared  variance
/// beyond repeats
HeldOutScore scoreWith(double declared)
{
    std::mt19937_64 random(6);
    std::vector<HeldOutData> data(1);
    data[0].features = (Eigen::MatrixXd(4, 1) << .1, .3, .1, .3).finished();
    data[0].meanShare = Eigen::MatrixXd::Constant(1, 1, .25);
    data[0].declaredVariance = Eigen::VectorXd::Constant(1, declared);
    data[0].errorSlopes = Eigen::MatrixXd::Zero(1, 0);
    std::vector<Prediction> predictions(1);
    predictions[0].mean = Eigen::VectorXd::Constant(1, -.3);
    predictions[0].variance = Eigen::VectorXd::Constant(1, .0003);
    predictions[0].dataCovariance = Eigen::MatrixXd::Constant(1, 1, .0004);
    const auto noise = drawDataNoise(data, predictions, 4000, random);
    return heldOutScore(data, predictions, {{0}}, noise, random);
}

/// Far from zero the error's own standard error: sqrt(.0004/4 + .0003) = .02, and with a declared one beside what repeats
/// show sqrt(.0004/4 + .0003 + .0012) = .04.
TEST(HeldOut, RmsErrorOfMeansAndItsStandardError)
{
    EXPECT_NEAR(scoreWith(0).rmsLogError.value, .5, 1e-12);
    EXPECT_NEAR(scoreWith(0).rmsLogError.standardError, .02, .001);
    EXPECT_NEAR(scoreWith(.0012).rmsLogError.standardError, .04, .002);
}

/// One calibration behind two features in two conditions: whatever it is, all numbers are moved by it alike.
TEST(HeldOut, CommonErrorsAreShared)
{
    std::mt19937_64 random(6);
    HeldOutData one;
    one.features = Eigen::MatrixXd::Zero(1, 2);
    one.meanShare = Eigen::MatrixXd::Ones(2, 2);
    one.declaredVariance = Eigen::VectorXd::Zero(2);
    one.errorSlopes = Eigen::Vector2d(.1, -.2);
    Prediction exact{Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(2), Eigen::MatrixXd::Zero(2, 2)};
    const auto noise = drawDataNoise({one, one}, {exact, exact}, 4000, random);
    const Eigen::ArrayXd first = noise[0].col(0);
    EXPECT_NEAR(std::sqrt(first.square().mean()), .1, .005);
    EXPECT_LT((noise[0].col(1).array() + 2 * first).abs().maxCoeff(), 1e-5);
    EXPECT_LT((noise[1].col(0).array() - first).abs().maxCoeff(), 1e-5);
}

/// On a smooth function it predicts between the points; on noise it stays at zero.
TEST(HeldOut, GaussianProcess)
{
    Eigen::MatrixXd at(7, 1);
    at << 0, 1, 2, 3, 4, 5, 6;
    const Eigen::VectorXd values = (at.array() / 2).sin();
    const GaussianProcess process(at, values, Eigen::VectorXd::Constant(7, 1e-6));
    EXPECT_NEAR(process(Eigen::VectorXd::Constant(1, 2.5)).mean, std::sin(1.25), .02);
    const GaussianProcess silent(at, .01 * values.reverse(), Eigen::VectorXd::Constant(7, 1.));
    EXPECT_NEAR(silent(Eigen::VectorXd::Constant(1, 2.5)).mean, 0, .005);
}

/// Two normals, the mean of both divergences: half the squared distance where they have one variance. A feature that one of
/// them lacks does not count, and what an explanation leaves open makes it decide less.
TEST(NextExperiment, DivergenceOfOutcomes)
{
    const PredictedOutcome a{"a", .6, Eigen::Vector2d(2, nan), Eigen::Vector2d(2, 1)};
    const PredictedOutcome b{"b", .4, Eigen::Vector2d(0, 5), Eigen::Vector2d(2, 1)};
    EXPECT_NEAR(divergence(a, b), .5, 1e-12);
    PredictedOutcome open = b;
    open.sd(0) = 4;
    EXPECT_LT(divergence(a, open), 2 * .5) << "its own width counts, too";
    EXPECT_NEAR(divergence(a, open), .25 * (.25 + 4 - 2 + 4 * (.25 + .0625)), 1e-12);
}

} // namespace

} // namespace clepsydra::identification::tests
