/// From data to an answer, and from an answer to the held-out conditions.
#include "decision/pairs.h"
#include "effectOf.h"
#include "emulator/settings.h"
#include "heldOut/heldOut.h"
#include "linearSimulator.h"
#include "procedure/trace.h"
#include "surrogate/surrogate.h"
#include "study/readStudy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

namespace clepsydra::identification::tests
{

namespace
{

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The linear simulator with its effect library. \param scatters  whether its runs do
struct Bench
{
    explicit Bench(bool scatters = true)
        : simulator(scatters)
    {}

    TemporaryFolder folder;
    Study study = linearStudy(folder, "seed");
    LinearSimulator simulator;
    StudySimulator studySimulator{study, simulator};
    Library library = makeLibrary(studySimulator);
    std::vector<MeasuredCondition> nothing{study.conditions.size()};
    std::mt19937_64 random{1};
};

/// Held-out measurements may be in memory, as in checkIdentification: whatever they are, the answer is the same.
TEST(Trace, HeldOutDataTellNothing)
{
    const auto answerWith = [](double heldOut) {
        Bench bench;
        std::vector<MeasuredCondition> data(bench.study.conditions.size());
        for (std::size_t c = 0; c < data.size(); ++c)
        {
            const double scatter = bench.study.conditions[c].role == Role::heldOut ? heldOut : .01;
            data[c].features = (Eigen::MatrixXd(3, 1) << -2.3 - scatter, -2.3, -2.3 + scatter).finished();
            data[c].declaredError = Eigen::VectorXd::Zero(1);
        }
        return trace(bench.studySimulator, bench.library, data, bench.random);
    };
    const Answer one = answerWith(.01);
    const Answer other = answerWith(1);
    EXPECT_EQ(one.pValue, other.pValue);
    EXPECT_EQ(one.logOdds, other.logOdds);
    EXPECT_EQ(one.layout.noise(0, 0), other.layout.noise(0, 0));
}

/// What the data could have shown is found beside the answer and changes nothing of it.
TEST(Trace, LookingChangesNothing)
{
    const auto answerWith = [](bool withVisibility) {
        Bench bench;
        std::vector<MeasuredCondition> data(bench.study.conditions.size());
        for (auto& condition : data)
        {
            condition.features = (Eigen::MatrixXd(3, 1) << -2.31, -2.30, -2.29).finished();
            condition.declaredError = Eigen::VectorXd::Zero(1);
        }
        const Answer answer = trace(bench.studySimulator, bench.library, data, bench.random, withVisibility);
        return std::tuple(answer.visibility.detected.size(), answer.logOdds, bench.random());
    };
    const auto [seen, logOdds, next] = answerWith(true);
    EXPECT_EQ(seen, 3);
    EXPECT_EQ(answerWith(false), std::tuple(0, logOdds, next));
}

/// Where every run at the null fit fails nothing is left to be compared, and "no residual" would be a lie.
TEST(Trace, NoAnswerWithoutSimulations)
{
    Bench bench;
    std::vector<MeasuredCondition> data(bench.study.conditions.size());
    for (auto& condition : data)
    {
        condition.features = (Eigen::MatrixXd(3, 1) << -2.31, -2.30, -2.29).finished();
        condition.declaredError = Eigen::VectorXd::Zero(1);
    }
    EXPECT_NO_THROW(trace(bench.studySimulator, bench.library, data, bench.random));
    bench.simulator.failsAlways = true;
    try
    {
        trace(bench.studySimulator, bench.library, data, bench.random);
        FAIL() << "an answer from nothing";
    }
    catch (const std::runtime_error& error)
    {
        EXPECT_THAT(error.what(), HasSubstr("null fit"));
        EXPECT_THAT(error.what(), HasSubstr("the power is off"));
    }
}

/// Where runs do not scatter draws may be as odd as any data: then a chiSquare of 470 in a few numbers was called "no residual".
TEST(Trace, AChiSquareBeyondNoiseIsAResidual)
{
    for (const std::string seed : {"none", "seed"})
    {
        const TemporaryFolder folder;
        const Study study = linearStudy(folder, seed);
        LinearSimulator simulator(seed == "seed");
        StudySimulator studySimulator(study, simulator);
        const Library library = makeLibrary(studySimulator);
        std::vector<MeasuredCondition> data(study.conditions.size());
        for (auto& condition : data)
        {
            condition.features = (Eigen::MatrixXd(6, 1) << -2.31, -2.30, -2.29, -2.31, -2.30, -2.29).finished();
            condition.declaredError = Eigen::VectorXd::Zero(1);
        }
        const Emulator emulator(study, studySimulator, library.runs, measuredFeatures(study, data));
        const Layout layout = arrange(study, emulator, data).first;
        const Evidence evidence(study, emulator, layout, Eigen::VectorXd::Zero(1));
        EXPECT_DOUBLE_EQ(evidence.chanceOfChiSquare(0), 1);
        if (seed == "none")
        {
            EXPECT_NEAR(evidence.chanceOfChiSquare(2), 0.4, 0.05) << "as large as there are numbers: nothing odd";
            EXPECT_LT(evidence.chanceOfChiSquare(470), 1e-6);

            // The same by the answer and by what could have been seen, whatever draws without any effect look like.
            Calibration calibration;
            calibration.nullStatistics.assign(99, 1e9);
            calibration.critical = 1e9;
            calibration.membership = calibration.chiSquares = calibration.scatterChiSquares = calibration.naming =
                Eigen::VectorXd::Zero(static_cast<Eigen::Index>(study.effects.size()));
            Odds odds;
            odds.chanceOfChiSquare = .02;
            EXPECT_TRUE(isDetected(study, calibration, odds));
            odds.chanceOfChiSquare = .03;
            EXPECT_FALSE(isDetected(study, calibration, odds)) << "of two questions";
            std::mt19937_64 random(1);
            const Measured measured = arrange(study, emulator, data).second;
            Replicas replicas(emulator, layout, evidence, random);
            const Visibility seen = visibility(study, evidence, replicas, calibration, measured, random);
            EXPECT_LT(seen.detected(static_cast<Eigen::Index>(effectOf(study, "y"))), 1);
        }
        else
        {
            EXPECT_DOUBLE_EQ(evidence.chanceOfChiSquare(470), 1) << "left to draws, which have the runs' noise";
        }
    }
}

/// Where runs do not scatter, noise is that of repeats: what was measured once beside others that have repeats is not exact.
TEST(Trace, NothingMeasuredIsExact)
{
    const TemporaryFolder folder;
    Study study = linearStudy(folder, "none");
    study.features.push_back(study.features.front());
    study.features.back().name = "once";
    study.modelError = Eigen::VectorXd::Zero(2);
    LinearSimulator simulator;
    StudySimulator studySimulator(study, simulator);
    const Library library = makeLibrary(studySimulator);
    std::vector<MeasuredCondition> data(study.conditions.size());
    for (auto& condition : data)
    {
        condition.features = (Eigen::MatrixXd(3, 2) << -2.31, -2.3, -2.30, NAN, -2.29, NAN).finished();
        condition.declaredError = Eigen::VectorXd::Zero(2);
    }
    const Emulator emulator(study, studySimulator, library.runs, measuredFeatures(study, data));
    try
    {
        arrange(study, emulator, data);
        FAIL() << "a number without an error";
    }
    catch (const std::runtime_error& error)
    {
        EXPECT_THAT(error.what(), HasSubstr("condition 'both': 'once'"));
    }
    study.modelError(1) = .01;
    const double noise = arrange(study, emulator, data).first.noise(0, 0);
    EXPECT_NEAR(noise, 1e-4, 1e-9);
    // What is planned has no scatter of its own, and must not make less of the others'.
    data[1].features.setConstant(-2.3);
    data[1].isPlanned = true;
    EXPECT_NEAR(arrange(study, emulator, data).first.noise(0, 0), noise, 1e-9);
}

/// What an effect does friction does as well: how far it is open is friction's error, too. Of a standard normal number between
/// -1.5 and 1.5, which is what an amplitude between 1 and -1 leaves of friction.
TEST(Trace, ParametersKnowLessBesideTheirLike)
{
    const TemporaryFolder folder;
    Study study = linearStudy(folder, "none");
    study.modelError = Eigen::VectorXd::Constant(1, .001);
    LinearSimulator simulator;
    StudySimulator studySimulator(study, simulator);
    const Library library = makeLibrary(studySimulator);
    std::vector<MeasuredCondition> data(study.conditions.size());
    for (auto& condition : data)
    {
        condition.features = (Eigen::MatrixXd(3, 1) << -2.3036, -2.3026, -2.3016).finished();
        condition.declaredError = Eigen::VectorXd::Zero(1);
    }
    const Emulator emulator(study, studySimulator, library.runs, measuredFeatures(study, data));
    const auto [layout, measured] = arrange(study, emulator, data);
    const Evidence evidence(study, emulator, layout, Eigen::VectorXd::Zero(1));
    const Fit fit = evidence.fit(effectOf(study, "x"), measured);
    EXPECT_LT(std::sqrt(fit.covariance(0, 0)), .05) << "at one amplitude";
    EXPECT_NEAR(std::sqrt(fit.marginal(0, 0)), .743, .05);
    EXPECT_EQ(evidence.fitNull(measured).marginal, evidence.fitNull(measured).covariance);
}

/// One effect at a setting, as a member of a set.
Explanation explanationBy(std::size_t effect, const Setting& setting)
{
    Explanation explanation;
    explanation.effects = {effect};
    explanation.setting = setting;
    explanation.fits.resize(1);
    return explanation;
}

/// Two kernels of one force are no pair, for only one of them can be on; two factors on one entry are, for they multiply.
TEST(Trace, NoPairOfWhatUndoesEachOther)
{
    const auto setting = [](const std::string& formula) {
        Effect effect;
        effect.entries.emplace("density", Expression(formula));
        return effect;
    };
    const auto named = [](const std::string& kernel) {
        Effect effect;
        effect.words["historyForce"] = kernel;
        return effect;
    };
    EXPECT_TRUE(undoEachOther(named("Basset"), named("MeiAdrian")));
    EXPECT_TRUE(undoEachOther(setting("1000*a"), setting("density*(1 + 0.1*a)")));
    EXPECT_TRUE(undoEachOther(setting("density*(1 + 0.1*a)"), setting("1000*a")));
    EXPECT_FALSE(undoEachOther(setting("density*(1 + 0.2*a)"), setting("density*(1 + 0.1*a)")));
    EXPECT_FALSE(undoEachOther(named("Basset"), setting("1000*a")));
}

/// Pairs with variants of one thing share the weight of one pair, all of them that of one effect.
TEST(Trace, PairsOfVariantsShareTheirWeight)
{
    const TemporaryFolder folder;
    Study study = linearStudy(folder, "none");
    study.modelError = Eigen::VectorXd::Constant(1, .01);
    study.effects.push_back(study.effects.back()); // another clock
    study.effects[0].family = study.effects[2].family = "rate";
    LinearSimulator simulator;
    StudySimulator studySimulator(study, simulator);
    const Library library = makeLibrary(studySimulator);
    std::vector<MeasuredCondition> data(study.conditions.size());
    for (auto& condition : data)
    {
        condition.features = (Eigen::MatrixXd(3, 1) << -2.31, -2.30, -2.29).finished();
        condition.declaredError = Eigen::VectorXd::Zero(1);
    }
    const Emulator emulator(study, studySimulator, library.runs, measuredFeatures(study, data));
    const auto [layout, measured] = arrange(study, emulator, data);
    Evidence evidence(study, emulator, layout, Eigen::VectorXd::Zero(1));
    // x or clock with y or the other clock, or the latter two.
    const auto pairs = leadingPairs(study, evidence, measured);
    EXPECT_FALSE(pairs.empty());
    for (const auto& pair : pairs)
    {
        const bool hasVariant = pair.effects != std::vector<std::size_t>{1, 3};
        EXPECT_NEAR(std::exp(pair.logPrior), hasVariant ? 1 / 6. : 1 / 3., 1e-9);
    }
}

/// The mean start is late and the scale drifts: neither alone explains both, and the two are found together.
TEST(Trace, TwoEffectsAtOnce)
{
    Study study = readStudy(std::filesystem::path(SURROGATE) / "study.yaml");
    study.settings.draws = 200;
    SurrogateSimulator simulator{readEntries(study.simulator.caseFolder / study.simulator.entriesFile)};
    StudySimulator studySimulator(study, simulator);
    const Library library = makeLibrary(studySimulator);
    const std::vector<std::size_t> truth = {effectOf(study, "addedMass"), effectOf(study, "drift")};
    Setting setting = studySimulator.plainSetting();
    for (const auto e : truth)
    {
        setting.amplitudes(static_cast<Eigen::Index>(e)) = .8;
    }
    std::vector<MeasuredCondition> data(study.conditions.size());
    for (std::size_t c = 0; c < data.size(); ++c)
    {
        data[c].features = featureRows(studySimulator.repeats({c}, setting, "measured", 3), c, study.featureCount());
        data[c].declaredError = Eigen::VectorXd::Zero(study.featureCount());
    }
    std::mt19937_64 random(1);
    const Answer answer = trace(studySimulator, library, data, random);
    ASSERT_FALSE(answer.set.empty());
    EXPECT_EQ(answer.set.front().effects, truth);
    double likely = 0;
    for (const auto& member : answer.set)
    {
        likely += member.probability;
    }
    EXPECT_LE(likely + answer.otherBesideSet, 1 + 1e-9) << "these are said together";
    for (const auto& fit : answer.set.front().fits)
    {
        EXPECT_NEAR(fit.amplitude, .8, .3);
    }
}

/// Data made by one effect at full size, predicted with it switched on, as a name or as a set. \param edgeFails  whether there
/// is another held-out condition, where something else acts as well and no run with y succeeds
HeldOutResult heldOutOf(const std::string& truth, Decision decision, bool edgeFails = false)
{
    Bench bench;
    if (edgeFails)
    {
        bench.study.conditions.push_back(bench.study.conditions.back());
        bench.study.conditions.back().name = "edged";
        bench.study.conditions.back().entries["edge"] = "1";
    }
    Setting setting = bench.studySimulator.plainSetting();
    const std::size_t index = effectOf(bench.study, truth);
    setting.amplitudes(static_cast<Eigen::Index>(index)) = 1;

    std::vector<MeasuredCondition> data(bench.study.conditions.size());
    for (std::size_t c = 0; c < data.size(); ++c)
    {
        data[c].features =
            featureRows(bench.studySimulator.repeats({c}, setting, "measured", 4), c, bench.study.featureCount());
        data[c].declaredError = Eigen::VectorXd::Zero(bench.study.featureCount());
    }
    if (edgeFails)
    {
        data.back().features.array() += .3;
        bench.simulator.failsWithYAtEdge = true;
    }
    Answer answer = trace(bench.studySimulator, bench.library, data, bench.random);
    answer.decision = decision;
    answer.set = {explanationBy(index, setting)};
    return evaluateHeldOut(bench.studySimulator, bench.library, answer, data, data, bench.random);
}

/// What acts under water only, no factor of all times imitates: it may enter the model, but only as a name.
TEST(HeldOut, AcceptsANameThatNothingElseImitates)
{
    const HeldOutResult named = heldOutOf("y", Decision::named);
    EXPECT_THAT(named.notAcceptedBecause, IsEmpty());
    EXPECT_TRUE(named.accepted());
    EXPECT_FALSE(named.gaussianProcess) << "these conditions have no coordinates";
    EXPECT_GT(named.overOneMore.value, named.overOneMore.standardError);
    EXPECT_LT(named.after->rmsLogError.value, named.noiseLimit);
    EXPECT_GT(named.before.rmsLogError.value, named.noiseLimit);
    EXPECT_THAT(heldOutOf("y", Decision::set).notAcceptedBecause, ElementsAre(HasSubstr("only explanation")));
}

/// Where the effect's runs fail nothing is predicted: no gain, and the error before is that of the numbers that are left.
TEST(HeldOut, ComparesTheSameNumbers)
{
    const HeldOutResult result = heldOutOf("y", Decision::named, true);
    EXPECT_THAT(result.notAcceptedBecause, ElementsAre("no prediction of logMeanRate in edged"));
    EXPECT_NEAR(result.before.rmsLogError.value, .1, .02) << ".29 with the number that y does not predict";
}

/// Control 1 learns from each run what was set in it: where the last fit lies does not matter where all is linear.
TEST(HeldOut, OneMoreParameterKnowsWhatRunsWere)
{
    Bench bench(false);
    bench.study.simulator.seedEntry = "";
    bench.library = makeLibrary(bench.studySimulator);
    std::vector<MeasuredCondition> data(bench.study.conditions.size());
    for (auto& condition : data)
    {
        condition.features = (Eigen::MatrixXd(4, 1) << -2.26, -2.25, -2.24, -2.25).finished();
        condition.declaredError = Eigen::VectorXd::Zero(1);
    }
    Answer answer = trace(bench.studySimulator, bench.library, data, bench.random);
    ASSERT_FALSE(answer.null.runs.empty());
    const auto sizeOfOneMore = [&] {
        return evaluateHeldOut(bench.studySimulator, bench.library, answer, data, data, bench.random).oneMoreAmplitude;
    };
    const double size = sizeOfOneMore();
    answer.null.setting.parameters(0) -= .02;
    EXPECT_NEAR(sizeOfOneMore(), size, .01 * std::abs(size));
}

/// A study may have no held-out measurements: nothing is simulated, nothing accepted.
TEST(HeldOut, NothingWithoutMeasurements)
{
    Bench bench(false);
    Answer answer;
    answer.decision = Decision::named;
    answer.set = {explanationBy(0, bench.studySimulator.plainSetting())};
    const int before = bench.studySimulator.effort().executed;
    const HeldOutResult result =
        evaluateHeldOut(bench.studySimulator, bench.library, answer, bench.nothing, bench.nothing, bench.random);
    EXPECT_THAT(result.conditions, IsEmpty());
    EXPECT_FALSE(result.accepted());
    EXPECT_EQ(bench.studySimulator.effort().executed, before);
}

/// What makes everything faster by the same factor is no better than a free factor of all times, however well it does.
TEST(HeldOut, AcceptsNothingThatOneMoreParameterDoesAsWell)
{
    const HeldOutResult result = heldOutOf("x", Decision::named);
    EXPECT_FALSE(result.accepted());
    EXPECT_THAT(result.notAcceptedBecause, Contains(HasSubstr("one more free parameter")));
}

} // namespace

} // namespace clepsydra::identification::tests
