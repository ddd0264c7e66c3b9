#pragma once

#include <string>
#include <vector>

namespace clepsydra
{

/// The known word that `word` may be a misspelling of. At most a third of its letters may be wrong, missing,
/// superfluous or swapped with their neighbour; upper and lower case are not distinguished. Empty where no known word
/// is that near.
std::string nearestWord(const std::string& word, const std::vector<std::string>& known);

} // namespace clepsydra
