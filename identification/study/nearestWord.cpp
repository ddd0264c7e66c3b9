#include "study/nearestWord.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace clepsydra::identification
{

namespace
{

bool sameLetter(char a, char b)
{
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Letters to be put in, left out or changed to make one word of the other (Levenshtein).
std::size_t distance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            const std::size_t changed = diagonal + (sameLetter(a[i - 1], b[j - 1]) ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

} // namespace

std::string listed(const std::vector<std::string>& words)
{
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
    {
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    }
    return text;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& known)
{
    // Longer words are no misspelling of anything, and cost time.
    constexpr std::size_t longest = 60;
    std::size_t least = word.size() > longest ? 0 : 1 + word.size() / 3;
    std::string nearest;
    for (const auto& each : known)
    {
        if (const std::size_t apart = least > 0 ? distance(word, each) : 1; apart <= least && least > 0)
        {
            nearest = apart < least || nearest.empty() ? each : nearest;
            least = std::min(least, apart);
        }
    }
    return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

} // namespace clepsydra::identification
