#include "study/draft/conditions.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace clepsydra::identification
{

namespace
{

namespace fs = std::filesystem;

bool isDigit(char c)
{
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool isLetter(char c)
{
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

std::string withoutSeparator(std::string text)
{
    text.erase(text.find_last_not_of("-_ ") + 1);
    return text;
}

enum class MarkKind
{
    word,
    number,
    letter
};

/// The end of a name that may say which repeat it is.
struct Mark
{
    std::string stem;
    MarkKind kind;
    int ordinal;
};

/// "bead3_trial" and "bead3t" end with a word that says that a repeat's number follows.
std::optional<std::string> stemBeforeWord(const std::string& text)
{
    static const std::array<std::string, 12> words = {
        "trial", "repeat", "test", "take", "run", "rep", "try", "no", "nr", "t", "r", "n"};
    for (const auto& word : words)
    {
        const bool ends = text.size() >= word.size()
                          && std::equal(word.rbegin(), word.rend(), text.rbegin(),
                              [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
        const std::string before = ends ? text.substr(0, text.size() - word.size()) : "";
        if (ends && (before.empty() || !isLetter(before.back())))
        {
            return withoutSeparator(before);
        }
    }
    return {};
}

std::optional<Mark> markOf(const std::string& name)
{
    constexpr std::size_t mostDigits = 4;
    const auto end = name.find_last_not_of("0123456789");
    const std::string before = end == std::string::npos ? "" : name.substr(0, end + 1);
    const std::string digits = name.substr(before.size());
    if (!digits.empty() && digits.size() <= mostDigits && (before.empty() || before.back() != '.'))
    {
        const auto stem = stemBeforeWord(withoutSeparator(before));
        return Mark{
            stem.value_or(withoutSeparator(before)), stem ? MarkKind::word : MarkKind::number, std::stoi(digits)};
    }
    const std::string rest = name.empty() ? "" : name.substr(0, name.size() - 1);
    if (!rest.empty() && isLetter(name.back()) && !isLetter(rest.back()))
    {
        return Mark{
            withoutSeparator(rest), MarkKind::letter, std::tolower(static_cast<unsigned char>(name.back())) - 'a'};
    }
    return {};
}

/// Numbers and letters are marks where they count: 0 or 1 (or a), and none is missing.
bool count(MarkKind kind, std::vector<int> ordinals)
{
    std::sort(ordinals.begin(), ordinals.end());
    const bool begins = ordinals.front() == 0 || (kind == MarkKind::number && ordinals.front() == 1);
    const auto gap = std::adjacent_find(ordinals.begin(), ordinals.end(), [](int a, int b) { return b != a + 1; });
    return kind == MarkKind::word || (ordinals.size() > 1 && begins && gap == ordinals.end());
}

/// "dry10mm" is 10 in the family "dry*mm".
struct Place
{
    std::string family;
    double number = 0.0;
    std::string text;
};

Place placeOf(const std::string& name)
{
    const auto last = name.find_last_of("0123456789");
    if (last == std::string::npos)
    {
        return {name, 0.0, ""};
    }
    std::size_t first = last;
    while (first > 0 && (isDigit(name[first - 1]) || (name[first - 1] == '.' && first > 1 && isDigit(name[first - 2]))))
    {
        --first;
    }
    const std::string number = name.substr(first, last + 1 - first);
    return {name.substr(0, first) + '*' + name.substr(last + 1), std::strtod(number.c_str(), nullptr), number};
}

void proposeHeldOut(std::vector<DraftedCondition>& conditions)
{
    constexpr std::size_t fewest = 3;
    if (conditions.size() < fewest)
    {
        return;
    }
    std::map<std::string, std::vector<std::size_t>> families;
    for (std::size_t i = 0; i < conditions.size(); ++i)
    {
        families[placeOf(conditions[i].name).family].push_back(i);
    }
    const auto larger = [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); };
    const auto largest = std::max_element(families.begin(), families.end(), larger);
    std::vector<std::size_t> range = largest->second;
    std::vector<std::size_t> other;
    if (range.size() < fewest)
    {
        range.resize(conditions.size());
        std::iota(range.begin(), range.end(), std::size_t{0});
    }
    else
    {
        families.erase(largest);
        const auto next = std::max_element(families.begin(), families.end(), larger);
        other = next != families.end() && next->second.size() > 1 ? next->second : range;
    }
    conditions[range[range.size() / 2]].isHeldOut = true;
    if (conditions.size() > fewest)
    {
        conditions[(other.empty() ? range : other).back()].isHeldOut = true;
    }
}

} // namespace

std::vector<DraftedCondition> draftConditions(const std::vector<fs::path>& files)
{
    std::map<std::pair<std::string, MarkKind>, std::vector<int>> marks;
    for (const auto& file : files)
    {
        if (const auto mark = markOf(file.stem().string()))
        {
            marks[{mark->stem, mark->kind}].push_back(mark->ordinal);
        }
    }
    std::map<std::string, DraftedCondition> byName;
    for (const auto& file : files)
    {
        const auto mark = markOf(file.stem().string());
        const bool isRepeat = mark && count(mark->kind, marks.at({mark->stem, mark->kind}));
        const std::string name = isRepeat ? mark->stem : file.stem().string();
        auto& condition = byName[name.empty() ? "measured" : name];
        condition.name = name.empty() ? "measured" : name;
        condition.files.push_back(file);
    }
    std::vector<DraftedCondition> conditions;
    for (auto& [name, condition] : byName)
    {
        condition.number = placeOf(name).text;
        conditions.push_back(condition);
    }
    std::sort(conditions.begin(), conditions.end(), [](const auto& a, const auto& b) {
        const Place one = placeOf(a.name);
        const Place two = placeOf(b.name);
        return std::tie(one.family, one.number, a.name) < std::tie(two.family, two.number, b.name);
    });
    proposeHeldOut(conditions);
    return conditions;
}

} // namespace clepsydra::identification
