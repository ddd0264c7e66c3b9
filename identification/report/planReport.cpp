#include "report/planReport.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace clepsydra::identification
{

namespace
{

constexpr double apart = 2.0; // standard deviations below which two effects look alike

std::string percent(double share)
{
    std::ostringstream text;
    text << std::setprecision(2) << 100.0 * share << " %";
    return text.str();
}

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

std::string fixed(double value)
{
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << value;
    return std::isfinite(value) ? text.str() : "never";
}

} // namespace

void writePlan(const Study& study, const EffectLibrary& library, const Noise& noise, const Identifiability& table,
    std::ostream& out)
{
    out << "\nnoise of one run:";
    for (Eigen::Index f = 0; f < study.featureCount(); ++f)
    {
        out << ' ' << study.features[static_cast<std::size_t>(f)].name << ' '
            << textOf(std::round(1e4 * std::sqrt(noise.simulation.matrix(f, f))) / 1e4);
    }
    out << " (" << noise.simulation.nu << " degrees of freedom)\n"
        << "runs with the same seed go together by " << fixed(library.seedCorrelation) << " +- "
        << fixed(library.seedCorrelationError) << ": " << (library.commonSeeds ? "common" : "fresh")
        << " seeds in the design\n\n"
        << std::left << std::setw(24) << "effect" << std::right << std::setw(10) << "signal" << std::setw(12)
        << "hidden by" << std::setw(14) << "smallest\n"
        << std::left << std::setw(24) << "" << std::right << std::setw(10) << "[sd]" << std::setw(12) << "parameters"
        << std::setw(14) << "detectable\n";
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        const auto i = static_cast<Eigen::Index>(e);
        const double smallest = table.smallestDetectable(i);
        out << std::left << std::setw(24) << study.effects[e].name << std::right << std::setw(10)
            << fixed(table.signal(i)) << std::setw(12) << percent(table.masked(i)) << std::setw(13)
            << (smallest > 1.0 ? "not in range" : fixed(smallest)) << '\n';
    }
    out << "(signal: what the parameters cannot imitate, at amplitude 1; smallest detectable: amplitude seen in 80 % "
           "of "
           "the cases)\n\n";
    const auto pairs = lookAlikes(table, apart);
    out << (pairs.empty() ? "all effects that show can be told apart\n"
                          : "cannot be told apart by these conditions:\n");
    for (const auto& [i, j] : pairs)
    {
        out << "  " << study.effects[i].name << " and " << study.effects[j].name << '\n';
    }
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        if (table.smallestDetectable(static_cast<Eigen::Index>(e)) > 1.0 && !study.effects[e].hint.empty())
        {
            out << "  to be measured by itself: " << study.effects[e].name << ": " << study.effects[e].hint << '\n';
        }
    }
    out << "collinearity index of all together: " << fixed(table.collinearityOfAll) << std::endl;
}

std::string inWords(const Findings& findings)
{
    const Study& study = *findings.study;
    const Answer& answer = *findings.answer;
    std::ostringstream text;
    switch (answer.decision)
    {
        case Decision::noResidual:
            text << "No residual beyond noise (p = " << textOf(answer.significance.pValue)
                 << "). This does not show that nothing is missing: see the smallest detectable amplitudes.";
            return text.str();
        case Decision::unknown:
            text << "There is a residual beyond noise (p = " << textOf(answer.significance.pValue)
                 << "), and none of the effects in the library explains it: unknown.";
            if (findings.heldOut != nullptr && findings.heldOut->bestOfUnknown)
            {
                text << " The nearest, which still misfits (" << textOf(answer.bestOfUnknown->misfit) << ", limit "
                     << textOf(answer.bestOfUnknown->misfitLimit) << "), is " << nameOf(study, *answer.bestOfUnknown)
                     << "; with it the error on the held-out conditions goes from "
                     << withError(findings.heldOut->before.rmsLogError) << " to "
                     << withError(findings.heldOut->bestOfUnknown->rmsLogError) << '.';
            }
            return text.str();
        case Decision::named:
            text << "There is a residual beyond noise (p = " << textOf(answer.significance.pValue)
                 << "). One effect of the library is left: " << nameOf(study, answer.set.front()) << '.';
            break;
        case Decision::set:
            text << "There is a residual beyond noise (p = " << textOf(answer.significance.pValue) << "). "
                 << (answer.set.size() == 1 ? "This explains it, but it need not be the cause: "
                                            : "These explain it, and the data cannot tell them apart: ");
            for (std::size_t i = 0; i < answer.set.size(); ++i)
            {
                text << (i == 0 ? "" : "; or ") << nameOf(study, answer.set[i]);
            }
            if (!answer.pairsAlike.empty())
            {
                text << "; or one of " << answer.pairsAlike.size()
                     << " other pairs that were not simulated, for instance "
                     << nameOf(study, answer.pairsAlike.front());
            }
            if (!answer.somethingElseBecause.empty())
            {
                text << "; or something that is not in the library (" << joined(answer.somethingElseBecause) << ')';
            }
            text << '.';
            break;
    }
    if (findings.heldOut != nullptr && findings.heldOut->after)
    {
        text << " On the held-out conditions the error went from " << withError(findings.heldOut->before.rmsLogError)
             << " to " << withError(findings.heldOut->after->rmsLogError)
             << (findings.heldOut->accepted()
                        ? ": the effect may enter the model."
                        : ": it does not enter the model, for " + joined(findings.heldOut->notAcceptedBecause) + '.');
    }
    return text.str();
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
