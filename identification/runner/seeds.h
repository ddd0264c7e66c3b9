#pragma once

#include <string>

namespace clepsydra::identification
{

/// Seed of a run: always the same for the same words, else another. A prime above 10000, as LIGGGHTS asks for.
long seedOf(unsigned studySeed, const std::string& purpose, const std::string& condition, int number);

} // namespace clepsydra::identification
