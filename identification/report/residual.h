#pragma once

#include "heldOut/scores.h"
#include "report/findings.h"

#include <cstddef>
#include <vector>

namespace clepsydra::identification
{

/// Measured feature minus that of the null fit.
struct Residual
{
    std::size_t condition; // of the study
    std::size_t feature;
    Estimate estimate;
};

std::vector<Residual> residualsOf(const Findings& findings);

} // namespace clepsydra::identification
