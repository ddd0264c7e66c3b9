#pragma once

#include "heldOut/scores.h"
#include "report/findings.h"

#include <optional>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// A number that the measurements have fixed, in the units of the user's case.
struct FittedNumber
{
    std::string name; // of a parameter, of an entry of the case, of an operation of the measuring chain
    std::string unit; // where it is known
    std::optional<Estimate> independent; // a parameter's prior
    Estimate before;                     // without any effect
    std::optional<Estimate> after;       // with the best explanation
};

/// Parameters, what they set by a formula, and what the best explanation sets, in the first condition where it acts.
std::vector<FittedNumber> fittedNumbers(const Findings& findings);

/// How large the effect is that a fit has found, in a few words: "particleDiameter 3 % larger"; empty for a switch.
std::string sizeInWords(const Findings& findings, const Explanation& explanation);

} // namespace clepsydra::identification
