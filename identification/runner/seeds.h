#pragma once

#include <string>

namespace clepsydra::identification
{

/// Seed of a run, a hash of the arguments: a prime from 11003 on; LIGGGHTS requires one above 10000.
long seedOf(unsigned studySeed, const std::string& purpose, const std::string& condition, int number);

} // namespace clepsydra::identification
