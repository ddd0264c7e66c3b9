/// The emulator learns coefficients with correct intervals, the noise, and the effects that raise it.
#include "emulator/covariance.h"
#include "emulator/emulator.h"
#include "linearSimulator.h"
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

std::vector<std::vector<Eigen::Index>> allFeatures(const Study& study)
{
    std::vector<std::vector<Eigen::Index>> features(study.conditions.size());
    for (const auto c : study.conditionsOf(Role::training))
    {
        for (Eigen::Index f = 0; f < study.featureCount(); ++f)
        {
            features[c].push_back(f);
        }
    }
    return features;
}

/// Two groups have very different means. Only the spread within each group counts, with n - 1 degrees of freedom.
TEST(Noise, PoolsSpreadWithinSettings)
{
    Scatter scatter;
    scatter.add((Eigen::MatrixXd(3, 1) << 1, 2, 3).finished());
    scatter.add((Eigen::MatrixXd(2, 1) << 100, 104).finished());
    EXPECT_EQ(scatter.freedom, 3);
    // The sums of squares are 2 and 8, and s^2 is 1 and 8; the mean over 3 + 2 scaled rows is (3*1 + 2*8)/5.
    EXPECT_NEAR(pooledCovariance(scatter).matrix(0, 0), 19. / 5, 1e-12);
}

/// With many repeats nothing is shrunk; with few, true correlations are kept in part and spurious ones decrease.
TEST(Noise, ShrinksCorrelationsOnlyWhereRepeatsAreFew)
{
    std::mt19937_64 random(1);
    const Eigen::MatrixXd many = normals(400, 5, random);
    EXPECT_TRUE(pooledCovariance({many, 400}).matrix.isApprox(many.transpose() * many / 400));
    double before = 0;
    double after = 0;
    for (int trial = 0; trial < 50; ++trial)
    {
        const Eigen::MatrixXd rows = normals(8, 5, random);
        const Eigen::MatrixXd plain = rows.transpose() * rows / 8;
        const Eigen::MatrixXd shrunk = pooledCovariance({rows, 8}).matrix;
        EXPECT_LT(std::abs(shrunk(1, 0)), std::abs(plain(1, 0)));
        EXPECT_TRUE(shrunk.diagonal().isApprox(plain.diagonal()));
        before += (plain - Eigen::MatrixXd(plain.diagonal().asDiagonal())).squaredNorm();
        after += (shrunk - Eigen::MatrixXd(shrunk.diagonal().asDiagonal())).squaredNorm();
    }
    EXPECT_LT(after, 0.5 * before) << "the true correlations are zero";
}

/// One of three repeats lacks the second feature: the factors are 1/3 and 1/2 for variances and 2/(3*2) for the
/// covariance.
TEST(Noise, MeansWithGaps)
{
    const Eigen::MatrixXd repeats = (Eigen::MatrixXd(3, 2) << 1, 10, 2, nan, 3, 14).finished();
    EXPECT_TRUE(meanFeatures(repeats).isApprox(Eigen::Vector2d(2, 12)));
    const Eigen::MatrixXd share = shareOfMean(repeats);
    EXPECT_NEAR(share(0, 0), 1. / 3, 1e-12);
    EXPECT_NEAR(share(1, 1), 1. / 2, 1e-12);
    EXPECT_NEAR(share(0, 1), 1. / 3, 1e-12);
}

/// Each product of parameters and effects has its own term.
TEST(Basis, TermsAreEachThere)
{
    const Basis basis{2, {3, 5, 8}, {}};
    const Eigen::Vector2d t(2, 3);
    const Eigen::Vector3d a(5, 7, 11);
    const Eigen::VectorXd terms = basis.at(t, a);
    EXPECT_EQ(terms.size(), basis.size());
    EXPECT_EQ((terms.array() == 0).count(), 1);
    EXPECT_EQ(terms(basis.designTerm()), 0);
    EXPECT_EQ(terms(parameterTerm(2, 0, 1)), 6);
    EXPECT_EQ(terms(basis.effectTerm(1)), 7);
    EXPECT_EQ(terms(basis.effectTerm(1) + 1), 49);
    EXPECT_EQ(terms(basis.effectTerm(2) + 3), 33);
    EXPECT_EQ(terms(basis.pairTerm(2, 0)), 55);
    EXPECT_EQ(terms(basis.pairTerm(1, 2)), 77);
    EXPECT_EQ(basis.kind(basis.pairTerm(0, 1)), Basis::interaction);
    EXPECT_EQ(basis.kind(basis.effectTerm(2) + 2), Basis::mixed);
    EXPECT_EQ(basis.placeOf(5), 1U);
    EXPECT_EQ(basis.placeOf(4), 3U);
}

