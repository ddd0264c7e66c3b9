#include "tokens/nearestWord.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace clepsydra
{

namespace
{

std::string smallLetters(std::string word)
{
    std::transform(word.begin(), word.end(), word.begin(),
        [](char letter) { return static_cast<char>(std::tolower(static_cast<unsigned char>(letter))); });
    return word;
}

/// Number of letters to change, insert, delete or swap with their neighbour (optimal string alignment distance).
std::size_t editDistance(const std::string& from, const std::string& to)
{
    std::vector<std::size_t> beforeLast(to.size() + 1);
    std::vector<std::size_t> last(to.size() + 1);
    std::vector<std::size_t> row(to.size() + 1);
    std::iota(last.begin(), last.end(), 0);
    for (std::size_t i = 1; i <= from.size(); ++i)
    {
        row[0] = i;
        for (std::size_t j = 1; j <= to.size(); ++j)
        {
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1])
            {
                row[j] = std::min(row[j], beforeLast[j - 2] + 1);
            }
        }
        beforeLast.swap(last);
        last.swap(row);
    }
    return last[to.size()];
}

} // namespace

std::string nearestWord(const std::string& word, const std::vector<std::string>& known)
{
    // Longer words are not misspellings of an entry, and comparing them takes time.
    constexpr std::size_t longest = 60;
    std::string nearest;
    if (word.size() > longest)
    {
        return nearest;
    }
    std::size_t smallest = word.size() + 1;
    for (const std::string& candidate : known)
    {
        const std::size_t distance = editDistance(smallLetters(word), smallLetters(candidate));
        if (3 * distance <= std::max(word.size(), candidate.size()) && distance < smallest)
        {
            smallest = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

} // namespace clepsydra
