#include "report/sentences.h"

#include "lists.h"
#include "report/fitted.h"
#include "report/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace clepsydra::identification
{

namespace
{

using Json = nlohmann::ordered_json;

/// Each line is a sentence.
constexpr const char* sentences =
#include "report/sentences.mustache"
    ;

/// "this, that and those"
std::string joined(const std::vector<std::string>& parts, const std::string& last)
{
    std::string all;
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
        all += (i == 0 ? "" : i + 1 < parts.size() ? ", " : last) + parts[i];
    }
    return all;
}

std::string capitalised(std::string text)
{
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text;
}

/// A text of the study without its line breaks.
std::string inLine(std::string text)
{
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

/// Meaning of an explanation as the library states it, with its fitted size.
std::string meaningOf(const Findings& findings, const Explanation& explanation)
{
    const auto meanings = mapped(explanation.effects, [&](std::size_t e) {
        const Effect& effect = findings.study->effects[e];
        std::string own = inLine(effect.meaning.empty() ? effect.name : effect.meaning);
        return own.erase(own.find_last_not_of(" .") + 1);
    });
    const std::string meaning = joined(meanings, ", together with ");
    const std::string size = describeSize(findings, explanation);
    return size.empty() ? meaning : size.rfind(meaning + ' ', 0) == 0 ? size : meaning + " (" + size + ')';
}

/// An error of a feature. Differences of logarithms are relative, and are given in percent.
std::string errorText(bool isLog, const Estimate& error)
{
    const double factor = isLog ? 100.0 : 1.0;
    return withError({factor * error.value, factor * error.standardError}) + (isLog ? " %" : "");
}

std::string sizeText(bool isLog, double size)
{
    return rounded((isLog ? 100.0 : 1.0) * size) + (isLog ? " %" : "");
}

/// Parameters that the null fit moves far from their priors: "friction 5.9 standard deviations from the guess".
std::vector<std::string> strainedParameters(const Findings& findings)
{
    constexpr double far = 3.0; // standard deviations
    std::vector<std::string> names;
    for (std::size_t p = 0; p < findings.study->parameters.size(); ++p)
    {
        const auto& one = findings.study->parameters[p];
        const double sds = std::abs(findings.answer->null.setting.parameters(p) - one.mean) / one.sd;
        if (sds > far)
        {
            names.push_back(one.name + ' ' + rounded(sds) + " standard deviations from "
                            + (one.from == Origin::measured    ? "the independent measurement"
                                : one.from == Origin::handbook ? "the handbook's value"
                                                               : "the guess"));
        }
    }
    return names;
}

/// "condition wet, feature 'late': measured minus simulated is 12 ± 2 %", of the most significant residual
std::string largestOf(const Study& study, const std::vector<Residual>& residuals)
{
    const auto inErrors = [](const Residual& one) { return std::abs(one.estimate.value) / one.estimate.standardError; };
    const auto largest = std::max_element(residuals.begin(), residuals.end(),
        [&](const Residual& a, const Residual& b) { return inErrors(a) < inErrors(b); });
    const Feature& feature = study.features[largest->feature];
    return "condition " + study.conditions[largest->condition].name + ", feature '" + feature.name
           + "': measured minus simulated is " + errorText(feature.kind->isLog(), largest->estimate);
}

std::string inErrors(const std::vector<Residual>& residuals)
{
    return rounded(rmsInErrors(residuals));
}

/// The condition whose residual the explanation reduces most, in units of the standard errors.
Json decidingCondition(const Findings& findings, const Explanation& best)
{
    const Study& study = *findings.study;
    const auto without = residualsOf(findings, findings.answer->null.setting);
    const auto with = residualsOf(findings, best.setting);
    std::map<std::size_t, std::pair<std::vector<Residual>, std::vector<Residual>>> byCondition;
    for (std::size_t i = 0; i < without.size(); ++i)
    {
        byCondition[without[i].condition].first.push_back(without[i]);
        byCondition[without[i].condition].second.push_back(with[i]);
    }
    const auto fall = [](const auto& one) {
        const auto& [before, after] = one.second;
        return (std::pow(rmsInErrors(before), 2) - std::pow(rmsInErrors(after), 2))
               * static_cast<double>(before.size());
    };
    const auto decides = std::max_element(
        byCondition.begin(), byCondition.end(), [&](const auto& a, const auto& b) { return fall(a) < fall(b); });
    if (byCondition.size() < 2)
    {
        return nullptr;
    }
    return {{"condition", study.conditions[decides->first].name}, {"effect", nameOf(study, best.effects)},
        {"from", inErrors(decides->second.first)}, {"to", inErrors(decides->second.second)}};
}

/// What the fit of the parameters alone does to the residual.
Json parameterFacts(const Findings& findings, const Explanation* best)
{
    const Study& study = *findings.study;
    Setting prior = findings.answer->null.setting;
    for (std::size_t p = 0; p < study.parameters.size(); ++p)
    {
        prior.parameters(p) = study.parameters[p].mean;
    }
    const auto names = mapped(study.parameters, [](const Parameter& one) { return one.name; });
    return {{"names", capitalised(joined(names, " and "))}, {"prior", inErrors(residualsOf(findings, prior))},
        {"fitted", inErrors(residualsOf(findings, findings.answer->null.setting))},
        {"best", best == nullptr ? Json(nullptr)
                                 : Json{{"effect", nameOf(study, best->effects)},
                                     {"residual", inErrors(residualsOf(findings, best->setting))}}}};
}

/// A measured size outside of the fitted interval would refute an effect.
Json refutingFacts(const Findings& findings, const Explanation& best)
{
    const std::size_t e = best.effects.front();
    const Effect& effect = findings.study->effects[e];
    Json facts = {{"effect", capitalised(nameOf(*findings.study, best.effects))}, {"ownHint", inLine(effect.hint)},
        {"lower", nullptr}};
    if (effect.isSwitch || best.effects.size() > 1)
    {
        return effect.hint.empty() ? Json(nullptr) : facts;
    }
    for (const auto& [key, amplitude] :
        {std::pair("lower", best.fits.front().lower), std::pair("upper", best.fits.front().upper)})
    {
        Explanation end = best;
        end.setting.amplitudes(e) = amplitude;
        facts[key] = describeSize(findings, end);
    }
    return facts;
}

/// Why probable effects are not in the set, and what is doubtful about those that are.
Json doubtsOf(const Findings& findings)
{
    Json doubts = Json::array();
    for (std::size_t e = 0; e < findings.answer->effects.size(); ++e)
    {
        const Effect& effect = findings.study->effects[e];
        const EffectFinding& finding = findings.answer->effects[e];
        const auto agrees = agreesWithMeasurement(effect, finding);
        doubts.push_back({{"effect", effect.name}, {"capitalised", capitalised(effect.name)},
            {"probability", percent(finding.probability)}, {"excluded", finding.notInSetBecause},
            {"containsZero", finding.inSet && !effect.isSwitch && finding.fit.lower <= 0.0 && finding.fit.upper >= 0.0},
            {"compared", nullptr}});
        if (finding.inSet && agrees)
        {
            doubts.back()["compared"] = {{"measured", withError({effect.measured->mean, effect.measured->sd})},
                {"alone", withError({finding.alone->amplitude, finding.alone->sd})}, {"agrees", *agrees}};
        }
    }
    return doubts;
}

/// "falls from 35 to 2.1 %", of the error on the held-out conditions. A change that its standard error may explain is
/// given with all errors; whether the prediction is better is said by the joint test alone.
std::string changeText(bool isLog, const HeldOutResult& heldOut)
{
    const Estimate& before = heldOut.before.rmsLogError;
    const Estimate& after = heldOut.after->rmsLogError;
    const auto& [fall, error] = heldOut.improvement;
    if (fall == 0.0)
    {
        return "stays at " + errorText(isLog, after);
    }
    const std::string begin = fall > 0.0 ? "falls from " : "rises from ";
    if (std::abs(fall) > 2.0 * error)
    {
        return begin + rounded((isLog ? 100.0 : 1.0) * before.value) + " to " + sizeText(isLog, after.value);
    }
    return begin + errorText(isLog, before) + " to " + errorText(isLog, after)
           + ", by less than twice the standard error of the difference";
}

/// How the explanations predict the held-out conditions.
Json heldOutFacts(const Findings& findings)
{
    const Study& study = *findings.study;
    const HeldOutResult& heldOut = *findings.heldOut;
    const bool isLog = std::any_of(
        study.features.begin(), study.features.end(), [](const Feature& feature) { return feature.kind->isLog(); });
    Json facts = {{"before", errorText(isLog, heldOut.before.rmsLogError)}, {"after", nullptr}, {"change", nullptr},
        {"oneMore", errorText(isLog, heldOut.oneMoreParameter.rmsLogError)},
        {"noiseFloor", sizeText(isLog, heldOut.noiseFloor)}, {"better", heldOut.better}, {"complete", heldOut.complete},
        {"notBetterBecause", joined(heldOut.notBetterBecause, ", and ")},
        {"notScored", joined(heldOut.notScored, ", ")}};
    if (heldOut.nearest)
    {
        facts["withNearest"] = {{"effect", nameOf(study, findings.answer->nearest->effects)},
            {"error", errorText(isLog, heldOut.nearest->rmsLogError)}};
    }
    if (!heldOut.after)
    {
        return facts;
    }
    const auto against = [&](const LogRatio& ratio, const std::string& other) {
        return std::string(
                   ratio.isBeyondChance(study.settings.level) ? "better than " : "not significantly better than ")
               + other + " (log ratio " + rounded(ratio.value) + ", " + pValueText(ratio.pValue) + ')';
    };
    std::vector<std::string> compared = {
        against(heldOut.after->overNull, "no effect"), against(heldOut.overOneMore, "one more free parameter")};
    if (heldOut.gaussianProcess)
    {
        compared.push_back(against(heldOut.overGaussianProcess, "a Gaussian process on the residual"));
    }
    facts["after"] = errorText(isLog, heldOut.after->rmsLogError);
    facts["change"] = changeText(isLog, heldOut);
    facts["compared"] = joined(compared, ", and ");
    facts["left"] = pValueText(heldOut.after->pValue);
    return facts;
}

/// What the next measurement would show: the prediction of a single explanation, or the feature in which the two most
/// likely ones differ most.
Json nextFacts(const Study& study, const NextExperiment& next)
{
    const auto& outcomes = next.outcomes;
    Json facts = {{"candidate", study.conditions[next.condition].name}, {"first", outcomes.front().name}};
    if (outcomes.size() == 1)
    {
        const auto& [name, probability, features, sd] = outcomes.front();
        std::vector<std::string> numbers;
        for (std::size_t f = 0; f < study.features.size(); ++f)
        {
            if (std::isfinite(features(f)))
            {
                const bool isLog = study.features[f].kind->isLog();
                const double value = isLog ? std::exp(features(f)) : features(f);
                numbers.push_back(
                    '\'' + study.features[f].name + "' " + withError({value, (isLog ? value : 1.0) * sd(f)}));
            }
        }
        facts["test"] = {{"predicted", joined(numbers, " and ")}};
        return facts;
    }
    Eigen::Index best = 0;
    const Eigen::ArrayXd apart = (outcomes[0].features - outcomes[1].features).array()
                                 / (outcomes[0].sd.array().square() + outcomes[1].sd.array().square()).sqrt();
    apart.isFinite().select(apart.abs(), 0.0).maxCoeff(&best);
    const bool isLog = study.features[best].kind->isLog();
    const double difference = outcomes[0].features(best) - outcomes[1].features(best);
    facts["distinction"] = {{"feature", study.features[best].name},
        {"difference", sizeText(isLog, std::abs(difference))}, {"larger", difference > 0.0},
        {"second", outcomes[1].name}, {"error", sizeText(isLog, std::max(outcomes[0].sd(best), outcomes[1].sd(best)))}};
    return facts;
}

Json hintsOf(const Findings& findings)
{
    Json hints = Json::array();
    std::vector<std::size_t> hinted; // members of a set may share an effect
    for (const auto& explanation : findings.answer->set)
    {
        for (const auto e : explanation.effects)
        {
            if (const Effect& effect = findings.study->effects[e]; !effect.hint.empty() && !contains(hinted, e))
            {
                hinted.push_back(e);
                hints.push_back({{"effect", effect.name}, {"is", inLine(effect.hint)}});
            }
        }
    }
    return hints;
}

/// Effects that these conditions can hardly distinguish from those that are named, by their names.
std::vector<std::string> alikeTo(const Findings& findings)
{
    std::set<std::size_t> named;
    for (const auto& member : findings.answer->set)
    {
        named.insert(member.effects.begin(), member.effects.end());
    }
    std::set<std::size_t> alike;
    for (const auto& [one, other] : findings.answer->visibility.alike)
    {
        if (named.count(one) != named.count(other))
        {
            alike.insert(named.count(one) > 0 ? other : one);
        }
    }
    return mapped(
        std::vector(alike.begin(), alike.end()), [&](std::size_t e) { return findings.study->effects[e].name; });
}

/// What the sentences on the answer state.
Json answerFacts(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    const Explanation* best = bestOf(answer);
    const std::string grade = gradeOf(findings);
    std::vector<std::string> causes =
        mapped(answer.set, [&](const Explanation& each) { return meaningOf(findings, each); });
    const std::string members = joined(causes, ", or ");
    if (answer.unlistedCauseInSet || causes.size() == 1)
    {
        causes.emplace_back("a cause that the library does not list");
    }
    Json facts = {{nameOf(answer.decision), true}, {"found", !answer.set.empty()}, {"family", answer.family},
        {"predicts", !grade.empty() && grade != "named"}, {"measured", grade == "measured"}, {"members", members},
        {"causes", joined(causes, ", or ")}, {"single", answer.set.size() == 1},
        {"strained", joined(strainedParameters(findings), " and ")}, {"chance", percent(answer.pValue)},
        {"pValue", pValueText(answer.pValue)}, {"otherProbability", percent(answer.otherProbability)},
        {"doubts", doubtsOf(findings)}, {"hints", hintsOf(findings)},
        {"atEnds", mapped(valuesAtEnds(findings), capitalised)},
        {"largest", largestOf(study, residualsOf(findings, answer.null.setting))}};
    facts["hint"] = facts["hints"].empty() ? Json() : facts["hints"].front()["is"];
    std::string probabilities;
    for (const auto& each : answer.set)
    {
        probabilities += meaningOf(findings, each) + ' ' + percent(each.probability) + ", ";
    }
    facts["probabilities"] = probabilities;
    if (answer.nearest)
    {
        facts["nearest"] = {{"meaning", meaningOf(findings, *answer.nearest)},
            {"takes", percent(shareTaken(answer, *answer.nearest))}, {"without", rounded(answer.null.chiSquare, 3)},
            {"with", rounded(answer.nearest->chiSquare, 3)}, {"numbers", answer.measured.mean.size()},
            {"left", largestOf(study, residualsOf(findings, answer.nearest->setting))}};
    }
    if (best != nullptr)
    {
        facts["deciding"] = decidingCondition(findings, *best);
    }
    if (!study.parameters.empty())
    {
        facts["parameters"] = parameterFacts(findings, best);
    }
    if (!answer.set.empty())
    {
        facts["refuted"] = refutingFacts(findings, *best);
    }
    if (answer.oddsOfName && best != nullptr)
    {
        const auto [odds, needed] = *answer.oddsOfName;
        facts["odds"] = {{"effect", nameOf(study, best->effects)}, {"is", rounded(odds)},
            {"needed", std::isfinite(needed) ? rounded(needed) : ""}};
    }
    if (answer.decision == Decision::named)
    {
        facts["alike"] = joined(alikeTo(findings), ", ");
        facts["name"] = namedBy(study, answer);
    }
    if (findings.heldOut != nullptr && !findings.heldOut->conditions.empty())
    {
        facts["heldOut"] = heldOutFacts(findings);
    }
    if (findings.next != nullptr && !findings.next->empty())
    {
        facts.update(nextFacts(study, findings.next->front()));
    }
    return facts;
}

/// What the sentences on the assumptions state.
Json assumedFacts(const Study& study, const Answer& answer)
{
    return {{"priors", mapped(study.parameters,
                           [](const Parameter& one) -> Json {
                               return {{"name", one.name}, {"mean", textOf(one.mean)}, {"sd", textOf(one.sd)},
                                   {"origin", one.from == Origin::measured   ? "an independent measurement gave"
                                              : one.from == Origin::handbook ? "a handbook gives"
                                                                             : "before the fit it was guessed to be"}};
                           })},
        {"scatters", answer.emulator->scatters()}, {"wrongNames", textOf(100.0 * study.settings.wrongNames)},
        {"wrongNamesFound", rounded(100.0 * answer.calibration.wrongNames)},
        {"modelError", study.modelError.maxCoeff() > 0.0}, {"leftOut", mapped(study.leftOut, inLine)},
        {"differ", study.simulator.scatters()}};
}

/// The sentences of one part: summary, details, next or assumptions.
std::vector<std::string> part(const Study& study, const std::string& name, Json facts)
{
    facts[name] = true;
    facts["effectCount"] = study.effects.size();
    std::istringstream text(filled(sentences, facts, Escape::none));
    std::vector<std::string> all;
    for (std::string line; std::getline(text, line);)
    {
        if (!line.empty()) // a section that is left out leaves its line empty
        {
            all.push_back(line);
        }
    }
    return all;
}

} // namespace

std::string gradeOf(const Findings& findings)
{
    const Answer& answer = *findings.answer;
    if (answer.decision != Decision::named)
    {
        return "";
    }
    if (findings.heldOut == nullptr || !findings.heldOut->better)
    {
        return "named";
    }
    const auto& named = answer.set.front().effects;
    return std::all_of(named.begin(), named.end(),
               [&](std::size_t e) {
                   return agreesWithMeasurement(findings.study->effects[e], answer.effects[e]).value_or(false);
               })
               ? "measured"
               : "better";
}

std::string namedBy(const Study& study, const Answer& answer)
{
    return answer.family.empty() ? nameOf(study, answer.set.front().effects) : answer.family;
}

std::string sentenceOf(const Findings& findings)
{
    return part(*findings.study, "summary", answerFacts(findings)).front();
}

std::vector<std::string> detailsOf(const Findings& findings)
{
    return part(*findings.study, "details", answerFacts(findings));
}

std::vector<std::string> nextOf(const Findings& findings)
{
    return part(*findings.study, "next", answerFacts(findings));
}

std::vector<std::string> failedRunsOf(const Study& study, const Effort& effort)
{
    std::map<std::pair<std::string, std::string>, std::vector<Failure>> groups;
    for (const Failure& failure : effort.failures)
    {
        groups[{failure.purpose, failure.condition}].push_back(failure);
    }
    std::vector<std::string> sentences;
    for (const auto& [of, failures] : groups)
    {
        const auto repeated =
            std::count_if(failures.begin(), failures.end(), [](const Failure& failure) { return failure.repeated; });
        sentences.push_back("Failed runs (" + of.first + ", condition " + of.second
                            + "): " + std::to_string(failures.size())
                            + "; repeated with another seed: " + std::to_string(repeated) + ". The first, of seed "
                            + std::to_string(failures.front().seed) + ": " + fromStudy(study, failures.front().reason));
    }
    return sentences;
}

std::vector<std::string> assumptionsOf(const Findings& findings)
{
    const Study& study = *findings.study;
    std::vector<std::string> all = study.assumptions;
    append(all, part(study, "assumptions", assumedFacts(study, *findings.answer)));
    return all;
}

} // namespace clepsydra::identification
