#include "report/words.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace clepsydra::identification
{

namespace
{

std::string withError(const Estimate& estimate)
{
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << 100.0 * estimate.value << " +- " << 100.0 * estimate.standardError
         << " %";
    return text.str();
}

/// "this, and that"
std::string joined(const std::vector<std::string>& clauses)
{
    std::string all;
    for (const auto& clause : clauses)
    {
        all += (all.empty() ? "" : ", and ") + clause;
    }
    return all;
}

/// What it does, in the library's own words.
std::string meaningOf(const Study& study, const Explanation& explanation)
{
    std::string text = nameOf(study, explanation);
    if (explanation.effects.size() == 1 && !study.effects[explanation.effects.front()].meaning.empty())
    {
        text += " (" + study.effects[explanation.effects.front()].meaning + ')';
    }
    return text;
}

/// All that explain it, one after the other.
std::string setInWords(const Study& study, const Answer& answer)
{
    std::string text = answer.set.size() == 1 ? " This explains it, but it need not be the cause: "
                                              : " These explain it, and the data cannot tell them apart: ";
    for (std::size_t i = 0; i < answer.set.size(); ++i)
    {
        text += (i == 0 ? "" : "; or ") + meaningOf(study, answer.set[i]);
    }
    return text + (answer.somethingElseInSet ? "; or something that is not in the library." : ".");
}

std::string heldOutInWords(const HeldOutResult& heldOut)
{
    return " On the held-out conditions the error went from " + withError(heldOut.before.rmsLogError) + " to "
           + withError(heldOut.after->rmsLogError)
           + (heldOut.accepted() ? ": the effect may enter the model."
                                 : ": it does not enter the model, for " + joined(heldOut.notAcceptedBecause) + '.');
}

} // namespace

std::string namedBy(const Study& study, const Answer& answer)
{
    return answer.family.empty() ? nameOf(study, answer.set.front()) : answer.family;
}

std::string inWords(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    const HeldOutResult* heldOut = findings.heldOut;
    const std::string pValue = " beyond noise (p = " + textOf(answer.pValue) + ')';
    if (answer.decision == Decision::noResidual)
    {
        return "No residual" + pValue
               + ". This does not show that nothing is missing: see the smallest detectable amplitudes.";
    }
    std::string text = "There is a residual" + pValue;
    if (answer.decision == Decision::unknown)
    {
        return text + ", and none of the effects in the library explains it: unknown.";
    }
    text += '.';
    text += answer.decision != Decision::named ? setInWords(study, answer)
            : answer.family.empty()
                ? " One effect of the library is left: " + meaningOf(study, answer.set.front()) + '.'
                : " One family of effects is left: " + answer.family + "; which of its variants stays open.";
    return heldOut != nullptr && heldOut->after ? text + heldOutInWords(*heldOut) : text;
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
                  + " effects of the study can be named, with amplitudes within their stated ranges; all amplitudes in "
                    "a range are "
                    "equally likely beforehand.");
    all.emplace_back(answer.emulator->scatters()
                         ? "Measurements scatter as simulations of the same setting do, up to a common factor near 1, and "
                           "close to normal."
                         : "The scatter of measurements is that of their own repeats, or what is declared.");
    all.push_back("Thresholds hold for data as the emulator draws them; wrong names are held below "
                  + textOf(100.0 * study.settings.wrongNames)
                  + " % for foils of two kinds: effects of the library left out in turn, and patterns of any shape.");
    if (study.modelError.maxCoeff() > 0.0)
    {
        all.emplace_back("The simulation's own error (mesh, steps) is as large as the study's modelError states.");
    }
    for (const auto& effect : study.leftOut)
    {
        all.push_back("Left out, and so never named: " + effect + ".");
    }
    if (study.rig.seedEntry.empty())
    {
        all.emplace_back("Runs of the simulator do not scatter.");
    }
    return all;
}

void writeSummary(const Findings& findings, std::ostream& out)
{
    out << '\n' << inWords(findings) << '\n';
    const HeldOutResult* heldOut = findings.heldOut;
    if (heldOut != nullptr && !heldOut->conditions.empty())
    {
        out << "held-out rms error: before " << withError(heldOut->before.rmsLogError);
        if (heldOut->after)
        {
            out << ", after " << withError(heldOut->after->rmsLogError);
        }
        out << ", one more parameter " << withError(heldOut->oneMoreParameter.rmsLogError) << ", Gaussian process "
            << withError(heldOut->gaussianProcess.rmsLogError) << '\n';
    }
    for (const auto& failure : findings.simulator->failures())
    {
        out << "run failed: " << failure.purpose << ", " << failure.condition << ", seed " << failure.seed
            << (failure.repeated ? " (repeated with another seed)" : " (excluded)") << '\n';
    }
}

} // namespace clepsydra::identification
