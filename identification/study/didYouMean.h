#pragma once

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Words as they are listed in an error: "a, b or c".
std::string listed(const std::vector<std::string>& words);

/// "; did you mean 'amplitude'?" for a word that is nearly one of those, else nothing. For the end of an error.
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);

} // namespace clepsydra::identification
