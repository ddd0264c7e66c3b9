#pragma once

#include "procedure/answer.h"

namespace clepsydra::identification
{

/// What the explanations amount to.
struct Verdict
{
    Decision decision = Decision::unknown;
    std::vector<Explanation> set;             // best first; empty where unknown
    std::optional<Explanation> bestOfUnknown; // the most likely one where none is enough
};

/// `unknown` where the best explanation still misfits, or something else is more likely; otherwise those within
/// `setWidth` of the best that do not misfit: a name where that is one, and nothing speaks for others.
/// \param explanations  most likely first; at least one
/// \param otherLogOdds  of something that is not in the library
/// \param others  whether something outside the library, or a pair that was not simulated, may be behind the best one
Verdict decide(const std::vector<Explanation>& explanations, double otherLogOdds, bool others, double setWidth);

} // namespace clepsydra::identification
