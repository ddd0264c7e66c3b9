#pragma once

#include <string>

namespace clepsydra::identification
{

/// Seed of a run, a hash of the arguments: a prime above 10000, as LIGGGHTS requires.
long seedOf(unsigned studySeed, const std::string& purpose, const std::string& condition, int number);

} // namespace clepsydra::identification
