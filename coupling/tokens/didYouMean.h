#pragma once

#include <string>
#include <vector>

namespace clepsydra
{

/// Ending of an error message: " (did you mean 'divided'?)" for a word that nearly equals a known one; the new name
/// where the word is the name of a known one in an earlier version; otherwise an empty string.
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);

/// A list as error messages write it: "a, b or c". \param last  between the last two words
std::string listed(const std::vector<std::string>& words, const std::string& last = " or ");

/// The keys of a map, or the first element of each pair.
template<class Pairs>
std::vector<std::string> namesOf(const Pairs& pairs)
{
    std::vector<std::string> names;
    names.reserve(pairs.size());
    for (const auto& [name, other] : pairs)
    {
        names.push_back(name);
    }
    return names;
}

} // namespace clepsydra
