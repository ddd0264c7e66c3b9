#pragma once

#include "heldOut/scores.h"

#include <string>

namespace clepsydra::identification
{

/// A number with a few significant digits.
std::string rounded(double value, int digits = 2);

/// A share in percent; "<1 %" and ">99 %" at the ends of the scale.
std::string percent(double share);

/// A p-value: "p = 0.03"; "p below 1e-6" where no test of the program can tell smaller ones apart.
std::string pValueText(double pValue);

/// A value with its standard error, with as many digits as the error allows: "0.173 ± 0.012".
std::string withError(const Estimate& estimate);

} // namespace clepsydra::identification
