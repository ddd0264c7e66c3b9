/// Sentences, numbers and page of the report, from answers made by hand.
#include "decision/measured.h"
#include "emulator/library.h"
#include "linearSimulator.h"
#include "report/fitted.h"
#include "report/report.h"
#include "report/svg.h"
#include "report/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <memory>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <tuple>

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
    EXPECT_EQ(rounded(0.0999), "0.10");
    EXPECT_EQ(rounded(1.13e-6), "1.1e-06");
    EXPECT_EQ(rounded(-1234, 2), "-1200");
    EXPECT_EQ(rounded(0), "0");
    EXPECT_EQ(rounded(std::numeric_limits<double>::infinity()), "-");
    EXPECT_EQ(withError({0.17321, 0.01189}), "0.173 ± 0.012");
    EXPECT_EQ(withError({2.0612e-3, 3e-5}), "0.002061 ± 0.000030");
    EXPECT_EQ(withError({1.1304e-6, 3e-8}), "1.130e-06 ± 3.0e-08");
    EXPECT_EQ(withError({0, 0.012}), "0.000 ± 0.012");
    EXPECT_EQ(withError({0.15, 0}), "0.1500");
    EXPECT_EQ(percent(0.004), "<1 %");
    EXPECT_EQ(percent(0.999), ">99 %");
    EXPECT_EQ(percent(0.456), "46 %");
    EXPECT_EQ(pValueText(0.0312), "p = 0.03");
    EXPECT_EQ(pValueText(0.312), "p = 0.31");
    EXPECT_EQ(pValueText(1e-274), "p below 1e-6");
}

/// A value that its range bounds lies about one standard error inside; one that is determined well does not count, nor
/// does an interval wider than half of the range.
TEST(Numbers, AtTheEndsOfRanges)
{
    EXPECT_EQ(endOfRange(0.95, 0.05, {0, 1}), "upper");
    EXPECT_EQ(endOfRange(0.9, 0.01, {0, 1}), "");
    EXPECT_EQ(endOfRange(0.5, 0.29, {0, 1}), "");
    EXPECT_EQ(endOfRange(-0.18, 0.7, {-1, 1}), ""); // nearer to the middle than to the end
    EXPECT_EQ(endOfRange(-1, 0, {-1, 1}), "lower");
    EXPECT_EQ(endOfRange(0.99, 0, {-1, 1}), "");
}

/// A study of the linear simulator whose effects have meanings, and an answer.
struct Bench
{
    Bench()
    {
        study.effects[0].meaning = "the orifice is wider or narrower than stated";
        study.effects[0].hint = "a plug gauge";
        study.effects[1].meaning = "water that moves along with a particle.\n";
        study.parameters[0].unit = "rad";
        data.resize(study.conditions.size());
        for (auto& condition : data)
        {
            condition.features = (Eigen::MatrixXd(3, 1) << -2.31, -2.30, -2.29).finished();
            condition.declaredError = Eigen::VectorXd::Zero(1);
        }
        answer.emulator =
            std::make_shared<Emulator>(study, studySimulator, library.runs, measuredFeatures(study, data));
        std::tie(answer.layout, answer.measured) = arrange(study, *answer.emulator, data);
        answer.null.setting = studySimulator.plainSetting();
        answer.null.setting.parameters(0) = 0.2;
        answer.null.fits.resize(1);
        answer.null.fits.front().marginal = Eigen::MatrixXd::Constant(1, 1, 0.25);
        answer.pValue = 0.0009995;
        answer.effects.resize(study.effects.size());
        answer.visibility.detected = answer.visibility.named = Eigen::VectorXd::Ones(3);
        for (auto& finding : answer.effects)
        {
            finding.fit.sd = 0.1;
            finding.parameters = answer.null.setting.parameters;
            finding.fit.marginal = Eigen::MatrixXd::Constant(1, 1, 0.04);
        }
    }

