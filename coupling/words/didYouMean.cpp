#include "words/didYouMean.h"

#include "words/nearestWord.h"

namespace clepsydra
{

std::string didYouMean(const std::string& word, const std::vector<std::string>& known)
{
    const std::string nearest = nearestWord(word, known);
    return nearest.empty() ? "" : " (did you mean '" + nearest + "'?)";
}

std::string listed(const std::vector<std::string>& words)
{
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    }
    return text;
}

} // namespace clepsydra
