#pragma once

#include "heldOut/scores.h"
#include "report/findings.h"

#include <cstddef>
#include <vector>

namespace clepsydra::identification
{

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
