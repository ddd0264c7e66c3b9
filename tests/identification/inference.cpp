#include "heldOut/gaussianProcess.h"
#include "heldOut/scores.h"
#include "identifiability/identifiability.h"
#include "inference/evidence.h"
#include "inference/significance.h"
#include "nextExperiment/nextExperiment.h"
#include "noise/noise.h"
#include "noise/spread.h"
#include "study/measurements.h"

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

Eigen::MatrixXd normals(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// Two conditions with two features each, one parameter, two effects; noise of unit variance that is all but known.
struct Example
{
    ResidualProblem problem;
    Noise noise;

    Example()
    {
        noise.data.matrix = Eigen::MatrixXd::Identity(2, 2);
        noise.data.nu = 1e7;
        noise.simulation = noise.data;
        noise.modelError = Eigen::VectorXd::Zero(2);
        for (Eigen::Index c = 0; c < 2; ++c)
        {
            // Half the variance from the data's mean, half from the simulation's: together that of one run.
            problem.blocks.push_back({static_cast<std::size_t>(c), 2 * c, {0, 1}, 0.5 * Eigen::MatrixXd::Ones(2, 2),
                0.5, Eigen::VectorXd::Zero(2)});
        }
        problem.residual = Eigen::Vector4d(3, 1, 0, -1);
        problem.parameterColumns = Eigen::Vector4d(1, 1, 1, 1);
        problem.effectColumns.resize(4, 2);
        problem.effectColumns << 2, 1, 0, 1, 0, 1, 0, 1;
        problem.columnShare = Eigen::MatrixXd::Zero(2, 2);
        problem.parameterOffset = Eigen::VectorXd::Zero(1);
    }
};

//--- Noise ----------------------------------------------------------------------------------------------------------

/// Two groups with very different means: only the spread within them counts, with n - 1 in each.
TEST(Noise, PoolsSpreadWithinSettings)
{
    Scatter scatter;
    scatter.add((Eigen::MatrixXd(3, 1) << 1, 2, 3).finished());
    scatter.add((Eigen::MatrixXd(2, 1) << 100, 104).finished());
    EXPECT_EQ(scatter.degreesOfFreedom(), 3);
    // sums of squares: 2 and 8; per group s^2 = 1 and 8, averaged over 3 + 2 scaled rows: (3*1 + 2*8)/5
    EXPECT_NEAR(pooledCovariance(scatter.deviations(), 3).matrix(0, 0), 19. / 5, 1e-12);
}

/// With ample repeats nothing is shrunk; with few, true correlations are kept in part and false ones fall.
TEST(Noise, ShrinksCorrelationsOnlyWhereRepeatsAreFew)
{
    std::mt19937_64 random(1);
    const Covariance many = pooledCovariance(normals(400, 5, random), 400);
    EXPECT_EQ(many.shrinkage, 0);
    double before = 0;
    double after = 0;
    for (int trial = 0; trial < 50; ++trial)
    {
        const Eigen::MatrixXd rows = normals(8, 5, random);
        const Eigen::MatrixXd plain = rows.transpose() * rows / 8;
        const Covariance shrunk = pooledCovariance(rows, 8);
        EXPECT_GT(shrunk.shrinkage, 0);
        EXPECT_TRUE(shrunk.matrix.diagonal().isApprox(plain.diagonal()));
        before += (plain - Eigen::MatrixXd(plain.diagonal().asDiagonal())).squaredNorm();
        after += (shrunk.matrix - Eigen::MatrixXd(shrunk.matrix.diagonal().asDiagonal())).squaredNorm();
    }
    EXPECT_LT(after, 0.5 * before) << "the true correlations are zero";
}

/// Three repeats, one lacks the second feature: variances over 1/3 and 1/2, covariance over 2/(3*2).
TEST(Noise, MeansWithGaps)
{
    const Eigen::MatrixXd repeats = (Eigen::MatrixXd(3, 2) << 1, 10, 2, nan, 3, 14).finished();
    EXPECT_TRUE(meanFeatures(repeats).isApprox(Eigen::Vector2d(2, 12)));
    const Eigen::MatrixXd share = shareOfMean(repeats);
    EXPECT_NEAR(share(0, 0), 1. / 3, 1e-12);
    EXPECT_NEAR(share(1, 1), 1. / 2, 1e-12);
    EXPECT_NEAR(share(0, 1), 1. / 3, 1e-12);
}

TEST(Noise, DataOfTheirOwnWhereTheSimulatorHasNone)
{
    std::mt19937_64 random(2);
    Scatter data;
    data.add(normals(5, 2, random));
    Scatter silent;
    silent.add(Eigen::MatrixXd::Ones(4, 2));
    const Noise noise = noiseModel(data, silent, Eigen::VectorXd::Zero(2));
    EXPECT_FALSE(noise.pooled);
    EXPECT_TRUE(noise.simulation.matrix.isZero());
    EXPECT_THROW(noiseModel(Scatter(), Scatter(), Eigen::VectorXd::Zero(2)), std::runtime_error);
}

/// Four times the variance in the data is found, the same variance is not.
TEST(Noise, SpreadIsComparedWithChance)
{
    std::mt19937_64 random(3);
    Scatter simulation;
    Scatter alike;
    Scatter wider;
    simulation.add(normals(40, 3, random));
    alike.add(normals(12, 3, random));
    wider.add(2 * normals(12, 3, random));
    EXPECT_GT(compareSpread(alike, simulation, 1000, random).pValue, .01);
    const Spread spread = compareSpread(wider, simulation, 1000, random);
    EXPECT_LT(spread.pValue, .01);
    EXPECT_NEAR(spread.ratio, 4, 2);
}

/// Few repeats of features that go together are shrunk towards independent ones, which makes them look wider: not to be
/// taken for another spread. Drawn from independent features, most of the 100 cases were.
TEST(Noise, CorrelatedFeaturesHaveNoOtherSpread)
{
    std::mt19937_64 random(5);
    Eigen::MatrixXd together = Eigen::MatrixXd::Constant(5, 5, .95);
    together.diagonal().setOnes();
    const Eigen::MatrixXd root = together.llt().matrixU();
    int alarms = 0;
    for (int trial = 0; trial < 100; ++trial)
    {
        Scatter simulation;
        Scatter data;
        for (int condition = 0; condition < 4; ++condition)
        {
            simulation.add(normals(7, 5, random) * root);
            data.add(normals(3, 5, random) * root);
        }
        alarms += compareSpread(data, simulation, 300, random).pValue < .01 ? 1 : 0;
    }
    EXPECT_LE(alarms, 5);
}

/// One trajectory has no repeats: with a declared error of every number the noise is that, without it nothing can be said.
TEST(Noise, DeclaredWhereNothingWasRepeated)
{
    const double gap = std::nan("");
    MeasuredCondition once;
    once.features = (Eigen::MatrixXd(1, 3) << 1, gap, 2).finished();
    once.declaredError = (Eigen::VectorXd(3) << .1, 0, .2).finished();
    EXPECT_TRUE(hasDeclaredErrors(once));
    const Noise noise = noiseModel(Scatter(), Scatter(), Eigen::VectorXd::Zero(3), true, true);
    EXPECT_TRUE(noise.data.matrix.isZero());
    EXPECT_NEAR(intervalSds(noise), 1.96, .001);
    once.features(0, 1) = 3;
    EXPECT_FALSE(hasDeclaredErrors(once));
}

//--- Generalised least squares --------------------------------------------------------------------------------------

/// With prior sd 1: theta = sum(r)/(4 + 1) = 3/5, misfit = sum(r^2) - 9/5 = 9.2.
TEST(Fits, ParameterWithItsPrior)
{
    const Example example;
    const Fits fits(whitened(example.problem, example.noise));
    EXPECT_NEAR(fits.parameterShift()(0), .6, 1e-12);
    EXPECT_NEAR(fits.parameterCovariance()(0, 0), .2, 1e-12);
    EXPECT_NEAR(fits.nullMisfit(), 9.2, 1e-12);
}

/// e = (2,0,0,0): e.e - (e.J)^2/5 = 4 - 4/5; e.r - (e.J)(r.J)/5 = 6 - 6/5: a = 4.8/3.2 = 1.5, gain 4.8*1.5 = 7.2.
TEST(Fits, EffectBesideTheParameter)
{
    const Example example;
    const Fits fits(whitened(example.problem, example.noise));
    const auto free = fits.effect(0, -10, 10);
    EXPECT_NEAR(free.amplitude, 1.5, 1e-12);
    EXPECT_NEAR(free.sd, 1 / std::sqrt(3.2), 1e-12);
    EXPECT_NEAR(free.misfit, 2, 1e-12);
    const auto bounded = fits.effect(0, 0, 1);
    EXPECT_NEAR(bounded.amplitude, 1, 1e-12);
    EXPECT_NEAR(bounded.misfit, 2 + .25 * 3.2, 1e-12);
}

/// The second effect is the parameter itself: with a flat prior of the parameter it would be masked wholly, with sd 1 by
/// 4/5.
TEST(Fits, WhatAParameterHides)
{
    const Example example;
    const Identifiability table = identifiability(example.problem, example.noise, {Bounds{0, 1}, Bounds{0, 1}}, 4);
    EXPECT_NEAR(table.masked(1), .8, 1e-12);
    EXPECT_NEAR(table.masked(0), .2, 1e-12);
    EXPECT_NEAR(table.signal(0), std::sqrt(3.2), 1e-12);
    EXPECT_NEAR(table.smallestDetectable(0), (2 + .8416) / std::sqrt(3.2), 1e-9);
    // e0.e1 left: 2 - 2*4/5 = .4; of norms sqrt(3.2) and sqrt(.8): cos = .25
    EXPECT_NEAR(table.separability(0, 1), std::sqrt(3.2 * (1 - .0625)), 1e-12);
    EXPECT_NEAR(table.collinearity(0, 1), 1 / std::sqrt(.75), 1e-12);
}

/// The uncertainty of an effect's column, at its amplitude, adds to the noise.
TEST(Fits, UncertainColumnsWidenTheNoise)
{
    Example example;
    example.problem.columnShare(0, 0) = .25;
    EXPECT_NEAR(example.problem.covariance(0, example.noise)(0, 0), 1, 1e-12);
    const Eigen::Vector2d steps(2, 1);
    EXPECT_NEAR(example.problem.covariance(0, example.noise, steps)(0, 0), 2, 1e-12);
    EXPECT_NEAR(example.problem.covariance(1, example.noise, steps)(0, 0), 1, 1e-12);
}

//--- Evidence -------------------------------------------------------------------------------------------------------

/// For known noise: log of the mean of exp(-T(a)/2) over [-10, 10] = -T_min/2 + log(sqrt(2 pi) s/20).
TEST(Evidence, OccamFactorOfAWideRange)
{
    const Example example;
    const Score found = score(example.problem, example.noise, 0, {-10, 10});
    const double sd = 1 / std::sqrt(3.2);
    EXPECT_NEAR(found.amplitude, 1.5, 1e-12);
    EXPECT_NEAR(found.logEvidence, -1 + std::log(std::sqrt(2 * M_PI) * sd / 20), 1e-4);
    EXPECT_NEAR(nullEvidence(example.problem, example.noise), -4.6, 1e-4);
}

TEST(Evidence, AnchorAndSwitch)
{
    const Example example;
    // Simulated with the effect at .5 already: what is left is on top of it.
    EXPECT_NEAR(score(example.problem, example.noise, 0, {-10, 10}, .5).amplitude, 2, 1e-12);
    const Score on = score(example.problem, example.noise, 0, {0, 1}, 0, true);
    EXPECT_EQ(on.amplitude, 1);
    EXPECT_NEAR(on.misfit, 2.8, 1e-12);
    EXPECT_NEAR(on.logEvidence, -1.4, 1e-4);
}

/// "Something else" is any pattern: against a pattern of the library it loses by its Occam factor, against one that no
/// effect has it wins.
TEST(Evidence, SomethingElse)
{
    Example example;
    example.problem.effectColumns *= 4;
    const Eigen::VectorXd pattern = example.problem.effectColumns.col(0);
    example.problem.residual = .9 * pattern;
    EXPECT_LT(
        otherEvidence(example.problem, example.noise), score(example.problem, example.noise, 0, {0, 1}).logEvidence);
    example.problem.residual = Eigen::Vector4d(0, 6, -6, 0);
    EXPECT_GT(
        otherEvidence(example.problem, example.noise), score(example.problem, example.noise, 0, {0, 1}).logEvidence);
    EXPECT_GT(otherEvidence(example.problem, example.noise), nullEvidence(example.problem, example.noise));
}

/// Two effects that only together make the residual are found as a pair, with the amplitudes put in.
TEST(Evidence, Pairs)
{
    Example example;
    example.problem.effectColumns *= 10;
    example.problem.effectColumns.col(1) << 0, 10, -10, 0;
    example.problem.residual = .5 * example.problem.effectColumns.col(0) + .25 * example.problem.effectColumns.col(1);
    const auto pairs = pairScores(
        example.problem, example.noise, {Bounds{0, 1}, Bounds{0, 1}}, {false, false}, Eigen::Vector2d::Zero());
    ASSERT_EQ(pairs.size(), 1U);
    EXPECT_NEAR(pairs[0].firstAmplitude, .5, .02);
    EXPECT_NEAR(pairs[0].secondAmplitude, .25, .02);
    EXPECT_GT(pairs[0].logEvidence, score(example.problem, example.noise, 0, {0, 1}).logEvidence);
}

/// Two columns of the same effect, one of them a noisy estimate. As exact columns they part the pairs by more than any
/// threshold; with their uncertainty told, the pairs with one or the other are alike.
TEST(Evidence, PairsOfUncertainColumns)
{
    Example example;
    ResidualProblem& problem = example.problem;
    problem.effectColumns = Eigen::MatrixXd(4, 3);
    problem.effectColumns.col(0) << 10, 10, 10, -10;
    problem.effectColumns.col(1) << 0, 10, -10, 0;
    problem.effectColumns.col(2) << 1, 18, -8, -9;
    problem.columnShare = Eigen::MatrixXd::Zero(2, 3);
    problem.residual = problem.effectColumns.col(0) + .9 * problem.effectColumns.col(1);
    const auto margin = [&]() {
        const auto pairs = pairScores(
            problem, example.noise, std::vector<Bounds>(3, {0, 1}), std::vector<bool>(3), Eigen::Vector3d::Zero());
        EXPECT_EQ(pairs[0].first, 0);
        EXPECT_EQ(pairs[1].first, 0);
        return pairs[0].logEvidence - pairs[1].logEvidence;
    };
    EXPECT_GT(margin(), 3);
    problem.columnShare.rightCols(2).setConstant(50);
    EXPECT_LT(margin(), 3);
}

//--- Significance ---------------------------------------------------------------------------------------------------

/// Under pure noise, with the covariance estimated from few repeats, the p-value is uniform: a test that took the
/// estimate for the truth would reject 5 % far too often. 95 % Wilson interval of 300 trials.
TEST(Significance, PValueIsUniformUnderNoise)
{
    std::mt19937_64 random(4);
    Example example;
    example.noise.data.nu = example.noise.simulation.nu = 12;
    example.noise.pooled = true;
    const std::vector<Bounds> bounds = {{0, 1}, {-1, 1}};
    constexpr int trials = 300;
    int rejected = 0;
    int belowHalf = 0;
    for (int trial = 0; trial < trials; ++trial)
    {
        const auto drawn = noiseOnly(example.problem, example.noise, random);
        const auto estimated = example.noise.redrawn(random);
        const double p = significance(drawn, estimated, bounds, 200, random).pValue;
        rejected += p < .05 ? 1 : 0;
        belowHalf += p < .5 ? 1 : 0;
    }
    EXPECT_GE(rejected, 6);
    EXPECT_LE(rejected, 26);
    EXPECT_NEAR(belowHalf, trials / 2., 2.5 * std::sqrt(trials / 4.));
}

TEST(Significance, SeesAnEffect)
{
    std::mt19937_64 random(5);
    Example example;
    // Each draw of the noise takes that many repeats.
    example.noise.data.nu = example.noise.simulation.nu = 1000;
    example.problem.residual = Eigen::Vector4d(8, 0, 0, 0);
    const auto test = significance(example.problem, example.noise, {Bounds{0, 10}, Bounds{0, 1}}, 500, random);
    EXPECT_LT(test.pValue, .01);
    EXPECT_NEAR(test.omnibus, 64 - 64. / 5, 1e-9);
    // 99 % of chi-square: 4 rows + prior - parameter - effect = 3 degrees of freedom: 11.34
    EXPECT_NEAR(test.misfitLimit[0], 11.34, 2.5);
}

/// A pattern that is noticed in 80 % of the cases at the level of 1 %, with 4 degrees of freedom: by the noncentral
/// chi-square distribution its square is 16.75.
TEST(Significance, PatternThatIsNoticed)
{
    std::mt19937_64 random(6);
    Example example;
    example.noise.data.nu = example.noise.simulation.nu = 1000;
    const auto test = significance(example.problem, example.noise, {Bounds{0, 1}, Bounds{0, 1}}, 4000, random);
    EXPECT_NEAR(test.nullMisfitLimit, 13.28, 1.0);
    EXPECT_NEAR(test.noticed, 16.75, 1.5);
}

//--- Held out -------------------------------------------------------------------------------------------------------

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

/// A declared error counts beside what repeats show: sqrt(.0004/4 + .0003 + .0012) = .04.
TEST(HeldOut, DeclaredErrorsWidenTheStandardError)
{
    std::mt19937_64 random(6);
    const HeldOutData data{(Eigen::MatrixXd(4, 1) << .1, .3, .1, .3).finished(), Eigen::MatrixXd::Constant(1, 1, .25),
        Eigen::VectorXd::Constant(1, .0012)};
    const Prediction prediction{
        Eigen::VectorXd::Constant(1, -.3), Eigen::VectorXd::Constant(1, .0003), Eigen::MatrixXd::Constant(1, 1, .0004)};
    const DataNoise noise = drawDataNoise({data}, {prediction}, 4000, random);
    EXPECT_NEAR(heldOutScore({data}, {prediction}, {0}, noise, random).rmsLogError.standardError, .04, .002);
}

TEST(HeldOut, RmsErrorOfMeansAndItsStandardError)
{
    std::mt19937_64 random(6);
    const HeldOutData data{(Eigen::MatrixXd(4, 1) << .1, .3, .1, .3).finished(), Eigen::MatrixXd::Constant(1, 1, .25),
        Eigen::VectorXd::Zero(1)};
    const Prediction prediction{
        Eigen::VectorXd::Constant(1, -.3), Eigen::VectorXd::Constant(1, .0003), Eigen::MatrixXd::Constant(1, 1, .0004)};
    const DataNoise noise = drawDataNoise({data}, {prediction}, 4000, random);
    const auto found = heldOutScore({data}, {prediction}, {0}, noise, random);
    EXPECT_NEAR(found.rmsLogError.value, .5, 1e-12);
    // Far from zero the error's own standard error: sqrt(.0004/4 + .0003) = .02
    EXPECT_NEAR(found.rmsLogError.standardError, .02, .001);
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

//--- Next experiment ------------------------------------------------------------------------------------------------

/// KL of two normals with one covariance: half the squared distance; a feature that one of them lacks does not count.
TEST(NextExperiment, SeparationOfOutcomes)
{
    const Eigen::Matrix2d covariance = Eigen::Vector2d(4, 1).asDiagonal();
    EXPECT_NEAR(divergence(Eigen::Vector2d(2, 1), Eigen::Vector2d(0, 0), covariance), 1, 1e-12);
    EXPECT_NEAR(divergence(Eigen::Vector2d(2, nan), Eigen::Vector2d(0, 5), covariance), .5, 1e-12);
    const std::vector<PredictedOutcome> outcomes = {
        {"a", .6, Eigen::Vector2d(2, 1), {}}, {"b", .4, Eigen::Vector2d(0, 0), {}}};
    EXPECT_NEAR(separationOf(outcomes, covariance), .24, 1e-12);
}

/// Numbers measured once, and a simulator without scatter: what was declared is all the noise there is. Without it every
/// candidate would decide everything, or nothing.
TEST(NextExperiment, DeclaredErrorsAreNoise)
{
    Noise noise;
    noise.data.matrix = noise.simulation.matrix = Eigen::Matrix2d::Zero();
    noise.modelError = Eigen::Vector2d(0, .4);
    const std::vector<MeasuredCondition> measured = {
        {{}, Eigen::Vector2d(.1, .3), {}}, {}, {{}, Eigen::Vector2d(.2, 0), {}}};
    const Eigen::Matrix2d expected = Eigen::Vector2d(.04, .25).asDiagonal();
    EXPECT_TRUE(outcomeCovariance(noise, measured).isApprox(expected));
    noise.data.matrix = Eigen::Matrix2d::Constant(1);
    noise.simulation.matrix = 2 * Eigen::Matrix2d::Identity();
    EXPECT_TRUE(outcomeCovariance(noise, measured)
                    .isApprox(expected + Eigen::Matrix2d::Constant(1) + Eigen::Matrix2d::Identity()));
}

} // namespace

} // namespace clepsydra::identification::tests
