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

/// All operations by name:
///   lag         first-order filter with a time constant of `size` seconds
///   lead        adds size dv/dt: momentum of particles that leave, with size = their speed divided by g [s]
///   shift       the record begins `size` seconds late
///   gain        multiplies the value by 1 + size
///   offset      adds size to the value, SI units
///   drift       adds size per second since the record's first time
///   timeFactor  multiplies the times by 1 + size
const std::map<std::string, ChainOperation>& chainOperations();

} // namespace clepsydra::identification