/// Parameters at the means of their priors.
const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);

TEST(Emulator, FindsLinearEffects)
{
    for (const std::string seed : {"seed", "none"})
    {
        const TemporaryFolder folder;
        const Study study = linearStudy(folder, seed);
        LinearSimulator simulator;
        StudySimulator studySimulator(study, simulator);
        const Library library = makeLibrary(studySimulator);
        const Emulator emulator(study, studySimulator, library.runs, allFeatures(study));
        const ConditionEmulator& both = *emulator[0];
        const Eigen::VectorXd base = both.at(none, {});
        EXPECT_NEAR(base(0), std::log(0.1), 1e-3);
        EXPECT_NEAR(both.at(Eigen::VectorXd::Ones(1), {})(0) - base(0), 0.04, 1e-3);
        EXPECT_NEAR(both.at(none, {{0, 1.}})(0) - base(0), 0.06, 1e-3);
        EXPECT_NEAR(both.at(none, {{0, -0.5}})(0) - base(0), -0.03, 1e-3);
        EXPECT_NEAR(both.at(none, {{1, 1.}})(0) - base(0), 0.2, 1e-3);
        EXPECT_NEAR(both.at(none, {{2, 1.}})(0) - base(0), -std::log(1.01), 1e-3);
        EXPECT_NEAR(emulator[1]->at(none, {{1, 1.}})(0), emulator[1]->at(none, {})(0), 1e-12) << "y acts in water only";
        EXPECT_FALSE(emulator[2]) << "the condition is held out";
    }
}

/// An effect of the measuring chain changes a feature by more or less as the parameters go: a drift of s adds s t to the
/// mass, so that ln W changes by ln(1 - s/W), and W itself follows friction. At one standard deviation of friction W is
/// 0.1 exp(0.04), and a drift of 0.02 changes ln W by -0.2134, not by -0.2231 as at the prior's mean. A slope that is left
/// out gives the latter, one with the wrong sign -0.2328.
TEST(Emulator, ChainEffectsFollowTheParameters)
{
    const TemporaryFolder folder;
    Study study = linearStudy(folder, "none");
    study.effects[2].chainOperation = "drift";
    study.effects[2].chainSize = Expression("0.02*a");
    LinearSimulator simulator;
    StudySimulator studySimulator(study, simulator);
    const Library library = makeLibrary(studySimulator);
    const Emulator emulator(study, studySimulator, library.runs, allFeatures(study));
    for (const double t : {-1., 0., 1.})
    {
        const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, t);
        const double expected = std::log(1 - 0.2 * std::exp(-0.04 * t));
        EXPECT_NEAR(emulator[0]->at(at, {{2, 1.}})(0) - emulator[0]->at(at, {})(0), expected, 2e-3) << t;
    }
}

