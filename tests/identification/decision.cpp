/// Rates of the decision on synthetic data with known truth, which are independent of those that set the thresholds.
#include "decision/pairs.h"
#include "effectOf.h"
#include "emulator/settings.h"
#include "nextRuns/chooseRuns.h"
#include "surrogate/surrogate.h"
#include "study/readStudy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <random>

namespace clepsydra::identification::tests
{

namespace
{

/// The surrogate with its library, and data of three repeats without effects.
struct Bench
{
    Study study = readStudy(std::filesystem::path(SURROGATE) / "study.yaml");
    SurrogateSimulator simulator{readEntries(study.simulator.caseFolder / entriesFile)};
    StudySimulator studySimulator{study, simulator};
    Library library = makeLibrary(studySimulator);
    std::vector<MeasuredCondition> data;
    std::unique_ptr<Emulator> emulator;
    Layout layout;
    Measured measured;
    std::mt19937_64 random{1};

    Bench()
    {
        study.settings.draws = 400;
        data.resize(study.conditions.size());
        for (const auto c : study.conditionsOf(Role::training))
        {
            data[c].features = featureRows(
                studySimulator.repeats({c}, studySimulator.plainSetting(), "measured", 3), c, study.featureCount());
            data[c].declaredError = Eigen::VectorXd::Zero(study.featureCount());
        }
        emulator = std::make_unique<Emulator>(study, studySimulator, library.runs, measuredFeatures(study, data));
        std::tie(layout, measured) = arrange(study, *emulator, data);
    }