    void found(
        Decision decision, const std::vector<std::pair<std::size_t, double>>& members, bool unlistedCause = false)
    {
        answer.decision = decision;
        answer.unlistedCauseInSet = unlistedCause;
        for (const auto& [effect, amplitude] : members)
        {
            Explanation one;
            one.effects = {effect};
            one.fits = {answer.effects[effect].fit};
            one.setting = studySimulator.plainSetting();
            one.setting.amplitudes(static_cast<Eigen::Index>(effect)) = amplitude;
            one.fits.front().amplitude = amplitude;
            answer.set.push_back(one);
        }
    }

    void heldOutErrors(double before, double after)
    {
        heldOut.conditions = {2};
        const Eigen::VectorXd one = Eigen::VectorXd::Ones(1);
        heldOut.data = {{one, one, one, one}};
        heldOut.predictedBefore = {{one, one, one}};
        heldOut.before.rmsLogError = {before, 0.01};
        heldOut.after.emplace();
        heldOut.after->rmsLogError = {after, 0.004};
        heldOut.improvement = {before - after, 0.01};
        findings.heldOut = &heldOut;
    }

    TemporaryFolder folder;
    Study study = linearStudy(folder, "seed");
    LinearSimulator simulator{true};
    StudySimulator studySimulator{study, simulator};
    Library library = makeLibrary(studySimulator);
    std::vector<MeasuredCondition> data;
    Answer answer;
    HeldOutResult heldOut;
    Findings findings{&study, &answer, nullptr, nullptr, &studySimulator, nullptr, nullptr};
};

struct Sentences
{
    std::string summary;
    std::vector<std::string> details, next, assumptions;
};

Sentences sentencesOf(const Findings& findings)
{
    const auto report = jsonOf(findings);
    return {report["summary"], report["details"], report["measureNext"], report["assumptions"]};
}

/// Forms of a number, an estimate without an error, and what counts as false.
TEST(Filled, FormsOfNumbers)
{
    const nlohmann::ordered_json data = {{"count", 12345}, {"small", 0.004}, {"none", nullptr}, {"empty", ""},
        {"zero", 0}, {"no", false}, {"yes", true}, {"estimate", {{"value", 0.17321}, {"standardError", 0.01189}}},
        {"exact", {{"value", 2.5}, {"sd", nullptr}}}};
    EXPECT_EQ(filled("{{count.text}}, {{small.text}}, {{small.share}}, {{small.percent}}", data, Escape::none),
        "12345, 0.00400, <1 %, 0.40 %");
    EXPECT_EQ(filled("{{small.share}}", data, Escape::html), "&lt;1 %");
    EXPECT_EQ(filled("{{estimate.text}}, {{exact.text}}", data, Escape::none), "0.173 ± 0.012, 2.500");
    EXPECT_EQ(filled("{{#none}}1{{/none}}{{#empty}}2{{/empty}}{{#zero}}3{{/zero}}{{#no}}4{{/no}}{{#yes}}5{{/yes}}",
                  data, Escape::none),
        "35");
    EXPECT_THROW(filled("{{#open}}", data, Escape::none), std::logic_error);
}

/// Names of a study are texts, not elements of the page.
TEST(Page, EscapesTheStudysTexts)
{
    const nlohmann::ordered_json number = {{"value", 2.0}, {"standardError", 0.1}};
    const nlohmann::ordered_json none = nlohmann::ordered_json::array();
    nlohmann::ordered_json report = {{"study", "<i>"}, {"program", ""}, {"summary", "a < b & 'c'"}, {"details", none},
        {"fitted", none}, {"measureNext", none}, {"nextExperiment", none}, {"effects", none}, {"residual", none},
        {"assumptions", {"<script>"}}, {"remarks", none}, {"heldOut", {{"before", nullptr}}},
        {"runs", {{"byPurpose", {{"<b>", 1}}}}}};
    report["numbers"].push_back({{"condition", "<wet>"}, {"feature", "\"rate\" & <end>"}, {"measured", number},
        {"before", number}, {"after", nullptr}});
    const std::string page = htmlOf(report, std::nullopt);
    for (const auto* text : {"<i>", "<script>", "<b>", "<wet>", "<end>"})
    {
        EXPECT_THAT(page, Not(HasSubstr(text)));
    }
    EXPECT_THAT(page, HasSubstr("a &lt; b &amp; &apos;c&apos;"));
    EXPECT_THAT(page, HasSubstr("aria-label=\"&quot;rate&quot; &amp; &lt;end&gt; "));
    EXPECT_THAT(page, HasSubstr("&lt;wet&gt;</text>"));
    EXPECT_THAT(page, HasSubstr("No condition was held out"));
}