/// A parameter of an effect has no influence without the effect, and half its influence at half the amplitude. A
/// library that changed the parameter without the effect would learn nothing about it.
TEST(Emulator, ParameterOfAnEffect)
{
    for (const std::string seed : {"seed", "none"})
    {
        const TemporaryFolder folder;
        const Study study = linearStudy(folder, seed,
            "  - { name: edge, of: x, set: { edge: edge }, prior: { mean: 0, sd: 0.2, from: measured }, range: [-1, 1] "
            "}\n");
        LinearSimulator simulator;
        StudySimulator studySimulator(study, simulator);
        const Library library = makeLibrary(studySimulator);
        const Emulator emulator(study, studySimulator, library.runs, allFeatures(study));
        const auto effectOfEdge = [&](const std::vector<Present>& present) {
            const Eigen::MatrixXd mean = emulator[0]->mean(present, Eigen::Vector2d(0, 0));
            const Eigen::VectorXd moved = parameterTermsAt(Eigen::Vector2d(0, 1));
            EXPECT_NEAR((mean * moved)(0),
                (emulator[0]->centre.transpose()
                    + emulator[0]->terms(Eigen::Vector2d(0, 1), present).transpose() * emulator[0]->coefficients
                          * emulator[0]->root.transpose())(0),
                1e-12);
            return (mean * moved)(0) - mean(0, 0);
        };
        EXPECT_NEAR(effectOfEdge({{0, 1.}}), 0.06 * 0.2, 1e-3);
        EXPECT_NEAR(effectOfEdge({{0, 0.5}}), 0.03 * 0.2, 1e-3);
        EXPECT_EQ(effectOfEdge({}), 0);
        EXPECT_EQ(effectOfEdge({{1, 1.}}), 0);
    }
}

/// The strong curvature of one effect does not change the estimates of the others.
TEST(Emulator, CurvatureOfOneEffectIsNoOtherEffect)
{
    const TemporaryFolder folder;
    const Study study = linearStudy(folder, "none");
    LinearSimulator simulator;
    simulator.curvature = 200;
    StudySimulator studySimulator(study, simulator);
    const Library library = makeLibrary(studySimulator);
    const Emulator emulator(study, studySimulator, library.runs, allFeatures(study));
    const double base = emulator[0]->at(none, {})(0);
    EXPECT_NEAR(emulator[0]->at(none, {{0, 1.}})(0) - base, 0.06 + 0.08, 2e-3);
    EXPECT_NEAR(emulator[0]->at(none, {{0, -1.}})(0) - base, -0.06 + 0.08, 2e-3);
    EXPECT_NEAR(emulator[0]->at(none, {{1, 1.}})(0) - base, 0.2, 2e-3);
}

/// A failed run is repeated with other seeds, then excluded, and both are reported. An effect whose runs have all
/// failed is not judged: with an unknown influence it would be the first member of sets.
TEST(Emulator, FailedRunsAreReportedAndExcluded)
{
    const TemporaryFolder folder;
    const Study study = linearStudy(folder, "none");
    LinearSimulator simulator;
    simulator.failsWithY = true;
    StudySimulator studySimulator(study, simulator);
    const Library library = makeLibrary(studySimulator);
    const Emulator emulator(study, studySimulator, library.runs, allFeatures(study));
    EXPECT_FALSE(emulator.knows(1));
    EXPECT_TRUE(emulator.knows(0));
    EXPECT_NEAR(emulator[0]->at(none, {{0, 1.}})(0) - emulator[0]->at(none, {})(0), 0.06, 1e-3);
    ASSERT_EQ(emulator.remarks().size(), 1U);
    EXPECT_NE(emulator.remarks().front().find('y'), std::string::npos);
    ASSERT_EQ(studySimulator.effort().failures.size(), 2U);
    EXPECT_EQ(studySimulator.effort().failures.back().reason, "y is not possible");
}

/// Emulators of runs with known coefficients and a noise of 0.1, which differs from emulator to emulator.
struct NoisyBench
{
    const TemporaryFolder folder;
    const Study study = linearStudy(folder, "seed");
    LinearSimulator simulator;
    const StudySimulator studySimulator{study, simulator};
    std::mt19937_64 random{3};

    Emulator learn()
    {
        std::normal_distribution<double> normal;
        std::vector<Simulation> runs;
        for (const auto& order : libraryOrders(studySimulator))
        {
            const double t = (order.setting.parameters(0) - 0.15) / 0.02;
            const Eigen::VectorXd& a = order.setting.amplitudes;
            Simulation run;
            run.condition = order.condition;
            run.setting = order.setting;
            run.features = Eigen::VectorXd::Constant(1, 0.3 * t + 0.5 * a(0) - 0.4 * a(1) + 0.1 * normal(random));
            run.plain.time = {0, 1};
            run.plain.value = {1, 0};
            runs.push_back(run);
        }
        return {study, studySimulator, runs, allFeatures(study)};
    }
};