    std::size_t effect(const std::string& name) const
    {
        return effectOf(study, name);
    }
};

const Eigen::VectorXd atPrior = Eigen::VectorXd::Zero(1);

/// Without effects, p-values are uniform; for each effect, sets contain the truth with their nominal coverage; an
/// effect that is left out of the library is seldom given a wrong name; and the intervals of the amplitudes that are
/// detected contain the truth in 95 %. The fits' own intervals contain it in 81 %, because an amplitude that is detected
/// is likely to be one that noise has raised. Thresholds without a calibration would fail in one of these.
TEST(Decision, HasItsNominalRates)
{
    Bench bench;
    const Evidence evidence(bench.study, *bench.emulator, bench.layout, atPrior);
    Replicas replicas(*bench.emulator, bench.layout, evidence, bench.random);
    const Calibration calibration = calibrate(bench.study, evidence, replicas, bench.measured, bench.random);
    Replicas others(*bench.emulator, bench.layout, evidence, bench.random);
    constexpr int draws = 150;
    int alarms = 0;
    int aboveCritical = 0;
    for (int i = 0; i < 4 * draws; ++i)
    {
        const auto [data, judge] = others.draw({}, atPrior, bench.random);
        const Odds odds = oddsOf(bench.study, judge(data));
        alarms += isDetected(bench.study, calibration, odds) ? 1 : 0;
        aboveCritical += odds.statistic > calibration.critical ? 1 : 0;
    }
    EXPECT_NEAR(alarms / (4. * draws), 0.05, 0.035);
    EXPECT_GT(calibration.wrongNames, bench.study.settings.wrongNames)
        << "counted on the draws that set the thresholds";
    EXPECT_NEAR(aboveCritical / (4. * draws), 0.05, 0.035) << "the reported critical value is not that of the decision";
    double wrong = 0;
    double decoys = 0;
    double allDetected = 0;
    double allCovered = 0;
    double allCoveredByFits = 0;
    for (const std::string name : {"addedMass", "cohesion", "rollingFriction", "viscosity", "scaleLag"})
    {
        const std::size_t e = bench.effect(name);
        double held = 0;
        double detected = 0;
        double covered = 0;
        double coveredByFits = 0;
        for (int i = 0; i < draws; ++i)
        {
            const auto amplitudes = evidence.amplitudes(e);
            const double amplitude = amplitudes[static_cast<std::size_t>(i) % amplitudes.size()];
            if (amplitude == 0)
            {
                continue;
            }
            const auto [data, judge] = others.draw({{e, amplitude}}, atPrior, bench.random);
            const Evidences evidences = judge(data);
            const Odds odds = oddsOf(bench.study, evidences);
            if (!isDetected(bench.study, calibration, odds))
            {
                continue;
            }
            detected += 1;
            const auto covers = [&](const Fit& fit) { return fit.lower <= amplitude && amplitude <= fit.upper; };
            const Fit fit = judge.fit(e, data);
            coveredByFits += covers(fit) ? 1 : 0;
            covered += covers(calibration.widened(e, fit, bench.study.effects[e].bounds)) ? 1 : 0;
            const auto members = membersOf(calibration, odds);
            held += std::count(members.begin(), members.end(), e) > 0 ? 1 : 0;
            const Odds without = oddsOf(bench.study, evidences, e);
            const auto sole = soleMember(bench.study, calibration, without);
            decoys += 1;
            wrong +=
                sole && marginOf(bench.study, without, *sole) >= calibration.naming(static_cast<Eigen::Index>(*sole))
                    ? 1
                    : 0;
        }
        EXPECT_GT(held / detected, 0.8) << name << ": " << held << " of " << detected;
        allDetected += detected;
        allCovered += covered;
        allCoveredByFits += coveredByFits;
    }
    EXPECT_NEAR(allCovered / allDetected, 0.95, 0.03) << allCovered << " of " << allDetected << " amplitudes";
    EXPECT_LT(allCoveredByFits / allDetected, 0.9) << "otherwise there is no need to widen the fits' intervals";
    EXPECT_LT(wrong / decoys, 0.15) << wrong << " of " << decoys;
}

/// Cohesion changes the spread between repeats more than their means, and is detected by the spread. The same means
/// with the spread of the base setting do not show it.
TEST(Decision, SpreadIsADatum)
{
    Bench bench;
    const Evidence evidence(bench.study, *bench.emulator, bench.layout, atPrior);
    const std::size_t cohesion = bench.effect("cohesion");
    const Node null = evidence.nodeAt({});
    Measured drawn = bench.measured;
    const auto logOdds = [&] {
        const Evidences evidences = evidence(drawn);
        return evidences.effects(static_cast<Eigen::Index>(cohesion)) - evidences.null;
    };
    const double before = logOdds();
    for (std::size_t b = 0; b < bench.layout.blocks.size(); ++b)
    {
        if (bench.study.conditions[bench.layout.blocks[b].condition].tags.at("medium") == "air")
        {
            drawn.scatter[b] *= 9;
        }
    }
    EXPECT_LT(before, 2);
    EXPECT_GT(logOdds(), before + 4);
}

/// A shift of all conditions that a common error explains is no residual, however small the noise of each is.
TEST(Decision, CommonErrorsExplain)
{
    Bench bench;
    const double shift = 0.08;
    for (auto& condition : bench.data)
    {
        condition.features.leftCols(3).array() += shift; // the rates
    }
    const auto statistic = [&] {
        const auto [layout, measured] = arrange(bench.study, *bench.emulator, bench.data, bench.library.errorSlopes);
        const Evidence evidence(bench.study, *bench.emulator, layout, atPrior);
        return oddsOf(bench.study, evidence(measured)).statistic;
    };
    const double before = statistic();
    Eigen::VectorXd ofRates = Eigen::VectorXd::Zero(bench.study.featureCount());
    ofRates.head(3).setConstant(shift);
    for (const auto c : bench.study.conditionsOf(Role::training))
    {
        bench.library.errorSlopes[c] = ofRates;
    }
    EXPECT_GT(before, 5);
    EXPECT_LT(statistic(), before / 3);
}

/// The model error is one draw for all conditions: it explains a shift that is alike in all of them, and not shifts of
/// the same size that alternate between them, which independent errors would explain as well.
TEST(Decision, ModelErrorIsSharedByAllConditions)
{
    const double shift = 0.08;
    const auto statistic = [&](double modelError, double signOfEverySecond) {
        Bench bench;
        double sign = 1.0;
        bench.study.modelError.head(3).setConstant(modelError); // of the rates
        for (const auto c : bench.study.conditionsOf(Role::training))
        {
            bench.data[c].features.leftCols(3).array() += sign * shift;
            sign *= signOfEverySecond;
            bench.library.errorSlopes[c] = sharedErrorSlopes(bench.studySimulator, c, bench.library.runs);
        }
        const auto [layout, measured] = arrange(bench.study, *bench.emulator, bench.data, bench.library.errorSlopes);
        const Evidence evidence(bench.study, *bench.emulator, layout, atPrior);
        return oddsOf(bench.study, evidence(measured)).statistic;
    };
    EXPECT_LT(statistic(shift, 1.0), statistic(0.0, 1.0) / 3);
    EXPECT_GT(statistic(shift, -1.0), 0.9 * statistic(0.0, -1.0));
}

/// A pattern far above the noise that no effect explains is attributed to an unlisted cause.
TEST(Decision, UnlistedCauseIsDetected)
{
    Bench bench;
    const Evidence evidence(bench.study, *bench.emulator, bench.layout, atPrior);
    Replicas replicas(*bench.emulator, bench.layout, evidence, bench.random);
    int ahead = 0;
    for (int i = 0; i < 20; ++i)
    {
        const auto [data, judge] = replicas.drawOther(1., atPrior, bench.random);
        const Odds odds = oddsOf(bench.study, judge(data));
        ahead += odds.other > odds.effects.maxCoeff() ? 1 : 0;
    }
    EXPECT_GE(ahead, 18);
    const auto [data, judge] = replicas.draw({{bench.effect("addedMass"), 1.}}, atPrior, bench.random);
    const Odds own = oddsOf(bench.study, judge(data));
    EXPECT_LT(own.other, own.effects(static_cast<Eigen::Index>(bench.effect("addedMass"))));
}

/// The variants of a family share the weight of one effect: three copies of an effect are together as probable as one.
TEST(Decision, VariantsShareTheirWeight)
{
    Study study;
    study.effects.resize(4);
    study.effects[0].name = "wall";
    for (const std::size_t e : {1, 2, 3})
    {
        study.effects[e].name = "history" + std::to_string(e);
        study.effects[e].family = "history";
    }
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(4);
    const Odds odds = oddsOf(study, {0, 5 * ones, -100, ones, ones, 7 * ones});
    EXPECT_NEAR(odds.logOdds, 5 + std::log(2.), 1e-9);
    EXPECT_NEAR(odds.statistic, 7 + std::log(2.), 1e-9)
        << "the test does not depend on the width of the amplitude's range";
    EXPECT_NEAR(odds.effects(0), std::log(0.5), 1e-9);
    EXPECT_NEAR(odds.effects(2), std::log(0.5 / 3), 1e-9);
    Calibration calibration;
    calibration.chiSquares = Eigen::Vector4d::Constant(2);
    calibration.scatterChiSquares = calibration.chiSquares;
    calibration.membership = Eigen::Vector4d(0, -9, -9, 0);
    EXPECT_EQ(soleMember(study, calibration, odds), 1U) << "two variants have one name";
    calibration.membership(0) = -9;
    EXPECT_FALSE(soleMember(study, calibration, odds));
}

/// An effect with all of the probability whose fit is no better than that of no effect is in no set, and the reason is
/// given. One free number gains 1.92 by chance in 5 % of the cases.
TEST(Decision, NoMemberFitsWorseThanNoEffect)
{
    const Eigen::VectorXd two = Eigen::VectorXd::Zero(2);
    Calibration calibration;
    calibration.membership = Eigen::VectorXd::Constant(2, -2.3);
    calibration.chiSquares = calibration.scatterChiSquares = Eigen::VectorXd::Constant(2, 20.);
    Study study;
    calibration.leastGain = leastGain(study);
    EXPECT_NEAR(calibration.leastGain, 1.92, 0.01);
    Odds odds;
    odds.effects = two;
    odds.chiSquares = Eigen::Vector2d(12, 90);
    odds.scatterChiSquares = two;
    odds.gains = Eigen::Vector2d(0.5, 600);
    EXPECT_TRUE(membersOf(calibration, odds).empty());
    EXPECT_EQ(exclusionOf(calibration, odds, 0), "it fits no better than no effect");
    EXPECT_EQ(exclusionOf(calibration, odds, 1),
        "it does not fit: its chi-square is 90, and where it is the cause it is below 20");
    odds.gains(0) = 3;
    EXPECT_EQ(membersOf(calibration, odds), std::vector<std::size_t>{0});
}

/// A cubic is reproduced between the nodes, also where some were added.
TEST(Decision, InterpolatesBetweenAddedNodes)
{
    Effect effect;
    effect.bounds = {-1, 1};
    const Grid grid(effect, {0.01, -0.3});
    const auto cubic = [](double a) { return 2 - a + 3 * a * a - 4 * a * a * a; };
    ASSERT_EQ(grid.amplitudes.size(), 19);
    const Eigen::VectorXd values = grid.amplitudes.unaryExpr(cubic);
    for (const double amplitude : {-1.0, -0.31, 0.0, 0.005, 0.07, 0.99})
    {
        EXPECT_NEAR(grid.weightsAt(amplitude) * values, cubic(amplitude), 1e-10);
    }
}

/// A measured amplitude is the prior of the fit: with 0.5 ± 0.01 and data that say next to nothing of it, the fit is the
/// measurement, and without the measurement it is the range.
TEST(Decision, AMeasuredAmplitudeIsAPrior)
{
    Bench bench;
    const std::size_t e = bench.effect("rollingFriction");
    const auto fits = [&] {
        const Evidence evidence(bench.study, *bench.emulator, bench.layout, atPrior);
        return std::pair(evidence.fit(e, bench.measured), evidence.fitAlone(e, bench.measured));
    };
    const double free = fits().first.amplitude;
    bench.study.effects[e].measured = Normal{0.5, 0.01};
    const auto [with, without] = fits();
    EXPECT_NEAR(with.amplitude, 0.5, 0.03);
    EXPECT_LT(with.sd, 0.0105);
    EXPECT_NEAR(without.amplitude, free, 1e-9);
}

/// If a parameter's range ends within its prior, a draw from beyond the range would appear as a residual.
TEST(Decision, NothingIsDrawnFromBeyondARange)
{
    Bench bench;
    Parameter& friction = bench.study.parameters.front();
    friction.lower = friction.mean - 0.2 * friction.sd;
    friction.upper = friction.mean + 0.2 * friction.sd;
    const Evidence evidence(bench.study, *bench.emulator, bench.layout, atPrior);
    Replicas replicas(*bench.emulator, bench.layout, evidence, bench.random);
    const Calibration calibration = calibrate(bench.study, evidence, replicas, bench.measured, bench.random);
    EXPECT_LT(calibration.critical, 10) << "it would be 36 with draws from beyond the range";
}

/// A layered liquid with either of two wall laws has one name. If a third pair, with a drift of the temperature, is in
/// the set too, or if the most likely pair does not fit well, there is no name.
TEST(Decision, PairsOfVariantsAreOneName)
{
    Study study;
    study.effects.resize(4);
    study.effects[0].name = "layers";
    study.effects[1].name = "tankFlow";
    study.effects[2].name = "tube";
    study.effects[1].family = study.effects[2].family = "walls";
    study.effects[3].name = "drift";
    const auto judged = [](std::size_t one, std::size_t other, double probability) {
        PairFinding pair;
        pair.effects = {one, other};
        pair.probability = probability;
        pair.inSet = pair.fitsWell = true;
        return pair;
    };
    std::vector<PairFinding> pairs = {judged(0, 1, 0.6), judged(2, 0, 0.395)};
    EXPECT_TRUE(mayBeNamed(study, pairs));
    EXPECT_EQ(sharedName(study, pairs), "layers with walls");
    pairs.push_back(judged(0, 3, 0.004));
    EXPECT_FALSE(mayBeNamed(study, pairs)) << "another pair is in the set";
    pairs.pop_back();
    pairs.back().probability = 0.1;
    EXPECT_FALSE(mayBeNamed(study, pairs)) << "other causes are not negligible";
    pairs = {judged(0, 1, 0.999)};
    EXPECT_TRUE(mayBeNamed(study, pairs));
    pairs.front().fitsWell = false;
    EXPECT_FALSE(mayBeNamed(study, pairs));
}

/// Two explanations differ in wet conditions only. All runs are made there, first for the explanation that the library
/// knows less about and then for both.
TEST(NextRuns, AreMadeWhereTheyDecide)
{
    Bench bench;
    const std::vector<Contender> contenders = {{{}, atPrior, 0.5}, {{{bench.effect("addedMass"), 0.5}}, atPrior, 0.5}};
    constexpr int runs = 60;
    int wet = 0;
    int null = 0;
    const auto chosen = chooseRuns(*bench.emulator, bench.layout, contenders, runs);
    ASSERT_EQ(chosen.size(), static_cast<std::size_t>(runs));
    for (const auto& [contender, condition] : chosen)
    {
        wet += bench.study.conditions[condition].tags.at("medium") == "water" ? 1 : 0;
        null += contender == 0 ? 1 : 0;
    }
    EXPECT_GE(wet, 54);
    EXPECT_GT(null, 6);
    EXPECT_LT(null, 54);
}

} // namespace

} // namespace clepsydra::identification::tests