/// Numbers of held-out conditions are shown in the units of the data; a report without units has them in SI units.
TEST(Page, ShowsHeldOutNumbersInTheirUnits)
{
    const nlohmann::ordered_json none = nlohmann::ordered_json::array();
    nlohmann::ordered_json report = {{"study", "s"}, {"program", ""}, {"summary", ""}, {"details", none},
        {"fitted", none}, {"measureNext", none}, {"nextExperiment", none}, {"effects", none}, {"residual", none},
        {"assumptions", none}, {"remarks", none}, {"runs", {{"byPurpose", nlohmann::ordered_json::object()}}}};
    const nlohmann::ordered_json number = {{"value", 0.0123}, {"standardError", 0.0001}};
    report["heldOut"] = {{"before", {{"rmsLogError", 0.1}, {"standardError", 0.01}}},
        {"numbers", {{{"condition", "wet"}, {"feature", "rate"}, {"measured", number}, {"before", number},
                        {"after", nullptr}}}}};
    EXPECT_THAT(htmlOf(report, std::nullopt),
        AllOf(HasSubstr("<td>SI units</td><td class=\"n\">0.01230 ± 0.00010</td>"), HasSubstr("rate [SI units]")));
    report["units"] = {{"rate", {{"unit", "g/s"}, {"si", 1e-3}}}};
    EXPECT_THAT(htmlOf(report, std::nullopt),
        AllOf(HasSubstr("<td>g/s</td><td class=\"n\">12.30 ± 0.10</td>"), HasSubstr("rate [g/s]")));
}

/// Values from 0.1 to 100 have a logarithmic axis: ten times as much is twice as far. What is not finite is not drawn.
TEST(Page, PlotsValuesInRows)
{
    Plot plot{"title", {}, {}, {"first", "second"}};
    for (const auto& [value, y] : {std::pair(0.1, 0.5), std::pair(1.0, 1.0), std::pair(100.0, 1.5)})
    {
        plot.dot(value, 0.0, y, "#000", "measured");
    }
    plot.dot(std::numeric_limits<double>::quiet_NaN(), 0.0, 1.5, "#000", "other");
    const std::string svg = plot.svg();
    const std::regex place("linecap:round[^>]*points=\"([0-9.]+),([0-9.]+) [^>]*>");
    std::vector<std::array<double, 2>> dots;
    for (std::sregex_iterator at(svg.begin(), svg.end(), place), end; at != end; ++at)
    {
        dots.push_back({std::stod((*at)[1]), std::stod((*at)[2])});
    }
    ASSERT_EQ(dots.size(), 3U);
    EXPECT_NEAR(dots[2][0] - dots[1][0], 2.0 * (dots[1][0] - dots[0][0]), 0.2);
    EXPECT_NEAR(dots[2][1] - dots[0][1], 20.0, 0.2) << "rows from top to bottom";
    EXPECT_EQ(svg.find(">measured<"), svg.rfind(">measured<")) << "one entry of the legend";
    EXPECT_THAT(svg, AllOf(HasSubstr(">measured<"), HasSubstr(">first<"), HasSubstr(">0.2<"), HasSubstr(">100<")));
}

