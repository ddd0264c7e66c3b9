/// What people read: sentences and numbers, from answers made by hand.
#include "linearSimulator.h"
#include "report/fitted.h"
#include "report/numbers.h"
#include "report/text.h"
#include "report/words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace clepsydra::identification::tests
{

namespace
{

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Numbers, AreRoundedAsTheirErrorsAllow)
{
    EXPECT_EQ(rounded(34.6), "35");
    EXPECT_EQ(rounded(3.46), "3.5");
    EXPECT_EQ(rounded(.0999), "0.10");
    EXPECT_EQ(rounded(1.13e-6), "1.1e-06");
    EXPECT_EQ(rounded(-1234, 2), "-1200");
    EXPECT_EQ(rounded(0), "0");
    EXPECT_EQ(rounded(std::numeric_limits<double>::infinity()), "-");
    EXPECT_EQ(withError({.17321, .01189}), "0.173 +- 0.012");
    EXPECT_EQ(withError({2.0612e-3, 3e-5}), "0.002061 +- 0.000030");
    EXPECT_EQ(withError({1.1304e-6, 3e-8}), "1.130e-06 +- 3.0e-08");
    EXPECT_EQ(withError({0, .012}), "0.000 +- 0.012");
    EXPECT_EQ(withError({.15, 0}), "0.1500");
    EXPECT_EQ(percent(.004), "<1 %");
    EXPECT_EQ(percent(.999), ">99 %");
    EXPECT_EQ(percent(.456), "46 %");
}

/// The linear simulator's effects, with meanings, and an answer about them.
struct Bench
{
    Bench()
    {
        study.effects[0].meaning = "the orifice is wider or narrower than stated";
        study.effects[0].hint = "a plug gauge";
        study.effects[1].meaning = "water that moves along with a particle.\n";
        study.parameters[0].unit = "rad";
        answer.null.setting = studySimulator.plainSetting();
        answer.null.setting.parameters(0) = .2;
        answer.null.fits.resize(1);
        answer.null.fits.front().marginal = Eigen::MatrixXd::Constant(1, 1, .25);
        answer.pValue = .0009995;
        answer.effects.resize(study.effects.size());
        for (auto& finding : answer.effects)
        {
            finding.fit.sd = .1;
            finding.fit.marginal = Eigen::MatrixXd::Constant(1, 1, .04);
        }
    }

    void found(
        Decision decision, const std::vector<std::pair<std::size_t, double>>& members, bool somethingElse = false)
    {
        answer.decision = decision;
        answer.somethingElseInSet = somethingElse;
        for (const auto& [effect, amplitude] : members)
        {
            Explanation one;
            one.effects = {effect};
            one.fits = {answer.effects[effect].fit};
            one.setting = studySimulator.plainSetting();
            one.setting.amplitudes(static_cast<Eigen::Index>(effect)) = amplitude;
            answer.set.push_back(one);
        }
    }

    void heldOutErrors(double before, double after)
    {
        heldOut.conditions = {2};
        heldOut.before.rmsLogError = {before, .01};
        heldOut.after = HeldOutScore{{after, .004}, {}};
        heldOut.improvement = {before - after, .01};
        findings.heldOut = &heldOut;
    }

    TemporaryFolder folder;
    Study study = linearStudy(folder, "seed");
    LinearSimulator simulator;
    StudySimulator studySimulator{study, simulator};
    Answer answer;
    HeldOutResult heldOut;
    Findings findings{&study, &answer, nullptr, nullptr, &studySimulator, nullptr, nullptr};
};

/// Reports are committed: why a run failed is reported without the folders of the machine that made it.
TEST(Text, PathsFromTheStudysFolder)
{
    const TemporaryFolder folder;
    const Study study = linearStudy(folder, "seed");
    const std::string here = folder.path().string();
    EXPECT_EQ(fromStudy(study, "ended in " + here + "/work/case: see " + here + "/work/case/log, or /etc"),
        "ended in work/case: see work/case/log, or /etc");
}

/// One sentence, from the library's own words, with the error before and after; names of the program's parts have no place
/// in it.
TEST(Sentence, SaysWhatWasFound)
{
    Bench bench;
    bench.found(Decision::named, {{1, .5}});
    bench.heldOutErrors(.351, .0207);
    EXPECT_EQ(sentenceOf(bench.findings),
        "Found: water that moves along with a particle (y 0.020); with it the error on "
        "measurements that no fit has seen falls from 35 to 2.1 %.");
}

TEST(Sentence, DoesNotPraiseWhatDoesNotHelp)
{
    for (const auto& [after, says] :
        {std::pair(.045, "stays about the same: 5.0 to 4.5 %"), std::pair(.09, "rises from 5.0 to 9.0 %")})
    {
        Bench bench;
        bench.found(Decision::named, {{1, .5}});
        bench.heldOutErrors(.05, after);
        EXPECT_THAT(sentenceOf(bench.findings), HasSubstr(says));
    }
}

TEST(Sentence, OfASetTellsWhatToMeasure)
{
    Bench bench;
    bench.found(Decision::set, {{1, .5}, {0, -1}}, true);
    EXPECT_THAT(sentenceOf(bench.findings),
        AllOf(StartsWith("Either water that moves along with a particle (y 0.020), the orifice is wider"),
            HasSubstr(", or something that the library does not hold; to distinguish them: a plug gauge.")));

    bench.study.conditions[2].role = Role::candidate;
    std::vector<NextExperiment> next(1);
    next[0].condition = 2;
    next[0].outcomes = {{"y", .6, Eigen::VectorXd::Constant(1, -2.3), Eigen::VectorXd::Constant(1, .02)},
        {"x", .4, Eigen::VectorXd::Constant(1, -2.4), Eigen::VectorXd::Constant(1, .03)}};
    bench.findings.next = &next;
    EXPECT_THAT(sentenceOf(bench.findings), EndsWith("; to distinguish them, measure again."));
    const auto sentences = nextOf(bench.findings);
    ASSERT_EQ(sentences.size(), 2U);
    EXPECT_THAT(sentences[0],
        AllOf(HasSubstr("Measure again"), HasSubstr("10 % larger with y than with x"), HasSubstr("good to 3.0 %")));
    EXPECT_THAT(sentences[1], HasSubstr("a plug gauge"));
}

/// A friction that no independent measurement allows hides what is missing: no praise for such a fit.
TEST(Sentence, OfAFitThatStrainsAParameter)
{
    Bench bench;
    bench.answer.null.setting.parameters(0) = .15 + 3.5 * .02;
    EXPECT_THAT(sentenceOf(bench.findings),
        StartsWith("The model fits, but only with friction 3.5 standard deviations from its own measurement"));
    bench.found(Decision::named, {{1, .5}});
    EXPECT_THAT(detailsOf(bench.findings), Contains(HasSubstr("takes friction 3.5 standard deviations from")));
}

/// One that is left, but not far enough ahead, is no finding.
TEST(Sentence, OfAnIsolatedMemberKeepsTheDoubt)
{
    Bench bench;
    bench.found(Decision::set, {{1, .5}}, true);
    bench.answer.otherProbability = 1;
    bench.answer.otherBesideSet = .3;
    EXPECT_THAT(detailsOf(bench.findings), Contains(HasSubstr("does not hold 30 %")));
    EXPECT_THAT(sentenceOf(bench.findings),
        StartsWith("Perhaps water that moves along with a particle (y 0.020), perhaps something that"));
}

TEST(Sentence, OfNothingAndOfSomethingElse)
{
    Bench bench;
    EXPECT_EQ(sentenceOf(bench.findings), "Nothing is missing that these measurements could show.");
    EXPECT_THAT(detailsOf(bench.findings), ElementsAre(HasSubstr("<1 % of such data (p = 0.001)"),
                                               HasSubstr("does not show"), HasSubstr("No condition was held out")));
    bench.answer.decision = Decision::unknown;
    EXPECT_THAT(sentenceOf(bench.findings),
        StartsWith("There is something that the library does not hold: none of its 3 effects"));
    EXPECT_THAT(detailsOf(bench.findings), Each(Not(HasSubstr("How likely")))) << "of none that fits";
}

TEST(Sentence, OfVariantsOfOneThing)
{
    Bench bench;
    bench.found(Decision::named, {{1, .5}, {0, 1}});
    bench.answer.family = "flow";
    EXPECT_THAT(sentenceOf(bench.findings),
        AllOf(HasSubstr(", or the orifice is wider"), HasSubstr("variants of one thing"), Not(HasSubstr("Either"))));
}

/// Parameters with their errors before and after, and what the effect sets: y = .04 a, a = .5 +- .1.
TEST(Fitted, NumbersHaveErrors)
{
    Bench bench;
    bench.found(Decision::named, {{1, .5}});
    const auto numbers = fittedNumbers(bench.findings);
    ASSERT_EQ(numbers.size(), 2U);
    EXPECT_EQ(numbers[0].name, "friction");
    EXPECT_EQ(numbers[0].unit, "rad");
    EXPECT_NEAR(numbers[0].before.value, .2, 1e-12);
    EXPECT_NEAR(numbers[0].before.standardError, .5 * .02, 1e-12);
    EXPECT_NEAR(numbers[0].after->value, .15, 1e-12);
    EXPECT_NEAR(numbers[0].after->standardError, .2 * .02, 1e-12);
    EXPECT_EQ(numbers[1].name, "y");
    EXPECT_EQ(numbers[1].before.value, 0);
    EXPECT_NEAR(numbers[1].after->value, .02, 1e-9);
    EXPECT_NEAR(numbers[1].after->standardError, .004, 1e-9);
}

/// A logarithm that is fitted is shown as what the case gets, too: exp(-.3 +- .01).
TEST(Fitted, ShowsWhatAParameterSets)
{
    Bench bench;
    bench.study.parameters[0].entries.clear();
    bench.study.parameters[0].entries.emplace("x", Expression("exp(friction)"));
    const auto numbers = fittedNumbers(bench.findings);
    ASSERT_EQ(numbers.size(), 2U);
    EXPECT_EQ(numbers[1].name, "x");
    EXPECT_NEAR(numbers[1].before.value, std::exp(.2), 1e-6);
    EXPECT_NEAR(numbers[1].before.standardError, .01 * std::exp(.2), 1e-4);
    EXPECT_FALSE(numbers[1].after);
}

} // namespace

} // namespace clepsydra::identification::tests
