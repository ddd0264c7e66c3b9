#include "study/draft/conditions.h"

#include "lists.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <regex>
#include <tuple>

namespace clepsydra::identification
{

namespace
{

namespace fs = std::filesystem;

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

/// The end of a file name that may number a repeat.
struct Mark
{
    std::string stem;
    MarkKind kind;
    int ordinal;
};

std::optional<Mark> markOf(const std::string& name)
{
    static const std::regex numbered("(|.*[^0-9.])([0-9]{1,4})");
    static const std::regex lettered("(.*[^a-z])([a-z])", std::regex::icase);
    // A word such as "trial" in "bead3_trial" or "t" in "bead3t" shows that the number of a repeat follows.
    static const std::regex before("(|.*[^a-z])(trial|repeat|test|take|run|rep|try|no|nr|t|r|n)", std::regex::icase);
    std::smatch parts;
    if (std::regex_match(name, parts, numbered))
    {
        const int number = std::stoi(parts[2]);
        const std::string stem = withoutSeparator(parts[1]);
        return std::regex_match(stem, parts, before) ? Mark{withoutSeparator(parts[1]), MarkKind::word, number}
                                                     : Mark{stem, MarkKind::number, number};
    }
    if (std::regex_match(name, parts, lettered))
    {
        return Mark{
            withoutSeparator(parts[1]), MarkKind::letter, std::tolower(static_cast<unsigned char>(name.back())) - 'a'};
    }
    return {};
}

/// Numbers and letters number repeats if they begin with 0 or 1 (or a) and none is missing.
bool count(MarkKind kind, std::vector<int> ordinals)
{
    std::sort(ordinals.begin(), ordinals.end());
    const bool begins = ordinals.front() == 0 || (kind == MarkKind::number && ordinals.front() == 1);
    const auto gap = std::adjacent_find(ordinals.begin(), ordinals.end(), [](int a, int b) { return b != a + 1; });
    return kind == MarkKind::word || (ordinals.size() > 1 && begins && gap == ordinals.end());
}

/// Position of a name in a series: "dry10mm" has the number 10 in the family "dry*mm".
struct Place
{
    std::string family;
    double number = 0.0;
    std::string text;
};

Place placeOf(const std::string& name)
{
    static const std::regex numbered(R"((.*?)([0-9]+(?:\.[0-9]+)*)([^0-9]*))");
    std::smatch parts;
    return std::regex_match(name, parts, numbered)
               ? Place{parts.str(1) + '*' + parts.str(3), std::stod(parts[2]), parts[2]}
               : Place{name, 0.0, ""};
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
        range = numbersWhere(conditions.size(), [](std::size_t) { return true; });
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