/// A band and lines with numbers at both axes, at distances of 1, 2 or 5.
TEST(Page, PlotsCurves)
{
    Plot plot{"title", "time [s]", "mass [g]"};
    plot.line(Eigen::Array3d(0, 1, 3), Eigen::Array3d(-2, 0, 4), "stroke:#000", "measured");
    const std::string svg = plot.svg();
    EXPECT_THAT(svg, HasSubstr("points=\"62.4,238.0 190.9,172.0 448.0,40.0 \""));
    for (const auto* text : {">0.5<", ">2.5<", ">-2<", ">0<", ">4<", ">time [s]<", ">mass [g]<"})
    {
        EXPECT_THAT(svg, HasSubstr(text));
    }
    EXPECT_THAT(svg, Not(HasSubstr(">-0<")));
}

/// Reports are committed; the reason of a failed run must not contain the folders of the machine that made it.
TEST(Text, PathsFromTheStudysFolder)
{
    const TemporaryFolder folder;
    const Study study = linearStudy(folder, "seed");
    const std::string here = folder.path().string();
    EXPECT_EQ(fromStudy(study, "ended in " + here + "/work/case: see " + here + "/work/case/log, or /etc"),
        "ended in work/case: see work/case/log, or /etc");
}

/// One sentence with the effect's meaning from the library and the error before and after.
TEST(Sentence, SaysWhatWasFound)
{
    Bench bench;
    bench.found(Decision::named, {{1, 0.5}});
    bench.heldOutErrors(0.351, 0.0207);
    EXPECT_EQ(sentencesOf(bench.findings).summary,
        "Of the 3 effects tried only this one fits: water that moves along with a particle (y 0.020); an untried "
        "effect "
        "may act alike here; with it the error on held-out measurements falls from 35 to 2.1 %.");
    bench.heldOut.better = true;
    EXPECT_EQ(sentencesOf(bench.findings).summary,
        "The residual is explained by: water that moves along with a particle (y 0.020), or something that acts like "
        "it, "
        "which also predicts the held-out measurements; with it the error on held-out measurements falls from 35 to "
        "2.1 %.");
}

/// Held-out data of which no feature was reached are no test, and no "complete".
TEST(Sentence, SaysThatNothingCouldBeCompared)
{
    Bench bench;
    bench.found(Decision::named, {{1, 0.5}});
    bench.heldOutErrors(std::nan(""), std::nan(""));
    bench.heldOut.notScored = {"no measurement of rate in wet"};
    const Sentences sentences = sentencesOf(bench.findings);
    EXPECT_THAT(sentences.summary, Not(HasSubstr("held-out")));
    EXPECT_THAT(sentences.details,
        testing::Contains(
            "No held-out measurement could be compared, so the prediction has not been tested: no measurement "
            "of rate in wet."));
    EXPECT_THAT(sentences.details, Not(testing::Contains(HasSubstr("omplete"))));
}

TEST(Sentence, DoesNotPraiseWhatDoesNotHelp)
{
    for (const auto& [after, says] :
        {std::pair(0.045, "falls from 5.0 ± 1.0 % to 4.50 ± 0.40 %, by less than twice the standard error of the"),
            std::pair(0.06, "rises from 5.0 ± 1.0 % to 6.00 ± 0.40 %, by less than twice"),
            std::pair(0.05, "stays at 5.00 ± 0.40 %"), std::pair(0.09, "rises from 5.0 to 9.0 %")})
    {
        Bench bench;
        bench.found(Decision::named, {{1, 0.5}});
        bench.heldOutErrors(0.05, after);
        EXPECT_THAT(sentencesOf(bench.findings).summary, HasSubstr(says));
    }
}

