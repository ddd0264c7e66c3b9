#pragma once

#include "heldOut/predictive.h"
#include "report/report.h"

#include <cstddef>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// The quantities fitted to the measurements, in the units of the user's case: the parameters, the entries that follow
/// from them by a formula, and the entries or operations that the best explanation sets, in the first condition in which
/// it acts. They are `fitted` of report.json.
Json fittedNumbers(const Findings& findings);

/// Units in which the features were measured, and their sizes in SI units, by name of the feature: `units` of
/// report.json.
Json unitsOf(const Study& study);

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
