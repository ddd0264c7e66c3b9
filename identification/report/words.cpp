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

/// All that explain it, one after the other.
std::string setInWords(const Study& study, const Answer& answer)
{
    std::string text = answer.set.size() == 1 ? " This explains it, but it need not be the cause: "
                                              : " These explain it, and the data cannot tell them apart: ";
    for (std::size_t i = 0; i < answer.set.size(); ++i)
    {
        text += (i == 0 ? "" : "; or ") + nameOf(study, answer.set[i]);
    }
    if (!answer.pairsAlike.empty())
    {
        text += "; or one of " + std::to_string(answer.pairsAlike.size())
                + " other pairs that were not simulated, for instance " + nameOf(study, answer.pairsAlike.front());
    }
    if (!answer.somethingElseBecause.empty())
    {
        text += "; or something that is not in the library (" + joined(answer.somethingElseBecause) + ')';
    }
    return text + '.';
}

/// What comes nearest, for people to see; it is no answer.
std::string nearestInWords(const Study& study, const Answer& answer, const HeldOutResult& heldOut)
{
    const Explanation& nearest = *answer.bestOfUnknown;
    return " The nearest, which "
           + (nearest.misfit > nearest.misfitLimit
                   ? "still misfits (" + textOf(nearest.misfit) + ", limit " + textOf(nearest.misfitLimit) + ')'
                   : std::string("is less likely than something else"))
           + ", is " + nameOf(study, nearest) + "; with it the error on the held-out conditions goes from "
           + withError(heldOut.before.rmsLogError) + " to " + withError(heldOut.bestOfUnknown->rmsLogError) + '.';
}

std::string heldOutInWords(const HeldOutResult& heldOut)
{
    return " On the held-out conditions the error went from " + withError(heldOut.before.rmsLogError) + " to "
           + withError(heldOut.after->rmsLogError)
           + (heldOut.accepted() ? ": the effect may enter the model."
                                 : ": it does not enter the model, for " + joined(heldOut.notAcceptedBecause) + '.');
}

} // namespace

std::string inWords(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    const HeldOutResult* heldOut = findings.heldOut;
    const std::string pValue = " beyond noise (p = " + textOf(answer.significance.pValue) + ')';
    if (answer.decision == Decision::noResidual)
    {
        return "No residual" + pValue
               + ". This does not show that nothing is missing: see the smallest detectable amplitudes.";
    }
    std::string text = "There is a residual" + pValue;
    if (answer.decision == Decision::unknown)
    {
        text += ", and none of the effects in the library explains it: unknown.";
        return heldOut != nullptr && heldOut->bestOfUnknown ? text + nearestInWords(study, answer, *heldOut) : text;
    }
    text += '.';
    text += answer.decision == Decision::named
                ? " One effect of the library is left: " + nameOf(study, answer.set.front()) + '.'
                : setInWords(study, answer);
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
    all.emplace_back(
        answer.noise.pooled
            ? "Measurements scatter as simulations do: their repeats alone are too few, so both are pooled."
            : "The scatter of measurements is that of their own repeats.");
    all.emplace_back("The scatter of a feature is the same in all conditions and close to normal.");
    if (answer.noise.data.shrinkage > 0.0)
    {
        all.push_back("There are fewer than three repeats per feature: correlations between features were shrunk by "
                      + textOf(std::round(100.0 * answer.noise.data.shrinkage)) + " %.");
    }
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