TEST(Sentence, OfASetSaysWhatToMeasure)
{
    Bench bench;
    bench.found(Decision::set, {{1, 0.5}, {0, -1}}, true);
    EXPECT_THAT(sentencesOf(bench.findings).summary,
        AllOf(StartsWith("The residual has one of these causes: water that moves along with a particle (y 0.020), the "
                         "orifice is wider"),
            HasSubstr(", or a cause that the library does not list; to distinguish them: a plug gauge.")));

    bench.study.conditions[2].role = Role::candidate;
    std::vector<NextExperiment> next(1);
    next[0].condition = 2;
    next[0].outcomes = {{"y", 0.6, Eigen::VectorXd::Constant(1, -2.3), Eigen::VectorXd::Constant(1, 0.02)},
        {"x", 0.4, Eigen::VectorXd::Constant(1, -2.4), Eigen::VectorXd::Constant(1, 0.03)}};
    bench.findings.next = &next;
    EXPECT_THAT(sentencesOf(bench.findings).summary, EndsWith("; to distinguish them, measure again."));
    const auto sentences = sentencesOf(bench.findings).next;
    ASSERT_EQ(sentences.size(), 2U);
    EXPECT_THAT(sentences[0], AllOf(HasSubstr("Measure again"), HasSubstr("10 % larger with y than with x"),
                                  HasSubstr("a standard error of 3.0 %")));
    EXPECT_THAT(sentences[1], HasSubstr("a plug gauge"));
}

/// What a single explanation predicts is given in the units of the data: 0.1 kg/s ± 2 % in those of a measured number, or
/// those that follow from the columns of a curve; in SI units only where nothing was measured.
TEST(Sentence, PredictsInTheUnitsOfTheData)
{
    const auto predicted = [](const Measurement& measured) {
        Bench bench;
        bench.found(Decision::named, {{1, 0.5}});
        bench.study.conditions[0].measured = measured;
        std::vector<NextExperiment> next(1);
        next[0].condition = 2;
        next[0].outcomes = {{"y", 1, Eigen::VectorXd::Constant(1, std::log(0.1)), Eigen::VectorXd::Constant(1, 0.02)}};
        bench.findings.next = &next;
        return sentencesOf(bench.findings).next.front();
    };
    Measurement number;
    number.numbers = {{0, {}, 0, "g/s", 1e-3}};
    Measurement share;
    share.numbers = {{0, {}, 0, "1", 1}};
    Measurement curve;
    curve.files = {"a.csv"};
    curve.time.unit = "min";
    curve.time.siUnits = 60;
    curve.value.unit = "kg";
    EXPECT_THAT(
        predicted(number), AllOf(StartsWith("A measurement of again would test y, which predicts 'logMeanRate'"),
                               EndsWith("' 100.0 ± 2.0 g/s there.")));
    EXPECT_THAT(predicted(curve), EndsWith("' 6.00 ± 0.12 kg/min there."));
    EXPECT_THAT(predicted(share), EndsWith("' 0.1000 ± 0.0020 there."));
    EXPECT_THAT(predicted({}), EndsWith("' 0.1000 ± 0.0020 (SI units) there."));
}

/// Two pairs that share an effect: how it is measured is said once.
TEST(Sentence, GivesEachHintOnce)
{
    Bench bench;
    bench.found(Decision::set, {{1, 0.5}, {2, 0.5}});
    for (auto& member : bench.answer.set)
    {
        member.effects.push_back(0);
        member.fits.push_back(bench.answer.effects[0].fit);
    }
    const auto [summary, details, next, assumptions] = sentencesOf(bench.findings);
    EXPECT_THAT(next, ElementsAre(HasSubstr("x can be measured independently: a plug gauge")));
    EXPECT_THAT(details, Contains(StartsWith("If two effects act at once, the probabilities are: ")));
    EXPECT_THAT(details, Contains("No run was made at the fit of y with x and clock with x: it is interpolated."));
}

/// A fit whose friction contradicts its independent measurement may compensate for a missing effect; the sentence must
/// say so.
TEST(Sentence, OfAFitThatContradictsAMeasurement)
{
    Bench bench;
    bench.answer.null.setting.parameters(0) = 0.15 + 3.5 * 0.02;
    EXPECT_THAT(sentencesOf(bench.findings).summary,
        StartsWith("The model fits, but only with friction 3.5 standard deviations from the independent measurement"));
    bench.found(Decision::named, {{1, 0.5}});
    EXPECT_THAT(
        sentencesOf(bench.findings).details, Contains(HasSubstr("moves friction 3.5 standard deviations from")));
}

