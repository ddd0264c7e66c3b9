#include "tokens/didYouMean.h"

#include "tokens/nearestWord.h"
#include "tokens/renamed.h"

#include <algorithm>

namespace clepsydra
{

std::string didYouMean(const std::string& word, const std::vector<std::string>& known)
{
    if (const Renamed* const change = renamed(word);
        change != nullptr && std::find(known.begin(), known.end(), change->newName) != known.end())
    {
        return " (it is now called '" + change->newName + "'"
               + (change->conversion.empty() ? ")" : ". " + change->conversion + ")");
    }
    const std::string nearest = nearestWord(word, known);
    return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

std::string listed(const std::vector<std::string>& words, const std::string& last)
{
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        text += (i == 0 ? "" : i + 1 == words.size() ? last : ", ") + words[i];
    }
    return text;
}

} // namespace clepsydra
