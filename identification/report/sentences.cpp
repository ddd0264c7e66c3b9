#include "lists.h"
#include "report/fitted.h"
#include "report/text.h"
#include "tokens/didYouMean.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace clepsydra::identification
{

namespace
{

/// Each line is a sentence.
constexpr const char* sentences =
#include "report/sentences.mustache"
    ;

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
    const std::string meaning = listed(meanings, ", together with ");
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
    constexpr double far = 3.0;                                                              // standard deviations
    constexpr std::array origins = {"independent measurement", "handbook's value", "guess"}; // as in Origin
    std::vector<std::string> names;
    for (std::size_t p = 0; p < findings.study->parameters.size(); ++p)
    {
        const auto& one = findings.study->parameters[p];
        const double sds = std::abs(findings.answer->null.setting.parameters(p) - one.mean) / one.sd;
        if (sds > far)
        {
            names.push_back(one.name + ' ' + rounded(sds) + " standard deviations from the "
                            + origins[static_cast<std::size_t>(one.from)]);
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
    Estimate residual = largest->estimate;
    if (feature.kind->isLog()) // large differences of logarithms are no relative differences
    {
        residual = {std::expm1(residual.value), std::exp(residual.value) * residual.standardError};
    }
    return "condition " + study.conditions[largest->condition].name + ", feature '" + feature.name
           + "': measured minus simulated is " + errorText(feature.kind->isLog(), residual);
}

/// The condition whose residual an explanation reduces most, in units of the standard errors; null if there is only one.
Json decidingCondition(const Study& study, const std::vector<Residual>& without, const std::vector<Residual>& with)
{
    std::map<std::size_t, std::pair<std::vector<Residual>, std::vector<Residual>>> byCondition;
    for (std::size_t i = 0; i < with.size(); ++i)
    {
        byCondition[without[i].condition].first.push_back(without[i]);
        byCondition[without[i].condition].second.push_back(with[i]);
    }
    if (byCondition.size() < 2)
    {
        return nullptr;
    }
    const auto fall = [](const auto& one) {
        const auto& [before, after] = one.second;
        return (std::pow(rmsInErrors(before), 2) - std::pow(rmsInErrors(after), 2))
               * static_cast<double>(before.size());
    };
    const auto& [condition, residuals] = *std::max_element(
        byCondition.begin(), byCondition.end(), [&](const auto& a, const auto& b) { return fall(a) < fall(b); });
    return {{"condition", study.conditions[condition].name}, {"from", rmsInErrors(residuals.first)},
        {"to", rmsInErrors(residuals.second)}};
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

/// Adds to effects of the report why probable ones are not in the set, and what is doubtful about those that are.
void addDoubts(Json& effects)
{
    constexpr double worthAReason = 0.01; // probability
    for (auto& effect : effects)
    {
        effect["capitalised"] = capitalised(effect["name"]);
        effect["excluded"] = effect["probability"] < worthAReason ? Json() : effect["notInSetBecause"];
        effect["containsZero"] = effect["interval95"][0] <= 0.0 && effect["interval95"][1] >= 0.0;
        if (effect["measured"].is_object())
        {
            effect["measured"]["value"] = effect["measured"]["mean"];
        }
    }
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
    const bool isLog = heldOut.ofLogs;
    Json facts = {{"before", errorText(isLog, heldOut.before.rmsLogError)}, {"after", nullptr}, {"change", nullptr},
        {"oneMore", errorText(isLog, heldOut.oneMoreParameter.rmsLogError)},
        {"noiseFloor", sizeText(isLog, heldOut.noiseFloor)}, {"better", heldOut.better}, {"complete", heldOut.complete},
        {"notBetterBecause", listed(heldOut.notBetterBecause, ", and ")},
        {"notScored", listed(heldOut.notScored, ", ")}};
    if (heldOut.nearest)
    {
        facts["withNearest"] = errorText(isLog, heldOut.nearest->rmsLogError);
    }
    if (!heldOut.after)
    {
        return facts;
    }
    const auto against = [&](const LogRatio& ratio, const std::string& other) {
        return std::string(ratio.isBeyondChance(study.settings.level) ? "better than "
                           : ratio.value >= 0.0                       ? "not significantly better than "
                                                                      : "worse than ")
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
    facts["compared"] = listed(compared, ", and ");
    facts["left"] = heldOut.after->pValue;
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
        const Json units = unitsOf(study);
        std::vector<std::string> numbers;
        for (std::size_t f = 0; f < study.features.size(); ++f)
        {
            if (std::isfinite(features(f)))
            {
                const Feature& feature = study.features[f];
                const Json unit = units.value(feature.name, Json{{"unit", "(SI units)"}, {"si", 1.0}});
                const double siUnits = unit.at("si").get<double>();
                const bool isLog = feature.kind->isLog();
                const double value = (isLog ? std::exp(features(f)) : features(f)) / siUnits;
                const double error = isLog ? value * sd(f) : sd(f) / siUnits;
                numbers.push_back('\'' + feature.name + "' " + withError({value, error})
                                  + (unit.at("unit") == "1" ? "" : ' ' + unit.at("unit").get<std::string>()));
            }
        }
        facts["test"] = {{"predicted", listed(numbers, " and ")}};
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
    const auto isNamed = [&](std::size_t e) {
        return std::any_of(findings.answer->set.begin(), findings.answer->set.end(),
            [&](const Explanation& member) { return contains(member.effects, e); });
    };
    std::set<std::size_t> alike;
    for (const auto& [one, other] : findings.answer->visibility.alike)
    {
        if (isNamed(one) != isNamed(other))
        {
            alike.insert(isNamed(one) ? other : one);
        }
    }
    return mapped(alike, [&](std::size_t e) { return findings.study->effects[e].name; });
}

/// What the sentences state: the report, and more.
Json factsOf(const Json& report, const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    const Explanation* best = bestOf(answer);
    const auto without = residualsOf(findings, answer.null.setting);
    const auto with = best == nullptr ? std::vector<Residual>{} : residualsOf(findings, best->setting);
    const bool predicts = answer.decision == Decision::named && findings.heldOut != nullptr && findings.heldOut->better;
    const bool isConfirmed = predicts && std::all_of(best->effects.begin(), best->effects.end(), [&](std::size_t e) {
        return agreesWithMeasurement(study.effects[e], answer.effects[e]).value_or(false);
    });
    std::vector<std::string> causes =
        mapped(answer.set, [&](const Explanation& each) { return meaningOf(findings, each); });
    const std::string members = listed(causes, ", or ");
    std::string probabilities;
    for (std::size_t i = 0; i < causes.size(); ++i)
    {
        probabilities += causes[i] + ' ' + percent(answer.set[i].probability) + ", ";
    }
    if (answer.unlistedCauseInSet || causes.size() == 1)
    {
        causes.emplace_back("a cause that the library does not list");
    }
    Json facts = report;
    facts.update({{"decided", {{nameOf(answer.decision), true}}}, {"effectCount", study.effects.size()},
        {"found", !answer.set.empty()}, {"single", answer.set.size() == 1}, {"predicts", predicts},
        {"confirmed", isConfirmed}, {"members", members}, {"causes", listed(causes, ", or ")},
        {"probabilities", probabilities}, {"strained", listed(strainedParameters(findings), " and ")},
        {"otherByRule", answer.unlistedCauseInSet && !(answer.otherProbability >= answer.otherThreshold)},
        {"hints", hintsOf(findings)}, {"atEnds", mapped(valuesAtEnds(findings), capitalised)},
        {"largest", largestOf(study, without)}, {"scatters", answer.emulator->scatters()},
        {"wrongNames", textOf(100.0 * study.settings.wrongNames)}, {"modelError", study.modelError.maxCoeff() > 0.0},
        {"leftOut", mapped(study.leftOut, [](const LeftOut& one) { return inLine(one.text()); })},
        {"heldOut", nullptr}});
    addDoubts(facts["effects"]);
    const auto interpolated = numbersWhere(answer.set.size(), // members of the set without a run at their fit
        [&](std::size_t i) { return answer.set[i].runs.empty() && study.settings.decidingRuns > 0; });
    facts["interpolated"] =
        listed(mapped(interpolated, [&](std::size_t i) { return nameOf(study, answer.set[i].effects); }), " and ");
    facts["ofPairs"] = !answer.set.empty() && answer.set.front().effects.size() > 1;
    facts["hint"] = facts["hints"].empty() ? Json() : facts["hints"].front()["is"];
    facts["priors"] = mapped(study.parameters, [](const Parameter& one) -> Json {
        return {{"name", one.name}, {"mean", textOf(one.mean)}, {"sd", textOf(one.sd)}, {nameOf(one.from), true}};
    });
    if (answer.nearest)
    {
        facts["nearest"].update({{"meaning", meaningOf(findings, *answer.nearest)},
            {"numbers", answer.measured.mean.size()}, {"mostOfRest", largestOf(study, with)}});
    }
    if (best != nullptr)
    {
        facts["best"] = nameOf(study, best->effects);
        facts["deciding"] = decidingCondition(study, without, with);
    }
    const auto acting = numbersWhere(study.parameters.size(), // without an effect
        [&](std::size_t p) { return !study.parameters[p].effect; });
    if (!acting.empty())
    {
        const auto names = mapped(acting, [&](std::size_t p) { return study.parameters[p].name; });
        facts["parameters"] = {{"names", capitalised(listed(names, " and "))},
            {"prior", rmsInErrors(residualsOf(findings, findings.studySimulator->plainSetting()))},
            {"fitted", rmsInErrors(without)}, {"residual", rmsInErrors(with)}};
    }
    if (!answer.set.empty())
    {
        facts["refuted"] = refutingFacts(findings, *best);
    }
    if (answer.decision == Decision::named)
    {
        facts["alike"] = listed(alikeTo(findings), ", ");
    }
    if (findings.heldOut != nullptr && !findings.heldOut->conditions.empty())
    {
        const HeldOutResult& heldOut = *findings.heldOut;
        const bool isCompared = std::isfinite(heldOut.before.rmsLogError.value);
        facts[isCompared ? "heldOut" : "notCompared"] =
            isCompared ? heldOutFacts(findings) : Json(listed(heldOut.notScored, ", "));
    }
    if (findings.next != nullptr && !findings.next->empty())
    {
        facts.update(nextFacts(study, findings.next->front()));
    }
    return facts;
}

/// The sentences of one part of the template.
std::vector<std::string> part(const std::string& name, Json facts)
{
    facts[name] = true;
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

void addSentences(Json& report, const Findings& findings)
{
    const Json facts = factsOf(report, findings);
    std::vector<std::string> assumptions = findings.study->assumptions;
    append(assumptions, part("assumptions", facts));
    report.update({{"summary", part("summary", facts).front()}, {"details", part("details", facts)},
        {"measureNext", part("measureNext", facts)}, {"assumptions", assumptions}});
}

} // namespace clepsydra::identification