/// A single member that may not be named leaves an unlisted cause possible.
TEST(Sentence, OfASingleMemberKeepsTheDoubt)
{
    Bench bench;
    bench.found(Decision::set, {{1, 0.5}}, true);
    bench.answer.otherProbability = 0.3;
    bench.answer.oddsOfName = {2.13, 3.46};
    EXPECT_THAT(sentencesOf(bench.findings).details, Contains(EndsWith("does not list 30 %.")));
    bench.answer.otherThreshold = 0.4;
    EXPECT_THAT(sentencesOf(bench.findings).details,
        Contains(EndsWith("does not list 30 %, which stays a candidate because no name can be given.")));
    EXPECT_THAT(sentencesOf(bench.findings).details, Contains(HasSubstr("causes are 2.13, and a name needs 3.46")));
    EXPECT_THAT(sentencesOf(bench.findings).summary,
        StartsWith("The residual has one of these causes: water that moves along with a particle (y 0.020), or a cause "
                   "that"));
}

TEST(Sentence, OfNoResidualAndOfAnUnlistedCause)
{
    Bench bench;
    EXPECT_EQ(sentencesOf(bench.findings).summary, "The model agrees with these measurements within their noise.");
    EXPECT_THAT(sentencesOf(bench.findings).details,
        ElementsAre(HasSubstr("Friction alone can take the residual from"), HasSubstr("<1 % of such data (p = 0.001)"),
            HasSubstr("does not show"), HasSubstr("No condition was held out")));
    bench.answer.decision = Decision::unknown;
    EXPECT_THAT(sentencesOf(bench.findings).summary,
        StartsWith("The residual has a cause that the library does not list: none of its 3 effects"));
    EXPECT_THAT(sentencesOf(bench.findings).details, Each(Not(HasSubstr("probabilities")))) << "no explanation fits";
}

TEST(Sentence, OfVariantsOfOneEffect)
{
    Bench bench;
    bench.found(Decision::named, {{1, 0.5}, {0, 1}});
    bench.answer.family = "flow";
    EXPECT_THAT(sentencesOf(bench.findings).summary,
        AllOf(HasSubstr(", or the orifice is wider"), HasSubstr("variants of one effect"),
            Not(HasSubstr("one of these causes"))));
}

/// The prior of a parameter is called a measurement only if it is one.
TEST(Sentence, SaysWhereAPriorComesFrom)
{
    for (const auto& [from, fit, assumed] :
        {std::tuple(Origin::measured, "the independent measurement", "measurement gave"),
            std::tuple(Origin::handbook, "the handbook's value", "a handbook gives 0.15"),
            std::tuple(Origin::guess, "the guess", "guessed to be 0.15")})
    {
        Bench bench;
        bench.study.parameters[0].from = from;
        bench.answer.null.setting.parameters(0) = 0.15 + 3.5 * 0.02;
        EXPECT_THAT(sentencesOf(bench.findings).summary, HasSubstr(std::string("3.5 standard deviations from ") + fit));
        EXPECT_THAT(sentencesOf(bench.findings).assumptions, Contains(HasSubstr(assumed)));
        const auto words = testing::AnyOf(HasSubstr("independent measurement"), HasSubstr("measurement gave"));
        if (from != Origin::measured)
        {
            EXPECT_THAT(sentencesOf(bench.findings).summary, Not(words));
            EXPECT_THAT(sentencesOf(bench.findings).assumptions, Each(Not(words)));
        }
    }
}

