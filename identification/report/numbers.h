#pragma once

#include "heldOut/scores.h"

#include <string>

namespace clepsydra::identification
{

/// Numbers as people read them: two digits are enough for an error and a probability.
std::string rounded(double value, int digits = 2);

/// A share in percent, "<1 %" and ">99 %" at the ends that chance alone does not reach.
std::string percent(double share);

/// "0.173 +- 0.012": as many digits as the error allows.
std::string withError(const Estimate& estimate);

} // namespace clepsydra::identification
