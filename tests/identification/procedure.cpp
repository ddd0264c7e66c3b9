/// From scores to an answer: what may be a name, what may not, and what is no answer at all.
#include "heldOut/heldOut.h"
#include "linearRig.h"
#include "procedure/assemble.h"
#include "procedure/decide.h"
#include "procedure/doubts.h"
#include "procedure/trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace clepsydra::identification::tests
{

namespace
{

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The linear rig with its effect library. \param scatters  whether its runs do
struct Bench
{
    explicit Bench(bool scatters = true)
        : rig(scatters)
    {}

    TemporaryFolder folder;
    Study study = linearStudy(folder, "seed");
    LinearRig rig;
    Simulator simulator{study, rig};
    EffectLibrary library = makeLibrary(simulator);
    std::vector<MeasuredCondition> nothing{study.conditions.size()};
    TraceInputs inputs{simulator, study, library, nothing, study.conditionsOf(Role::training)};
    std::mt19937_64 random{1};
};

Explanation explanation(std::size_t effect, double logOdds, double misfit = 5.0)
{
    Explanation one;
    one.effects = {effect};
    one.logOdds = logOdds;
    one.misfit = misfit;
    one.misfitLimit = 20.0;
    return one;
}

constexpr double setWidth = 3.0;

TEST(Decision, NamesWhatIsFarAhead)
{
    const Verdict verdict = decide({explanation(4, -10), explanation(2, -14)}, -30, false, setWidth);
    EXPECT_EQ(verdict.decision, Decision::named);
    ASSERT_EQ(verdict.set.size(), 1U);
    EXPECT_EQ(verdict.set.front().effects, std::vector<std::size_t>{4});
}

/// Two within the set's width, or one beside which something else cannot be ruled out, are no name.
TEST(Decision, ASetIsNotAName)
{
    EXPECT_EQ(decide({explanation(4, -10), explanation(2, -12)}, -30, false, setWidth).set.size(), 2U);
    EXPECT_EQ(decide({explanation(4, -10), explanation(2, -12)}, -30, false, setWidth).decision, Decision::set);
    EXPECT_EQ(decide({explanation(4, -10)}, -30, true, setWidth).decision, Decision::set);
    // One that misfits is in no set, however likely the others make it look.
    EXPECT_EQ(decide({explanation(4, -10), explanation(2, -11, 21)}, -30, false, setWidth).decision, Decision::named);
}

TEST(Decision, UnknownWhereTheBestMisfitsOrSomethingElseIsMoreLikely)
{
    for (const Verdict& verdict : {decide({explanation(4, -10, 21), explanation(2, -11)}, -30, false, setWidth),
             decide({explanation(4, -10)}, -9, false, setWidth)})
    {
        EXPECT_EQ(verdict.decision, Decision::unknown);
        EXPECT_THAT(verdict.set, IsEmpty());
        ASSERT_TRUE(verdict.bestOfUnknown);
        EXPECT_EQ(verdict.bestOfUnknown->effects.front(), 4U);
    }
}

/// Each doubt by itself, from an explanation that has none.
TEST(Doubts, AreTold)
{
    Bench bench(false);
    const auto doubts = [&](const Answer& answer, double nullMisfit) {
        return doubtsAbout(explanation(0, -10), answer, nullMisfit, {}, bench.inputs, bench.random);
    };

    Answer answer;
    answer.otherLogOdds = -20;
    answer.significance.noticed = 30;
    EXPECT_THAT(doubts(answer, 5 + 30 / .49 + 1), IsEmpty());
    EXPECT_THAT(doubts(answer, 5 + 30 / .49 - 1), ElementsAre(HasSubstr("too small for its shape")));
    answer.otherLogOdds = -12;
    EXPECT_THAT(doubts(answer, 1000), ElementsAre(HasSubstr("as likely")));
    answer.otherLogOdds = -20;
    answer.spread.pValue = .001;
    EXPECT_THAT(doubts(answer, 1000), ElementsAre(HasSubstr("scatter in a way of their own")));
}

/// Four times the scatter in the data, and in runs with the effect: it explains that, too. Runs that scatter like the
/// library's do not.
TEST(Doubts, SpreadThatTheEffectExplains)
{
    Bench bench;
    const double usual =
        bench.library.scatter.deviations().norm() / std::sqrt(bench.library.scatter.degreesOfFreedom());
    std::normal_distribution<double> normal;
    const auto scattered = [&](double times, Explanation& one) {
        Scatter scatter;
        for (const auto condition : bench.inputs.training)
        {
            Eigen::MatrixXd rows(12, 1);
            for (Eigen::Index row = 0; row < rows.rows(); ++row)
            {
                rows(row) = times * usual * normal(bench.random);
                one.simulations.push_back({condition, rows.row(row).transpose(), {}, {}, 0, false});
            }
            scatter.add(rows);
        }
        return scatter;
    };
    Answer answer;
    answer.otherLogOdds = -20;
    answer.spread.pValue = .001;
    Explanation none;
    const Scatter measured = scattered(10, none);
    Explanation wide = explanation(0, -10);
    scattered(10, wide);
    EXPECT_THAT(doubtsAbout(wide, answer, 1000, measured, bench.inputs, bench.random), IsEmpty());
    Explanation narrow = explanation(0, -10);
    scattered(1, narrow);
    EXPECT_THAT(
        doubtsAbout(narrow, answer, 1000, measured, bench.inputs, bench.random), ElementsAre(HasSubstr("scatter")));
}

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
        return trace(bench.simulator, bench.library, data, bench.random);
    };
    const Answer one = answerWith(.01);
    const Answer other = answerWith(1);
    EXPECT_EQ(one.significance.pValue, other.significance.pValue);
    EXPECT_EQ(one.noise.data.matrix(0, 0), other.noise.data.matrix(0, 0));
    EXPECT_EQ(one.spread.pValue, other.spread.pValue);
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
    EXPECT_NO_THROW(trace(bench.simulator, bench.library, data, bench.random));
    bench.rig.failsAlways = true;
    try
    {
        trace(bench.simulator, bench.library, data, bench.random);
        FAIL() << "an answer from nothing";
    }
    catch (const std::runtime_error& error)
    {
        EXPECT_THAT(error.what(), HasSubstr("null fit"));
        EXPECT_THAT(error.what(), HasSubstr("the power is off"));
    }
}