/// Where no effect explains the residual, the nearest one is named, with what it takes of the chi-square: 9 of 10 parts.
TEST(Sentence, NamesTheNearestEffect)
{
    Bench bench;
    bench.found(Decision::unknown, {{1, 0.5}});
    bench.answer.nearest = bench.answer.set.front();
    bench.answer.set.clear();
    bench.answer.null.chiSquare = 650;
    bench.answer.nearest->chiSquare = 65;
    EXPECT_THAT(sentencesOf(bench.findings).details,
        Contains(AllOf(HasSubstr("Nearest is water that moves along with a particle"), HasSubstr("takes 90 %"),
            HasSubstr("chi-square 650 without, 65.0 with it, in 2 numbers"),
            HasSubstr("what is left is in condition"))));
    EXPECT_THAT(sentencesOf(bench.findings).details, Contains(HasSubstr("Condition dry decides most: there, y takes")));

    bench.heldOutErrors(0.351, 0.0207);
    bench.heldOut.nearest = bench.heldOut.after;
    bench.heldOut.nearest->rmsLogError = {0.21, 0.03};
    bench.heldOut.after.reset();
    EXPECT_THAT(sentencesOf(bench.findings).details,
        AllOf(Contains("With the nearest effect, y, the error would be 21.0 ± 3.0 %."),
            Each(AllOf(Not(HasSubstr("Better")), Not(HasSubstr("omplete"))))));
}

/// A name stands beside the causes that most data cannot distinguish from it, in whichever of the two such data were.
TEST(Sentence, NamesCausesThatActAlike)
{
    Bench bench;
    bench.found(Decision::named, {{1, 0.5}});
    EXPECT_THAT(sentencesOf(bench.findings).details, Each(Not(HasSubstr("act like"))));
    bench.answer.visibility.alike = {{1, 0}, {0, 1}, {2, 1}, {0, 2}};
    EXPECT_THAT(sentencesOf(bench.findings).details,
        Contains("Causes that act like y in these conditions, even at full size: x, clock."));
}

/// A probable effect that is not in the set has its reason printed, as has a value at the end of its range, and what a
/// measurement would have to give to refute the answer: y = 0.04 a, between 0.3 and 0.7.
TEST(Sentence, GivesReasons)
{
    Bench bench;
    bench.answer.effects[1].fit.lower = 0.3;
    bench.answer.effects[1].fit.upper = 0.7;
    bench.found(Decision::set, {{1, 0.5}}, true);
    bench.answer.effects[0].probability = 0.3;
    bench.answer.effects[0].notInSetBecause = "it fits no better than no effect";
    bench.answer.null.setting.parameters(0) = 1;
    const auto details = sentencesOf(bench.findings).details;
    EXPECT_THAT(
        details, Contains("X is no candidate in spite of its probability, 30 %: it fits no better than no effect."));
    bench.answer.effects[0].probability = 0.003; // needs no reason
    EXPECT_THAT(sentencesOf(bench.findings).details, Each(Not(HasSubstr("X is no candidate"))));
    EXPECT_THAT(
        details, Contains("Friction lies at the upper end of its range, 0 to 1.0, in the fit without an effect."));
    EXPECT_THAT(details, Contains(HasSubstr("does not lie between y 0.012 and y 0.028 (95 %)")));
}

/// An interval that begins at 0, which is also the end of the range, contains 0.
TEST(Sentence, SaysThatAnIntervalContainsZero)
{
    for (const auto& [lower, contains] : {std::pair(-0.1, true), std::pair(0.0, true), std::pair(0.1, false)})
    {
        Bench bench;
        bench.found(Decision::set, {{1, 0.5}}, true);
        bench.answer.effects[1].inSet = true;
        bench.answer.effects[1].fit.lower = lower;
        bench.answer.effects[1].fit.upper = 1.08;
        const auto details = sentencesOf(bench.findings).details;
        EXPECT_EQ(testing::Value(details, Contains("The 95 % interval of the size of y contains 0.")), contains)
            << lower;
    }
}