/// The errors of the emulator agree with its own estimates of them.
TEST(Emulator, IntervalsCover)
{
    NoisyBench bench;
    double squares = 0;
    double count = 0;
    for (int trial = 0; trial < 60; ++trial)
    {
        const Emulator emulator = bench.learn();
        const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, 0.5);
        const std::vector<Present> present = {{0, 0.7}};
        const double error = emulator[0]->at(at, present)(0) - 0.15 - 0.35;
        squares += error * error / emulator[0]->uncertainty(at, present)(0, 0);
        count += 1;
    }
    EXPECT_GT(squares / count, 0.4);
    EXPECT_LT(squares / count, 2.);
}

/// The noise is estimated from few repeats. If posterior draws took it as known, data without effects would too often
/// show a residual.
TEST(Emulator, PosteriorDrawsVaryTheNoise)
{
    NoisyBench bench;
    const Emulator emulator = bench.learn();
    const double error = emulator[0]->logSdError;
    ASSERT_GT(error, 0.02);
    double squares = 0;
    constexpr int draws = 400;
    for (int i = 0; i < draws; ++i)
    {
        const Emulator draw = emulator.posteriorDraw(bench.random);
        squares += std::pow(0.5 * std::log(draw[0]->noise(0, 0) / emulator[0]->noise(0, 0)), 2);
    }
    EXPECT_NEAR(std::sqrt(squares / draws), error, 0.15 * error);
}

/// Repeats with y scatter four times as much. This is found without a declaration, and the noise without y does not
/// change.
TEST(Emulator, FindsEffectsThatRaiseTheScatter)
{
    const TemporaryFolder folder;
    Study study = linearStudy(folder, "seed");
    study.effects[1].isSwitch = true;
    study.settings.repeatsAlone = 8;
    LinearSimulator simulator;
    const StudySimulator studySimulator(study, simulator);
    std::mt19937_64 random(4);
    std::normal_distribution<double> normal;
    std::vector<Simulation> runs;
    for (const auto& order : libraryOrders(studySimulator))
    {
        const double y = order.setting.amplitudes(1);
        Simulation run;
        run.condition = order.condition;
        run.setting = order.setting;
        run.features = Eigen::VectorXd::Constant(1, y + 0.1 * (1 + 3 * y) * normal(random));
        run.plain.time = {0, 1};
        run.plain.value = {1, 0};
        runs.push_back(run);
    }
    const Emulator emulator(study, studySimulator, runs, allFeatures(study));
    ASSERT_EQ(emulator[0]->logScatter.count(1), 1U);
    EXPECT_GT(emulator[0]->logScatter.at(1)(0), 0.7);
    EXPECT_LT(std::sqrt(emulator[0]->noise(0, 0)), 0.2);
    EXPECT_EQ(emulator[0]->logScatter.count(0), 0U);
}

/// A run in condition 0 with effect 1 alone.
Simulation runOfEffect(const StudySimulator& studySimulator, double amplitude, double feature)
{
    Simulation run;
    run.setting = studySimulator.plainSetting();
    run.setting.amplitudes(1) = amplitude;
    run.features = Eigen::VectorXd::Constant(1, feature);
    run.plain.time = {0, 1};
    run.plain.value = {1, 0};
    return run;
}

/// Repeats at half the amplitude have the square root of the factor, and several groups of repeats in one condition count
/// together. Taking each group for one at amplitude 1 gives half the logarithm here.
TEST(Emulator, ScatterGrowsWithTheAmplitude)
{
    const TemporaryFolder folder;
    Study study = linearStudy(folder, "seed");
    study.effects[1].raisesScatter = true;
    LinearSimulator simulator;
    const StudySimulator studySimulator(study, simulator);
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    std::vector<Simulation> runs;
    const auto add = [&](double amplitude) {
        runs.push_back(runOfEffect(studySimulator, amplitude, 0.1 * std::exp(1.2 * amplitude) * normal(random)));
    };
    for (int repeat = 0; repeat < 200; ++repeat)
    {
        add(0.0);
        add(0.5);
        add(0.25);
    }
    const Emulator emulator(study, studySimulator, runs, allFeatures(study));
    EXPECT_NEAR(emulator[0]->logScatter.at(1)(0), 1.2, 0.3);
}

