#include "report/sentences.h"

#include "lists.h"
#include "report/fitted.h"
#include "report/numbers.h"
#include "report/residual.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace clepsydra::identification
{

namespace
{

constexpr const char* unlistedCause = "a cause that the library does not list";
constexpr const char* unseen = "the error on held-out measurements";

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

/// Meaning of an explanation as the library states it, with its fitted size.
std::string meaningOf(const Findings& findings, const Explanation& explanation)
{
    const auto meanings = mapped(explanation.effects, [&](std::size_t e) {
        const Effect& effect = findings.study->effects[e];
        std::string own = effect.meaning.empty() ? effect.name : effect.meaning;
        return own.erase(own.find_last_not_of(" \n.") + 1);
    });
    const std::string meaning = joined(meanings, ", together with ");
    const std::string size = describeSize(findings, explanation);
    return size.empty() ? meaning : size.rfind(meaning + ' ', 0) == 0 ? size : meaning + " (" + size + ')';
}

std::vector<std::string> membersOf(const Findings& findings)
{
    return mapped(findings.answer->set, [&](const Explanation& each) { return meaningOf(findings, each); });
}

/// Differences of logarithms are relative, and are given in percent.
struct Scale
{
    explicit Scale(bool isLog)
        : factor(isLog ? 100.0 : 1.0),
          unit(isLog ? " %" : "")
    {}

    std::string operator()(double value) const
    {
        return rounded(factor * value) + unit;
    }
    std::string operator()(const Estimate& estimate) const
    {
        return withError({factor * estimate.value, factor * estimate.standardError}) + unit;
    }

    double factor;
    std::string unit;
};

Scale scaleOf(const Study& study)
{
    return Scale(std::any_of(
        study.features.begin(), study.features.end(), [](const Feature& feature) { return feature.kind->isLog(); }));
}

std::string errorOf(const Study& study, const HeldOutScore& score)
{
    return scaleOf(study)(score.rmsLogError);
}

/// "falls from 35 to 2.1 %"
std::string changeOf(const Study& study, const HeldOutResult& heldOut)
{
    const Scale scale = scaleOf(study);
    const double sure = 2.0 * heldOut.improvement.standardError;
    return std::string(heldOut.improvement.value > sure    ? "falls from "
                       : heldOut.improvement.value < -sure ? "rises from "
                                                           : "stays about the same: ")
           + rounded(scale.factor * heldOut.before.rmsLogError.value) + " to "
           + scale(heldOut.after->rmsLogError.value);
}

bool isHeldOut(const HeldOutResult* heldOut)
{
    return heldOut != nullptr && !heldOut->conditions.empty();
}

/// Error on the held-out conditions without an effect.
std::string errorWithout(const Findings& findings)
{
    return isHeldOut(findings.heldOut)
               ? std::string("; ") + unseen + " is " + errorOf(*findings.study, findings.heldOut->before)
               : "";
}

std::string errorWith(const Findings& findings)
{
    return isHeldOut(findings.heldOut) && findings.heldOut->after
               ? std::string("; with it ") + unseen + ' ' + changeOf(*findings.study, *findings.heldOut)
               : "";
}

const Condition* bestCandidate(const Findings& findings)
{
    return findings.next == nullptr || findings.next->empty()
               ? nullptr
               : &findings.study->conditions[findings.next->front().condition];
}

/// "; to distinguish them, measure wetWide"
std::string howToDistinguish(const Findings& findings)
{
    if (const Condition* candidate = bestCandidate(findings))
    {
        return "; to distinguish them, measure " + candidate->name;
    }
    for (const auto& explanation : findings.answer->set)
    {
        const Effect& effect = findings.study->effects[explanation.effects.front()];
        if (!effect.hint.empty())
        {
            return "; to distinguish them: " + effect.hint;
        }
    }
    return "; these measurements cannot distinguish them";
}

/// "its independent measurement", which only a measured prior is called
std::string nameOfPrior(Origin from)
{
    return from == Origin::measured   ? "the independent measurement"
           : from == Origin::handbook ? "the handbook's value"
                                      : "the guess";
}

/// Parameters that the null fit moves far from their priors: "friction 5.9 standard deviations from the guess".
std::vector<std::string> strainedParameters(const Findings& findings)
{
    constexpr double far = 3.0; // standard deviations
    const Study& study = *findings.study;
    std::vector<std::string> names;
    for (std::size_t p = 0; p < study.parameters.size(); ++p)
    {
        const Parameter& parameter = study.parameters[p];
        const double value = findings.answer->null.setting.parameters(p);
        const double sds = std::abs(value - parameter.mean) / parameter.sd;
        if (sds > far)
        {
            names.push_back(
                parameter.name + ' ' + rounded(sds) + " standard deviations from " + nameOfPrior(parameter.from));
        }
    }
    return names;
}

std::string chanceSentence(const Answer& answer)
{
    return "Noise alone gives a residual as large as this in " + percent(answer.pValue) + " of such data ("
           + pValueText(answer.pValue) + ").";
}

std::string probabilitySentence(const Findings& findings)
{
    const Answer& answer = *findings.answer;
    auto shares = mapped(answer.set,
        [&](const Explanation& each) { return meaningOf(findings, each) + ' ' + percent(each.probability); });
    shares.push_back(std::string(unlistedCause) + ' ' + percent(answer.otherProbability));
    return "The probabilities are: " + joined(shares, ", ") + '.';
}

/// How the best explanation predicts the held-out conditions, beside the two words of the decision.
std::vector<std::string> judgementsOf(const HeldOutResult& heldOut, double level)
{
    const auto against = [&](const LogRatio& ratio, const std::string& other) {
        return std::string(ratio.isBeyondChance(level) ? "better than " : "not significantly better than ") + other
               + " (log ratio " + rounded(ratio.value) + ", p = " + rounded(ratio.pValue, 1) + ')';
    };
    std::vector<std::string> compared = {
        against(heldOut.after->overNull, "no effect"), against(heldOut.overOneMore, "one more free parameter")};
    if (heldOut.gaussianProcess)
    {
        compared.push_back(against(heldOut.overGaussianProcess, "a Gaussian process on the residual"));
    }
    return {"The prediction with the most likely effect is " + joined(compared, ", and ") + '.',
        heldOut.better ? "Better: the effect may enter the model."
                       : "It does not enter the model: " + joined(heldOut.notBetterBecause, ", and ") + '.',
        heldOut.complete ? "Complete: no more than noise is left."
                         : "Not complete: what is left is more than noise (p = " + rounded(heldOut.after->pValue, 1)
                               + "), or was not predicted."};
}

std::string heldOutSentence(const Findings& findings)
{
    const Study& study = *findings.study;
    const HeldOutResult& heldOut = *findings.heldOut;
    std::string text =
        "On the held-out conditions the error is " + errorOf(study, heldOut.before) + " without an effect, ";
    if (heldOut.after)
    {
        text += errorOf(study, *heldOut.after) + " with the most likely effect, ";
    }
    return text + "and " + errorOf(study, heldOut.oneMoreParameter)
           + " with one more free parameter instead; noise alone gives " + scaleOf(study)(heldOut.noiseFloor) + '.';
}

/// "condition wet, feature 'late': measured minus simulated is 12 ± 2 %", of the most significant residual
std::string largestOf(const Study& study, const std::vector<Residual>& residuals)
{
    const auto inErrors = [](const Residual& one) { return std::abs(one.estimate.value) / one.estimate.standardError; };
    const auto largest = std::max_element(residuals.begin(), residuals.end(),
        [&](const Residual& a, const Residual& b) { return inErrors(a) < inErrors(b); });
    const Feature& feature = study.features[largest->feature];
    return "condition " + study.conditions[largest->condition].name + ", feature '" + feature.name
           + "': measured minus simulated is " + Scale(feature.kind->isLog())(largest->estimate);
}

/// How much the nearest effect takes of a residual that none explains, and what is left.
std::string nearestSentence(const Findings& findings, const Explanation& nearest)
{
    const Answer& answer = *findings.answer;
    return "Nearest is " + meaningOf(findings, nearest) + ": it takes " + percent(shareTaken(answer, nearest))
           + " of the residual (chi-square " + rounded(answer.null.chiSquare, 3) + " without, "
           + rounded(nearest.chiSquare, 3) + " with it, in " + std::to_string(answer.measured.mean.size())
           + " numbers). Most of what is left is in "
           + largestOf(*findings.study, residualsOf(findings, nearest.setting)) + '.';
}

std::string capitalised(std::string text)
{
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return text;
}

/// "friction and viscosity"
std::string parametersOf(const Study& study)
{
    return joined(mapped(study.parameters, [](const Parameter& one) { return one.name; }), " and ");
}

std::string inErrors(const std::vector<Residual>& residuals)
{
    return rounded(rmsInErrors(residuals));
}

/// The condition whose residual the explanation reduces most, in units of the standard errors.
std::string decidingSentence(const Findings& findings, const Explanation& best)
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
    if (decides == byCondition.end() || byCondition.size() < 2)
    {
        return "";
    }
    const auto& [before, after] = decides->second;
    return "Condition " + study.conditions[decides->first].name + " decides most: there, " + nameOf(study, best.effects)
           + " takes the residual from " + inErrors(before) + " to " + inErrors(after)
           + " standard errors (root mean square).";
}

/// What the fit of the parameters alone does to the residual.
std::string parametersSentence(const Findings& findings, const Explanation* best)
{
    const Study& study = *findings.study;
    Setting prior = findings.answer->null.setting;
    for (std::size_t p = 0; p < study.parameters.size(); ++p)
    {
        prior.parameters(p) = study.parameters[p].mean;
    }
    return capitalised(parametersOf(study)) + " alone can take the residual from "
           + inErrors(residualsOf(findings, prior)) + " to "
           + inErrors(residualsOf(findings, findings.answer->null.setting)) + " standard errors (root mean square)"
           + (best == nullptr ? ""
                              : "; with " + nameOf(study, best->effects) + " it is "
                                    + inErrors(residualsOf(findings, best->setting)))
           + '.';
}

/// A measured size outside of the fitted interval would refute an effect.
std::string refutingSentence(const Findings& findings, const Explanation& best)
{
    const Study& study = *findings.study;
    const std::size_t e = best.effects.front();
    const Effect& effect = study.effects[e];
    const Fit& fit = best.fits.front();
    std::string text = nameOf(study, best.effects) + " is refuted ";
    if (effect.isSwitch || best.effects.size() > 1)
    {
        return effect.hint.empty() ? "" : capitalised(text) + "if a direct test does not show it: " + effect.hint + '.';
    }
    const auto at = [&](double amplitude) {
        Explanation end = best;
        end.setting.amplitudes(e) = amplitude;
        return describeSize(findings, end);
    };
    return capitalised(text) + "if a direct measurement does not lie between " + at(fit.lower) + " and " + at(fit.upper)
           + " (95 %)" + (effect.hint.empty() ? "" : ": " + effect.hint) + '.';
}

/// Which condition decided, what the parameters alone could do, and what would refute the answer.
std::vector<std::string> reasonsOf(const Findings& findings)
{
    const Answer& answer = *findings.answer;
    const Explanation* best = bestOf(answer);
    std::vector<std::string> all;
    if (answer.nearest)
    {
        all.push_back(nearestSentence(findings, *answer.nearest));
    }
    if (best != nullptr)
    {
        all.push_back(decidingSentence(findings, *best));
    }
    if (!findings.study->parameters.empty())
    {
        all.push_back(parametersSentence(findings, best));
    }
    if (!answer.set.empty())
    {
        all.push_back(refutingSentence(findings, *best));
    }
    all.erase(std::remove(all.begin(), all.end(), ""), all.end());
    return all;
}

/// Why no name is given, and why probable effects are not in the set.
std::vector<std::string> doubtsOf(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    std::vector<std::string> all;
    if (answer.decision == Decision::set && answer.oddsOfName)
    {
        const auto [odds, needed] = *answer.oddsOfName;
        all.push_back("No name is given: the log odds of " + nameOf(study, answer.set.front().effects)
                      + " against all other causes are " + rounded(odds)
                      + (std::isfinite(needed) ? ", and a name needs " + rounded(needed)
                                               : ", and decoys look like it at any odds")
                      + '.');
    }
    for (std::size_t e = 0; e < answer.effects.size(); ++e)
    {
        const EffectFinding& finding = answer.effects[e];
        if (!finding.notInSetBecause.empty())
        {
            all.push_back(capitalised(study.effects[e].name) + " is no candidate in spite of its probability, "
                          + percent(finding.probability) + ": " + finding.notInSetBecause + '.');
        }
        if (finding.inSet && !study.effects[e].isSwitch && finding.fit.lower < 0.0 && finding.fit.upper > 0.0)
        {
            all.push_back("The 95 % interval of the size of " + study.effects[e].name + " contains 0.");
        }
        if (const auto agrees = agreesWithMeasurement(study.effects[e], finding); finding.inSet && agrees)
        {
            const auto& measured = *study.effects[e].measured;
            all.push_back("Without its independent measurement, " + withError({measured.mean, measured.sd})
                          + ", the size of " + study.effects[e].name + " would be "
                          + withError({finding.alone->amplitude, finding.alone->sd}) + ": the two "
                          + (*agrees ? "agree" : "disagree") + " (within two standard deviations).");
        }
    }
    return all;
}

std::string namedSentence(const Findings& findings)
{
    const std::string name =
        joined(membersOf(findings), ", or ") + (findings.answer->family.empty() ? "" : ", variants of one effect");
    const std::string tried = std::to_string(findings.study->effects.size());
    const std::string grade = gradeOf(findings);
    const std::string predicts = ", which predicts what no fit used";
    return (grade == "measured" ? "The residual is explained by: " + name + predicts
                                      + ", and whose size agrees with an independent measurement"
               : grade == "better"
                   ? "The residual is explained by: " + name + ", or something that acts like it" + predicts
                   : "Of the " + tried + " effects tried only this one fits: " + name
                         + "; an untried effect may act alike here")
           + errorWith(findings) + '.';
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
    const Answer& answer = *findings.answer;
    switch (answer.decision)
    {
        case Decision::noResidual:
            return (strainedParameters(findings).empty()
                           ? "The model agrees with these measurements within their noise"
                           : "The model fits, but only with " + joined(strainedParameters(findings), " and ")
                                 + ": either that value is wrong, or the fit compensates for a missing effect")
                   + errorWithout(findings) + '.';
        case Decision::unknown:
            return "The residual has " + std::string(unlistedCause) + ": none of its "
                   + std::to_string(findings.study->effects.size()) + " effects explains the measurements"
                   + errorWithout(findings) + '.';
        case Decision::named:
            return namedSentence(findings);
        case Decision::set:
            break;
    }
    std::vector<std::string> members = membersOf(findings);
    if (members.size() == 1)
    {
        return "The residual has one of these causes: " + members.front() + ", or " + unlistedCause
               + errorWith(findings) + '.';
    }
    if (answer.unlistedCauseInSet)
    {
        members.emplace_back(unlistedCause);
    }
    return "The residual has one of these causes: " + joined(members, ", or ") + howToDistinguish(findings) + '.';
}

std::vector<std::string> detailsOf(const Findings& findings)
{
    const Answer& answer = *findings.answer;
    const HeldOutResult* heldOut = findings.heldOut;
    std::vector<std::string> all = reasonsOf(findings);
    all.push_back(chanceSentence(answer));
    for (const auto& value : valuesAtEnds(findings))
    {
        all.push_back(capitalised(value) + '.');
    }
    if (answer.decision != Decision::noResidual && !strainedParameters(findings).empty())
    {
        all.push_back("Without an effect the fit moves " + joined(strainedParameters(findings), " and ") + '.');
    }
    if (answer.decision == Decision::noResidual)
    {
        all.emplace_back("This does not show that no effect is missing; report.html lists the size from which on each "
                         "effect would have been detected.");
    }
    else if (answer.decision != Decision::unknown)
    {
        // If no explanation fits, their relative probabilities mean nothing.
        all.push_back(probabilitySentence(findings));
        append(all, doubtsOf(findings));
    }
    if (!isHeldOut(heldOut))
    {
        all.emplace_back("No condition was held out, so the prediction has not been tested.");
        return all;
    }
    all.push_back(heldOutSentence(findings));
    if (heldOut->after)
    {
        append(all, judgementsOf(*heldOut, findings.study->settings.level));
    }
    if (!heldOut->notScored.empty())
    {
        all.push_back("Not compared: " + joined(heldOut->notScored, ", ") + '.');
    }
    return all;
}

std::vector<std::string> nextOf(const Findings& findings)
{
    const Study& study = *findings.study;
    std::vector<std::string> all;
    const Condition* candidate = bestCandidate(findings);
    if (candidate != nullptr && findings.next->front().outcomes.size() == 1)
    {
        const auto& outcome = findings.next->front().outcomes.front();
        const auto numbers = mapped(
            numbersWhere(study.features.size(), [&](std::size_t f) { return std::isfinite(outcome.features(f)); }),
            [&](std::size_t f) {
                const bool isLog = study.features[f].kind->isLog();
                const double value = isLog ? std::exp(outcome.features(f)) : outcome.features(f);
                return '\'' + study.features[f].name + "' " + withError({value, (isLog ? value : 1.0) * outcome.sd(f)});
            });
        all.push_back("A measurement of " + candidate->name + " would test " + outcome.name + ", which predicts "
                      + joined(numbers, " and ") + " there (SI units).");
    }
    else if (candidate != nullptr)
    {
        const auto& outcomes = findings.next->front().outcomes;
        // The feature in which the two most likely explanations differ most.
        Eigen::Index best = 0;
        const Eigen::ArrayXd apart = (outcomes[0].features - outcomes[1].features).array()
                                     / (outcomes[0].sd.array().square() + outcomes[1].sd.array().square()).sqrt();
        apart.isFinite().select(apart.abs(), 0.0).maxCoeff(&best);
        const Feature& feature = study.features[best];
        const double difference = outcomes[0].features(best) - outcomes[1].features(best);
        const Scale scale(feature.kind->isLog());
        all.push_back("Measure " + candidate->name + ": there, '" + feature.name + "' is " + scale(std::abs(difference))
                      + (difference > 0.0 ? " larger" : " smaller") + " with " + outcomes[0].name + " than with "
                      + outcomes[1].name + "; one measurement has a standard error of "
                      + scale(std::max(outcomes[0].sd(best), outcomes[1].sd(best))) + '.');
    }
    if (findings.answer->decision == Decision::unknown)
    {
        all.push_back("The residual is most significant in "
                      + largestOf(study, residualsOf(findings, findings.answer->null.setting)) + '.');
    }
    for (const auto& explanation : findings.answer->set)
    {
        for (const auto e : explanation.effects)
        {
            if (!study.effects[e].hint.empty())
            {
                all.push_back(study.effects[e].name + " can be measured independently: " + study.effects[e].hint + '.');
            }
        }
    }
    return all;
}

std::vector<std::string> assumptionsOf(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    std::vector<std::string> all = study.assumptions;
    for (const auto& parameter : study.parameters)
    {
        all.push_back("Parameter " + parameter.name + " has one value in all conditions; "
                      + (parameter.from == Origin::measured    ? "an independent measurement gave "
                          : parameter.from == Origin::handbook ? "a handbook gives "
                                                               : "before the fit it was guessed to be ")
                      + textOf(parameter.mean) + " with a standard deviation of " + textOf(parameter.sd) + ".");
    }
    all.push_back("Only the " + std::to_string(study.effects.size())
                  + " effects of the study can be named, with amplitudes within their stated ranges; a priori, all "
                    "amplitudes within a range are equally likely, except for effects whose amplitude was measured.");
    all.emplace_back(
        answer.emulator->scatters()
            ? "Measurements scatter like simulations of the same setting, up to a common factor near 1, and their "
              "distribution is nearly normal."
            : "The scatter of the measurements is that of their repeats, or is declared in the study.");
    all.push_back(
        "The thresholds are derived from synthetic data that follow the emulator. They give a wrong name to at most "
        + textOf(100.0 * study.settings.wrongNames)
        + " % of the decoys, which are effects of the library, left out in turn, and patterns of any shape.");
    if (study.modelError.maxCoeff() > 0.0)
    {
        all.emplace_back("The model error (mesh, time steps) is as large as the study's modelError states.");
    }
    for (const auto& effect : study.leftOut)
    {
        all.push_back("This effect was left out and cannot be named: " + effect + ".");
    }
    if (study.simulator.seedEntry.empty())
    {
        all.emplace_back("Repeated runs of the simulator do not differ.");
    }
    return all;
}

} // namespace clepsydra::identification
