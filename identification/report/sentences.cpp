#include "report/sentences.h"

#include "lists.h"
#include "report/fitted.h"
#include "report/numbers.h"
#include "report/residual.h"

#include <algorithm>
#include <cmath>

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

/// Parameters that the null fit moves far from their independent measurements: "friction 5.9 standard deviations".
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
            names.push_back(parameter.name + ' ' + rounded(sds) + " standard deviations");
        }
    }
    return names;
}

std::string chanceSentence(const Answer& answer)
{
    return "Noise alone gives a residual as large as this in " + percent(answer.pValue)
           + " of such data (p = " + rounded(answer.pValue, answer.pValue < 0.1 ? 1 : 2) + ").";
}

std::string probabilitySentence(const Findings& findings)
{
    const Answer& answer = *findings.answer;
    auto shares = mapped(answer.set,
        [&](const Explanation& each) { return meaningOf(findings, each) + ' ' + percent(each.probability); });
    shares.push_back(std::string(unlistedCause) + ' ' + percent(answer.otherBesideSet));
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

std::string namedSentence(const Findings& findings)
{
    const std::string name =
        joined(membersOf(findings), ", or ") + (findings.answer->family.empty() ? "" : ", variants of one effect");
    const std::string tried = std::to_string(findings.study->effects.size());
    return (gradeOf(findings) == "better" ? "The residual is explained by: " + name
                                                + ", or something that acts like it, which predicts what no fit used"
                                          : "Of the " + tried + " effects tried only this one fits: " + name
                                                + "; an untried effect may act alike here")
           + errorWith(findings) + '.';
}

} // namespace

std::string gradeOf(const Findings& findings)
{
    return findings.answer->decision != Decision::named              ? ""
           : findings.heldOut != nullptr && findings.heldOut->better ? "better"
                                                                     : "named";
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
                                 + " from the independent measurement: either that measurement is wrong, or the fit "
                                   "compensates for a missing effect")
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
    std::vector<std::string> all = {chanceSentence(answer)};
    if (answer.decision != Decision::noResidual && !strainedParameters(findings).empty())
    {
        all.push_back("Without an effect the fit moves " + joined(strainedParameters(findings), " and ")
                      + " from the independent measurement.");
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
    if (const Condition* candidate = bestCandidate(findings))
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
        const auto residuals = residualsOf(findings);
        const auto largest =
            std::max_element(residuals.begin(), residuals.end(), [](const Residual& a, const Residual& b) {
                return std::abs(a.estimate.value) / a.estimate.standardError
                       < std::abs(b.estimate.value) / b.estimate.standardError;
            });
        const Feature& feature = study.features[largest->feature];
        all.push_back("The residual is most significant in condition " + study.conditions[largest->condition].name
                      + ", feature '" + feature.name + "': measured minus simulated is "
                      + Scale(feature.kind->isLog())(largest->estimate) + '.');
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
        all.push_back("Parameter " + parameter.name
                      + " has one value in all conditions; an independent measurement gave " + textOf(parameter.mean)
                      + " with a standard deviation of " + textOf(parameter.sd) + ".");
    }
    all.push_back("Only the " + std::to_string(study.effects.size())
                  + " effects of the study can be named, with amplitudes within their stated ranges; a priori, all "
                    "amplitudes within a range are equally likely.");
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