/// Data made by one effect at full size, predicted with it switched on, as a name or as a set.
HeldOutResult heldOutOf(const std::string& truth, Decision decision)
{
    Bench bench;
    Setting setting = bench.simulator.plainSetting();
    const auto effect = std::find_if(
        bench.study.effects.begin(), bench.study.effects.end(), [&](const Effect& one) { return one.name == truth; });
    const auto index = static_cast<std::size_t>(effect - bench.study.effects.begin());
    setting.amplitudes(static_cast<Eigen::Index>(index)) = 1;

    std::vector<MeasuredCondition> data(bench.study.conditions.size());
    for (std::size_t c = 0; c < data.size(); ++c)
    {
        data[c].features =
            featureRows(bench.simulator.repeats({c}, setting, "measured", 4), c, bench.study.featureCount());
        data[c].declaredError = Eigen::VectorXd::Zero(bench.study.featureCount());
    }
    Answer answer = trace(bench.simulator, bench.library, data, bench.random);
    answer.decision = decision;
    answer.set = {explanation(index, 0)};
    answer.set.front().setting = setting;
    return evaluateHeldOut(bench.simulator, bench.library, answer, data, data, bench.random);
}

/// What acts under water only, no factor of all times imitates: it may enter the model, but only as a name.
TEST(HeldOut, AcceptsANameThatNothingElseImitates)
{
    const HeldOutResult named = heldOutOf("y", Decision::named);
    EXPECT_THAT(named.notAcceptedBecause, IsEmpty());
    EXPECT_TRUE(named.accepted());
    EXPECT_GT(named.overOneMore.value, named.overOneMore.standardError);
    EXPECT_LT(named.after->rmsLogError.value, named.noiseLimit);
    EXPECT_GT(named.before.rmsLogError.value, named.noiseLimit);
    EXPECT_THAT(heldOutOf("y", Decision::set).notAcceptedBecause, ElementsAre(HasSubstr("only explanation")));
}

/// A study may have no held-out measurements: nothing is simulated, nothing accepted.
TEST(HeldOut, NothingWithoutMeasurements)
{
    Bench bench(false);
    Answer answer;
    answer.decision = Decision::named;
    answer.set = {explanation(0, 0)};
    const int before = bench.simulator.executed();
    const HeldOutResult result =
        evaluateHeldOut(bench.simulator, bench.library, answer, bench.nothing, bench.nothing, bench.random);
    EXPECT_THAT(result.conditions, IsEmpty());
    EXPECT_FALSE(result.accepted());
    EXPECT_EQ(bench.simulator.executed(), before);
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
