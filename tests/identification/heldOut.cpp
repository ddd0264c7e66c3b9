#include "emulator/distributions.h"
#include "heldOut/predictive.h"
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

/// Independent standard normal numbers.
Eigen::VectorXd normals(Eigen::Index count, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    return Eigen::VectorXd::NullaryExpr(count, [&] { return normal(random); });
}

/// By hand: a quantity z of variance 1, measured as 2 z + 1 ± 1 with the result 6, so that r = 5, z = 2/(4 + 1) 5 = 2 and
/// V = 1 - 4/5 = 0.2. The held-out feature was simulated as 3 at the fitted z = 1.5, with slope 3 and a variance of 0.5
/// of its own: mean 3 + 3 (2 - 1.5) = 4.5, variance 9 0.2 + 0.5 = 2.3. A measurement of 8 is 3.5^2/2.3 from it.
TEST(Predictive, OfOneSharedQuantity)
{
    const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
    const Eigen::VectorXd fitted = Eigen::VectorXd::Constant(1, 1.5);
    const Shared shared =
        sharedAfter({Eigen::VectorXd::Constant(1, 4), 2 * one, one}, Eigen::VectorXd::Constant(1, 6), fitted);
    EXPECT_NEAR(shared.mean(0), 2, 1e-12);
    EXPECT_NEAR(shared.covariance(0, 0), 0.2, 1e-12);
    const Predictive predicted = predict(shared, {Eigen::VectorXd::Constant(1, 3), 3 * one, 0.5 * one}, fitted, 1e6);
    EXPECT_NEAR(predicted.mean(0), 4.5, 1e-12);
    EXPECT_NEAR(predicted.covariance(0, 0), 2.3, 1e-12);
    EXPECT_NEAR(chiSquareOf(predicted, Eigen::VectorXd::Constant(1, 8)), 3.5 * 3.5 / 2.3, 1e-6);
    EXPECT_NEAR(chanceOf(predicted, Eigen::VectorXd::Constant(1, 8)), std::erfc(std::sqrt(3.5 * 3.5 / 2.3 / 2)), 1e-4);
    EXPECT_EQ(chanceOf(predicted, Eigen::VectorXd::Constant(1, 1000)), leastPValue);
}

/// With few degrees of freedom the same distance is less rare: for one feature, F(1, 4) is the square of Student's t, of
/// which 5 % are beyond 2.776.
TEST(Predictive, OfAnEstimatedCovariance)
{
    const Predictive predicted{Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Ones(1, 1), 4};
    EXPECT_NEAR(chanceOf(predicted, Eigen::VectorXd::Constant(1, 2.776)), 0.05, 1e-4);
}

/// A world of one parameter, one common error, the amplitude of an effect and noise, with 8 training and 5 held-out
/// features. The slopes are fixed numbers without any pattern.
struct LinearWorld
{
    static constexpr Eigen::Index trained = 8;
    static constexpr Eigen::Index heldOut = 5;

    LinearWorld()
    {
        std::mt19937_64 random(3);
        for (Eigen::Index i = 0; i < slopes.size(); ++i)
        {
            slopes(i) = normals(1, random)(0);
        }
    }

    /// Model with the parameter, the error and, in addition, some columns.
    std::pair<LinearModel, LinearModel> modelWith(const Eigen::MatrixXd& more) const
    {
        Eigen::MatrixXd all(trained + heldOut, 2 + more.cols());
        all << slopes.leftCols(2), more;
        const auto partOf = [&](Eigen::Index first, Eigen::Index size) {
            return LinearModel{Eigen::VectorXd::Zero(size), all.middleRows(first, size),
                noise * noise * Eigen::MatrixXd::Identity(size, size)};
        };
        return {partOf(0, trained), partOf(trained, heldOut)};
    }

    Predictive predicted(const Eigen::VectorXd& data, const Eigen::MatrixXd& more) const
    {
        const auto [training, unseen] = modelWith(more);
        const Eigen::VectorXd fitted = Eigen::VectorXd::Zero(training.slopes.cols());
        return predict(sharedAfter(training, data.head(trained), fitted), unseen, fitted, 1e6);
    }

    Eigen::VectorXd data(double amplitude, std::mt19937_64& random) const
    {
        return slopes.leftCols(2) * normals(2, random) + amplitude * slopes.col(2)
               + noise * normals(trained + heldOut, random);
    }

    const double noise = 0.3;
    Eigen::MatrixXd slopes = Eigen::MatrixXd(trained + heldOut, 3);
    const Eigen::MatrixXd nothing = Eigen::MatrixXd(trained + heldOut, 0);
};

/// If the prediction is right, 5 % of the measurements are beyond its 5 % limit. One that leaves the error of the fit or
/// the common error away is beyond it more often: more than 20 %.
TEST(Predictive, MeasurementsAreCovered)
{
    const LinearWorld world;
    std::mt19937_64 random(4);
    constexpr int sets = 2000;
    int beyond = 0;
    int beyondWithoutFit = 0;
    for (int i = 0; i < sets; ++i)
    {
        const Eigen::VectorXd data = world.data(0, random);
        const Eigen::VectorXd unseen = data.tail(LinearWorld::heldOut);
        Predictive predicted = world.predicted(data, world.nothing);
        beyond += chanceOf(predicted, unseen) < 0.05 ? 1 : 0;
        predicted.mean.setZero();
        predicted.covariance = world.modelWith(world.nothing).second.rest;
        beyondWithoutFit += chanceOf(predicted, unseen) < 0.05 ? 1 : 0;
    }
    EXPECT_NEAR(beyond, 0.05 * sets, 3 * std::sqrt(0.05 * sets));
    EXPECT_GT(beyondWithoutFit, 0.2 * sets);
}

