#pragma once

#include "heldOut/scores.h"
#include "report/findings.h"

#include <optional>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// A quantity fitted to the measurements, in the units of the user's case.
struct FittedNumber
{
    std::string name;                    // of a parameter, an entry of the case, or an operation of the measuring chain
    std::string unit;                    // empty if it is not known
    std::optional<Estimate> independent; // independent measurement: the prior of a parameter
    Estimate before;                     // without an effect
    std::optional<Estimate> after;       // with the best explanation
};

/// The parameters, the entries that follow from them by a formula, and the entries that the best explanation sets in
/// the first condition in which it acts.
std::vector<FittedNumber> fittedNumbers(const Findings& findings);

/// Size of a fitted effect as text: "particleDiameter 3 % larger"; empty for a switch.
std::string describeSize(const Findings& findings, const Explanation& explanation);

} // namespace clepsydra::identification
