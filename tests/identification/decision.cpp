/// What a decision promises, held against data of known worlds: fresh ones, not those that set the thresholds.
#include "decision/pairs.h"
#include "decision/visibility.h"
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

/// The surrogate with its library, and three repeats measured without any effect.
struct Bench
{
    Study study = readStudy(std::filesystem::path(SURROGATE) / "study.yaml");
    SurrogateSimulator simulator{readEntries(study.simulator.caseFolder / study.simulator.entriesFile)};
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

/// Thresholds without a calibration would miss one of these: p-values are uniform without any effect, sets hold the truth
/// as often as they say for each effect, and what has been left out of the library seldom gets a name.
TEST(Decision, KeepsWhatItPromises)
{
    Bench bench;
    const Evidence evidence(bench.study, *bench.emulator, bench.layout, atPrior);
    Replicas replicas(*bench.emulator, bench.layout, evidence, bench.random);
    const Calibration calibration =
        Calibrator(bench.study, evidence, replicas, bench.measured, bench.random).calibrate();
    Replicas others(*bench.emulator, bench.layout, evidence, bench.random);
    constexpr int draws = 150;
    int alarms = 0;
    for (int i = 0; i < 4 * draws; ++i)
    {
        const auto [data, judge] = others.draw({}, atPrior, bench.random);
        const Odds odds = oddsOf(bench.study, judge(data));
        alarms += isDetected(bench.study, calibration, odds) ? 1 : 0;
    }
    EXPECT_NEAR(alarms / (4. * draws), .05, .035);
    double wrong = 0;
    double decoys = 0;
    for (const std::string name : {"addedMass", "cohesion", "rollingFriction", "viscosity", "scaleLag"})
    {
        const std::size_t e = bench.effect(name);
        double held = 0;
        double detected = 0;
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
        EXPECT_GT(held / detected, .8) << name << ": " << held << " of " << detected;
    }
    EXPECT_LT(wrong / decoys, .15) << wrong << " of " << decoys;
}

/// Cohesion changes the spread between repeats much and the means little: it is reported by the former. With the spread of the
/// base, the same means say nothing.
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

/// What a common error does to all conditions alike is no residual, however small the noise of each.
TEST(Decision, CommonErrorsExplain)
{
    Bench bench;
    const double shift = .08;
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

/// A pattern that no effect makes, many times its noise, is something else.
TEST(Decision, SomethingElseIsSeen)
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

/// Variants of one thing share its weight: three times the same effect is as likely, all together, as once.
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
    EXPECT_NEAR(odds.statistic, 7 + std::log(2.), 1e-9) << "the test does not ask how wide an amplitude's range is";
    EXPECT_NEAR(odds.effects(0), std::log(.5), 1e-9);
    EXPECT_NEAR(odds.effects(2), std::log(.5 / 3), 1e-9);
    Calibration calibration;
    calibration.chiSquares = Eigen::Vector4d::Constant(2);
    calibration.scatterChiSquares = calibration.chiSquares;
    calibration.membership = Eigen::Vector4d(0, -9, -9, 0);
    EXPECT_EQ(soleMember(study, calibration, odds), 1U) << "two variants are one name";
    calibration.membership(0) = -9;
    EXPECT_FALSE(soleMember(study, calibration, odds));
}

/// Where a parameter's range ends within its prior, a draw from beyond would be a residual in data without any effect.
TEST(Decision, NothingIsDrawnFromBeyondARange)
{
    Bench bench;
    Parameter& friction = bench.study.parameters.front();
    friction.lower = friction.mean - 0.2 * friction.sd;
    friction.upper = friction.mean + 0.2 * friction.sd;
    const Evidence evidence(bench.study, *bench.emulator, bench.layout, atPrior);
    Replicas replicas(*bench.emulator, bench.layout, evidence, bench.random);
    const Calibration calibration =
        Calibrator(bench.study, evidence, replicas, bench.measured, bench.random).calibrate();
    EXPECT_LT(calibration.critical, 10) << "36 with draws from beyond";
}

/// A layered liquid with either law for the walls is one name; with a drift of the temperature beside them it is a set, and a
/// likeliest pair that does not fit well is no name.
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
    std::vector<PairFinding> pairs = {judged(0, 1, .6), judged(2, 0, .395)};
    EXPECT_TRUE(mayBeNamed(study, pairs));
    EXPECT_EQ(sharedName(study, pairs), "layers with walls");
    pairs.push_back(judged(0, 3, .004));
    EXPECT_FALSE(mayBeNamed(study, pairs)) << "another pair is in the set";
    pairs.pop_back();
    pairs.back().probability = .1;
    EXPECT_FALSE(mayBeNamed(study, pairs)) << "there is room for something else";
    pairs = {judged(0, 1, .999)};
    EXPECT_TRUE(mayBeNamed(study, pairs));
    pairs.front().fitsWell = false;
    EXPECT_FALSE(mayBeNamed(study, pairs));
}

/// Two explanations that differ in wet conditions only: runs go there; and to both of them, once the one that the library
/// knows less of has caught up.
TEST(NextRuns, GoWhereTheyDecide)
{
    Bench bench;
    const std::vector<Contender> contenders = {{{}, atPrior, .5}, {{{bench.effect("addedMass"), .5}}, atPrior, .5}};
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
