#pragma once

#include <string>
#include <vector>

namespace clepsydra
{

/// " (did you mean 'divided'?)" for a word that is nearly one of those; the new name where one of those had the word for its
/// name in an earlier version; else nothing. For the end of an error.
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);

/// Words as an error lists them: "a, b or c".
std::string listed(const std::vector<std::string>& words);

/// The keys of a map, or the first of each pair.
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
