#pragma once

#include <string>
#include <vector>

namespace clepsydra
{

/// The word that `word` may be a misspelling of: at most a third of its letters are wrong, missing, too many or
/// swapped with their neighbour; capitals do not count. Empty where no known word is as near as that.
std::string nearestWord(const std::string& word, const std::vector<std::string>& known);

} // namespace clepsydra
