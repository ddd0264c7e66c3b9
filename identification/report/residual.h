#pragma once

#include "heldOut/scores.h"
#include "report/findings.h"

#include <cstddef>
#include <vector>

namespace clepsydra::identification
{

/// What was measured minus what the model gives without any effect, its parameters fitted.
struct Residual
{
    std::size_t condition; // of the study
    std::size_t feature;
    Estimate estimate;
};

std::vector<Residual> residualsOf(const Findings& findings);

} // namespace clepsydra::identification
