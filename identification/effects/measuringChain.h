#pragma once

#include "curves/curve.h"

#include <map>
#include <string>

namespace clepsydra::identification
{

/// A change of the curve by the measuring chain, from the apparatus to the file.
struct ChainOperation
{
    std::string unit; // of `size`; empty if it is dimensionless or has the unit of the curve
    Curve (*apply)(Curve curve, double size);
};

/// All operations by name; docs/reference/study.md says what each does.
const std::map<std::string, ChainOperation>& chainOperations();

} // namespace clepsydra::identification
