#pragma once

#include "heldOut/scores.h"
#include "report/findings.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// A quantity fitted to the measurements, in the units of the user's case.
struct FittedNumber
{
    std::string name;              // of a parameter, an entry of the case, or an operation of the measuring chain
    std::string unit;              // empty if it is not known
    std::optional<Estimate> prior; // of a parameter
    std::string from;              // origin of the prior: measured, handbook or guess
    Estimate before;               // without an effect
    std::optional<Estimate> after; // with the best explanation
};

/// The parameters, the entries that follow from them by a formula, and the entries that the best explanation sets in
/// the first condition in which it acts.
std::vector<FittedNumber> fittedNumbers(const Findings& findings);

/// Which end of its range a fitted value has reached: "lower", "upper", or empty.
/// \param error  standard error; a value that is bounded by the range lies about one of it away from the end
std::string endOfRange(double value, double error, const Bounds& range);

/// Values at the ends of their ranges, in words: parameters without an effect, and what the explanations in the set fit.
std::vector<std::string> valuesAtEnds(const Findings& findings);

/// Size of a fitted effect as text: "particleDiameter 3 % larger"; empty for a switch.
std::string describeSize(const Findings& findings, const Explanation& explanation);

/// Measured feature minus that of a setting.
struct Residual
{
    std::size_t condition; // of the study
    std::size_t feature;
    Estimate estimate;
    Estimate measured;
    Estimate predicted;
};

/// Residuals of all training conditions at a setting, according to the emulator.
std::vector<Residual> residualsOf(const Findings& findings, const Setting& setting);

/// Root mean square of residuals in units of their standard errors.
double rmsInErrors(const std::vector<Residual>& residuals);

} // namespace clepsydra::identification