/// Two repeats at an amplitude of 0.025 that differ by 5.7 standard deviations of the noise. Extrapolated to amplitude 1 the
/// scatter would be e^90 times as large, and data drawn with it would be infinite.
TEST(Emulator, TwoRunsOfASmallAmplitudeSayLittleOfTheScatter)
{
    const TemporaryFolder folder;
    const Study study = linearStudy(folder, "seed");
    LinearSimulator simulator;
    const StudySimulator studySimulator(study, simulator);
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    std::vector<Simulation> runs;
    for (int repeat = 0; repeat < 200; ++repeat)
    {
        runs.push_back(runOfEffect(studySimulator, 0.0, 0.1 * normal(random)));
    }
    runs.push_back(runOfEffect(studySimulator, 0.025, 0.0));
    runs.push_back(runOfEffect(studySimulator, 0.025, 0.8));
    const Emulator emulator(study, studySimulator, runs, allFeatures(study));
    ASSERT_EQ(emulator[0]->logScatter.count(1), 1U);
    EXPECT_GT(emulator[0]->logScatter.at(1)(0), 0.0);
    EXPECT_LT(emulator[0]->logScatter.at(1)(0), 1.0);
}

/// ln W = 3 x + ...: an error of 0.01 in x gives 0.03, and a gain of 2 % gives 0.02. An effect that was measured to a
/// tenth of its size is an error of a tenth.
TEST(CommonErrors, SlopesAreThoseOfTheSimulator)
{
    const TemporaryFolder folder;
    Study study = linearStudy(folder, "none");
    study.commonErrors.resize(4);
    for (auto& error : study.commonErrors)
    {
        error.conditions = {0};
    }
    study.commonErrors[0].entries.emplace("x", Expression("x + 0.01*z"));
    study.commonErrors[1].chainOperation = "gain";
    study.commonErrors[1].chainSize = Expression("0.02*z");
    // Effects that were measured with a gauge, as amplitudes
    study.commonErrors[2].entries.emplace("x", Expression("x + 0.1*a"));
    study.commonErrors[3].chainOperation = "gain";
    study.commonErrors[3].chainSize = Expression("0.2*a");
    for (const std::size_t gauged : {2U, 3U})
    {
        study.commonErrors[gauged].variable = "a";
        study.commonErrors[gauged].unit = 0.1;
    }
    LinearSimulator simulator;
    StudySimulator studySimulator(study, simulator);
    const Library library = makeLibrary(studySimulator);
    EXPECT_NEAR(library.errorSlopes[0](0, 0), 0.03, 1e-6);
    EXPECT_NEAR(library.errorSlopes[0](0, 1), 0.02, 1e-4);
    EXPECT_NEAR(library.errorSlopes[0](0, 2), 0.03, 1e-6);
    EXPECT_NEAR(library.errorSlopes[0](0, 3), 0.02, 1e-4);
    EXPECT_TRUE(library.errorSlopes[1].isZero()) << "the errors belong to the other condition";
}

/// ln W = 5 y: a run with y below 0 fails, so that the slope is taken from the other side. An error whose runs all fail
/// would be taken as 0, and is refused.
TEST(CommonErrors, FailedRunsAreNoSlopeOfZero)
{
    const TemporaryFolder folder;
    Study study = linearStudy(folder, "none");
    CommonError& error = study.commonErrors.emplace_back();
    error.name = "height";
    error.conditions = {0};
    error.entries.emplace("y", Expression("y + 0.01*z"));
    LinearSimulator simulator;
    StudySimulator studySimulator(study, simulator);
    simulator.failsWithNegativeY = true;
    EXPECT_NEAR(makeLibrary(studySimulator).errorSlopes[0](0, 0), 0.05, 1e-6);
    simulator.failsWithY = true;
    try
    {
        makeLibrary(studySimulator);
        FAIL() << "accepted";
    }
    catch (const std::runtime_error& problem)
    {
        EXPECT_THAT(problem.what(), ::testing::HasSubstr("all runs with the common error 'height' have failed"));
        EXPECT_THAT(problem.what(), ::testing::HasSubstr("y is not possible"));
    }
}

} // namespace

} // namespace clepsydra::identification::tests
