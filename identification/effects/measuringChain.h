#pragma once

#include "curves/curve.h"

#include <map>
#include <string>

namespace clepsydra::identification
{

/// What the way from the apparatus to the file may do to a curve.
struct ChainOperation
{
    std::string unit; // of its size; empty: a share, or the curve's own
    Curve (*apply)(Curve curve, double size);
};

/// By name:
///   lag         first-order filter of `size` seconds
///   lead        value + size dv/dt: momentum of particles that leave, size = their speed over g [s]
///   shift       the record begins `size` seconds late
///   gain        value times 1 + size
///   offset      value plus size, SI units
///   drift       value plus size per second, from the record's first time on
///   timeFactor  times multiplied by 1 + size
const std::map<std::string, ChainOperation>& chainOperations();

} // namespace clepsydra::identification