/// Share of data sets in which a prediction with the columns `one` is significantly better than one with `other`.
double shareBetter(const LinearWorld& world, double amplitude, const Eigen::MatrixXd& one, const Eigen::MatrixXd& other)
{
    std::mt19937_64 random(5);
    constexpr int sets = 400;
    int better = 0;
    for (int i = 0; i < sets; ++i)
    {
        const Eigen::VectorXd data = world.data(amplitude, random);
        better += logRatio(world.predicted(data, one), world.predicted(data, other), data.tail(LinearWorld::heldOut),
                      300, random)
                          .isBeyondChance(0.05)
                      ? 1
                      : 0;
    }
    return static_cast<double>(better) / sets;
}

/// Without an effect at most 5 % of the data sets prefer one; with an effect that is three times the noise nearly all do.
/// A test that always or never prefers it fails here.
TEST(LogRatio, HasItsLevelAndItsPower)
{
    const LinearWorld world;
    const Eigen::MatrixXd effect = world.slopes.col(2);
    EXPECT_LT(shareBetter(world, 0, effect, world.nothing), 0.05 + 2 * std::sqrt(0.05 / 400));
    EXPECT_GT(shareBetter(world, 1.5, effect, world.nothing), 0.9);
}

/// A control that does the same as the effect predicts equally well, and the effect is not preferred. One that does the
/// same in the training data and nothing in the held-out ones is beaten.
TEST(LogRatio, AnEqualControlIsNotBeaten)
{
    const LinearWorld world;
    const Eigen::MatrixXd effect = world.slopes.col(2);
    Eigen::MatrixXd control = -effect;
    EXPECT_EQ(shareBetter(world, 1.5, effect, control), 0);
    control.bottomRows(LinearWorld::heldOut).setZero();
    EXPECT_GT(shareBetter(world, 1.5, effect, control), 0.9);
}

/// Both predictions are far from the measurement. The farther one makes the other's ratio rare, but never better.
TEST(LogRatio, AWorsePredictionIsNeverBetter)
{
    std::mt19937_64 random(6);
    const auto at = [](double mean) {
        return Predictive{Eigen::VectorXd::Constant(1, mean), Eigen::MatrixXd::Ones(1, 1), 1e6};
    };
    const LogRatio ratio = logRatio(at(-9), at(0), Eigen::VectorXd::Constant(1, -4), 1000, random);
    EXPECT_LT(ratio.pValue, 0.01);
    EXPECT_LT(ratio.value, 0);
    EXPECT_FALSE(ratio.isBeyondChance(0.05));
}

/// One held-out condition with one feature, measured as 0.2 ± 0.02 in four repeats and simulated as -0.3.
/// \param declared  variance in addition to the scatter of repeats
Estimate errorWith(double declared)
{
    std::mt19937_64 random(6);
    std::vector<HeldOutData> data(1);
    data[0].mean = Eigen::VectorXd::Constant(1, 0.2);
    data[0].meanShare = Eigen::MatrixXd::Constant(1, 1, 0.25);
    data[0].declaredVariance = Eigen::VectorXd::Constant(1, declared);
    data[0].errorSlopes = Eigen::MatrixXd::Zero(1, 0);
    std::vector<Prediction> predictions(1);
    predictions[0].mean = Eigen::VectorXd::Constant(1, -0.3);
    predictions[0].variance = Eigen::VectorXd::Constant(1, 0.0003);
    predictions[0].dataCovariance = Eigen::MatrixXd::Constant(1, 1, 0.0004);
    const auto noise = drawDataNoise(data, predictions, 4000, random);
    return rmsError(data, predictions, {{0}}, noise, random).first;
}

/// Far from zero, the standard error of the rms error is sqrt(0.0004/4 + 0.0003) = 0.02, and with an additional
/// declared error sqrt(0.0004/4 + 0.0003 + 0.0012) = 0.04.
TEST(HeldOut, RmsErrorOfMeansAndItsStandardError)
{
    EXPECT_NEAR(errorWith(0).value, 0.5, 1e-12);
    EXPECT_NEAR(errorWith(0).standardError, 0.02, 0.001);
    EXPECT_NEAR(errorWith(0.0012).standardError, 0.04, 0.002);
}

/// One calibration error moves two features in two conditions by the same amount.
TEST(HeldOut, CommonErrorsAreShared)
{
    std::mt19937_64 random(6);
    HeldOutData one;
    one.mean = Eigen::VectorXd::Zero(2);
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
    Eigen::MatrixXd at(8, 1);
    at << 0, 1, 2, 3, 4, 5, 6, 2.5;
    const auto predictedAt = [&](const Eigen::VectorXd& values, double variance) {
        const Eigen::MatrixXd noise = variance * Eigen::MatrixXd::Identity(7, 7);
        const Eigen::MatrixXd slopes = discrepancySlopes(at, values, noise, values.squaredNorm() / 7);
        const Eigen::VectorXd zero = Eigen::VectorXd::Zero(slopes.cols());
        const Shared shared = sharedAfter({Eigen::VectorXd::Zero(7), slopes.topRows(7), noise}, values, zero);
        return predict(shared, {Eigen::VectorXd::Zero(1), slopes.bottomRows(1), Eigen::MatrixXd::Zero(1, 1)}, zero, 1e6)
            .mean(0);
    };
    const Eigen::VectorXd values = (at.topRows(7).array() / 2).sin();
    EXPECT_NEAR(predictedAt(values, 1e-6), std::sin(1.25), 0.02);
    EXPECT_NEAR(predictedAt(0.01 * values.reverse(), 1), 0, 0.005);
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