/// The fit without the measurement of an amplitude, 0.9 ± 0.1, is compared with it.
TEST(Sentence, ComparesAMeasuredAmplitude)
{
    for (const auto& [mean, says] : {std::pair(0.8, "agree"), std::pair(0.2, "disagree")})
    {
        Bench bench;
        bench.found(Decision::set, {{1, 0.5}}, true);
        bench.study.effects[1].measured = Normal{mean, 0.05};
        bench.answer.effects[1].inSet = true;
        bench.answer.effects[1].alone = Fit{};
        bench.answer.effects[1].alone->amplitude = 0.9;
        bench.answer.effects[1].alone->sd = 0.1;
        EXPECT_THAT(
            sentencesOf(bench.findings).details, Contains(HasSubstr(std::string("0.90 ± 0.10: the two ") + says)));
    }
}

/// The text names the data that were left out and each run that failed, with what became of it.
TEST(Text, SaysWhatIsMissing)
{
    const auto failure = [](const char* purpose, int seed, bool isRepeated) -> nlohmann::ordered_json {
        return {{"purpose", purpose}, {"condition", "dry"}, {"seed", seed}, {"reason", "no licence"},
            {"repeatedWithAnotherSeed", isRepeated}};
    };
    std::ostringstream out;
    writeText({{"summary", "s"}, {"remarks", {"feature end is left out"}},
                  {"runs", {{"failures", {failure("design", 10007, true), failure("base", 5, false)}}}}},
        out);
    EXPECT_THAT(out.str(),
        AllOf(HasSubstr("feature end is left out\n"),
            HasSubstr(
                "Failed run (design, condition dry, seed 10007; reason: report.html): repeated with another seed"),
            HasSubstr("Failed run (base, condition dry, seed 5; reason: report.html): excluded")));
}

/// Parameters with their errors before and after, and the entry that the effect sets: y = 0.04 a, a = 0.5 ± 0.1.
TEST(Fitted, NumbersHaveErrors)
{
    Bench bench;
    bench.found(Decision::named, {{1, 0.5}});
    const auto numbers = fittedNumbers(bench.findings);
    ASSERT_EQ(numbers.size(), 2U);
    EXPECT_EQ(numbers[0]["name"], "friction");
    EXPECT_EQ(numbers[0]["unit"], "rad");
    EXPECT_NEAR(numbers[0]["withoutEffect"]["value"].get<double>(), 0.2, 1e-12);
    EXPECT_NEAR(numbers[0]["withoutEffect"]["standardError"].get<double>(), 0.5 * 0.02, 1e-12);
    EXPECT_NEAR(numbers[0]["withEffect"]["value"].get<double>(), 0.15, 1e-12);
    EXPECT_NEAR(numbers[0]["withEffect"]["standardError"].get<double>(), 0.2 * 0.02, 1e-12);
    EXPECT_EQ(numbers[1]["name"], "y");
    EXPECT_EQ(numbers[1]["withoutEffect"]["value"], 0);
    EXPECT_NEAR(numbers[1]["withEffect"]["value"].get<double>(), 0.02, 1e-9);
    EXPECT_NEAR(numbers[1]["withEffect"]["standardError"].get<double>(), 0.004, 1e-9);
}

/// A fitted logarithm is also shown as the entry that the case receives: exp(-0.3 ± 0.01).
TEST(Fitted, ShowsWhatAParameterSets)
{
    Bench bench;
    bench.study.parameters[0].entries.clear();
    bench.study.parameters[0].entries.emplace("x", Expression("exp(friction)"));
    const auto numbers = fittedNumbers(bench.findings);
    ASSERT_EQ(numbers.size(), 2U);
    EXPECT_EQ(numbers[1]["name"], "x");
    EXPECT_NEAR(numbers[1]["withoutEffect"]["value"].get<double>(), std::exp(0.2), 1e-6);
    EXPECT_NEAR(numbers[1]["withoutEffect"]["standardError"].get<double>(), 0.01 * std::exp(0.2), 1e-4);
    EXPECT_TRUE(numbers[1]["withEffect"].is_null());
}

} // namespace

} // namespace clepsydra::identification::tests
