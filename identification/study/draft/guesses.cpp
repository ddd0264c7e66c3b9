#include "study/draft/draftStudy.h"

#include "curves/table.h"
#include "lists.h"
#include "study/units.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <tuple>

namespace clepsydra::identification
{

namespace
{

//--- Columns --------------------------------------------------------------------------------------------------------

struct Meaning
{
    std::string unit;
    std::string quantity;
};

std::string quantityOfTitle(const std::string& title)
{
    for (const auto& [quantity, words] : {std::pair("time", "t|time"), std::pair("mass", "m|w|mass|weight"),
             std::pair("length", "x|y|z|h|height|position|pos|gap|distance|depth|level"),
             std::pair("speed", "u|v|speed|velocity"), std::pair("share", "share|fraction|percent|discharged")})
    {
        const std::string word = std::string("(^|[^a-z0-9])(") + words + ")([^a-z0-9]|$)";
        if (std::regex_search(title, std::regex(word, std::regex::icase)))
        {
            return quantity;
        }
    }
    return "";
}

/// Unit and quantity of a column with a title such as "t_s", "velocity_m_s", "mass g", "mass (g)", or only a unit.
Meaning meaningOf(const std::string& name, const std::string& bracketed)
{
    std::string unit = unitMeant(bracketed);
    std::string word = name;
    for (auto at = name.find_first_of("_ "); at != std::string::npos && unit.empty();
         at = name.find_first_of("_ ", at + 1))
    {
        unit = unitMeant(name.substr(at + 1));
        word = name.substr(0, at);
    }
    const std::string byWord = quantityOfTitle(unit.empty() ? name : word);
    unit = unit.empty() && byWord.empty() ? unitMeant(name) : unit;
    return {unit, unit.empty() ? byWord : quantityOf(unit)};
}

//--- Conditions -----------------------------------------------------------------------------------------------------

/// The end of a file name that may number a repeat, and what stands before it.
struct Mark
{
    std::string stem;
    char kind; // w: a number behind a word such as "trial"; 1: a number; a: a letter
    int ordinal;
};

Mark markOf(const std::string& name)
{
    static const std::regex pattern("(|.*[^a-z])(?:trial|repeat|test|take|run|rep|try|no|nr|t|r|n)[-_ ]*([0-9]{1,4})|"
                                    "(|.*[^0-9.])([0-9]{1,4})|(.*[^a-z])([a-z])",
        std::regex::icase);
    std::smatch parts;
    if (!std::regex_match(name, parts, pattern))
    {
        return {name, ' ', 0};
    }
    std::string stem = parts.str(1) + parts.str(3) + parts.str(5);
    stem.erase(stem.find_last_not_of("-_ ") + 1);
    return parts[6].matched ? Mark{stem, 'a', std::tolower(static_cast<unsigned char>(name.back())) - 'a'}
                            : Mark{stem, parts[2].matched ? 'w' : '1', std::stoi(parts.str(2) + parts.str(4))};
}

/// Numbers and letters number repeats if they begin with 0 or 1 (or a) and none is missing.
bool numbersRepeats(char kind, const std::set<int>& ordinals)
{
    const bool isWhole = *ordinals.begin() <= (kind == '1' ? 1 : 0)
                         && *ordinals.rbegin() - *ordinals.begin() + 1 == static_cast<int>(ordinals.size());
    return kind == 'w' || (isWhole && ordinals.size() > 1);
}

void proposeHeldOut(std::vector<DraftedCondition>& conditions)
{
    std::map<std::string, std::vector<std::size_t>> series;
    std::vector<std::size_t> range;
    for (std::size_t i = 0; i < conditions.size(); ++i)
    {
        auto& members = series[conditions[i].series];
        members.push_back(i);
        range = members.size() > range.size() ? members : range;
    }
    const bool isSeries = range.size() > 2;
    range = isSeries ? range : numbersWhere(conditions.size(), [](std::size_t) { return true; });
    if (range.size() > 2)
    {
        conditions[range[range.size() / 2]].isHeldOut = true;
    }
    if (conditions.size() > 3)
    {
        // A condition that is the only one of its series stays in the training.
        std::find_if(conditions.rbegin(), conditions.rend(), [&](const DraftedCondition& condition) {
            return !isSeries || series[condition.series].size() > 1;
        })->isHeldOut = true;
    }
}

} // namespace

GuessedColumns guessColumns(const std::filesystem::path& file)
{
    const Table table = readTable(file);
    std::vector<Meaning> meanings(table.columns.size());
    std::vector<int> asTime(table.columns.size());
    std::vector<int> asValue(table.columns.size());
    for (std::size_t i = 0; i < table.columns.size(); ++i)
    {
        meanings[i] = table.names.empty() ? Meaning{} : meaningOf(table.names[i], table.units[i]);
        auto numbers = table.columns[i];
        eraseIf(numbers, [](double number) { return !std::isfinite(number); });
        const bool varies = numbers.size() > 2 && !std::equal(numbers.begin() + 1, numbers.end(), numbers.begin());
        const bool rises = varies && std::is_sorted(numbers.begin(), numbers.end());
        const std::string& quantity = meanings[i].quantity;
        asTime[i] = rises && quantity == "time" ? 2 : rises && quantity.empty() ? 1 : 0;
        asValue[i] = !varies || quantity == "time" ? 0 : quantity.empty() ? 1 : 2;
    }
    const auto best = [&](const std::vector<int>& scores, const std::string& otherwise) {
        const auto chosen = std::max_element(scores.begin(), scores.end());
        if (*chosen == 0)
        {
            throw std::runtime_error(file.string() + ": " + otherwise);
        }
        return static_cast<std::size_t>(chosen - scores.begin());
    };
    const std::size_t time =
        best(asTime, "no column can be the time, which needs three or more numbers that never decrease");
    asValue[time] = 0;
    const std::size_t value = best(asValue, "no column beside the time has three numbers that differ");
    const auto specified = [&](std::size_t i) {
        const bool isNamed = !table.names.empty() && !table.names[i].empty() && table.index(table.names[i]) == i;
        ColumnSpecification column{isNamed ? table.names[i] : std::to_string(i + 1)};
        column.unit = meanings[i].unit;
        column.factor = column.unit.empty() ? 1.0 : siUnitsPer(column.unit);
        return column;
    };
    return {specified(time), specified(value), meanings[value].quantity};
}

std::vector<DraftedCondition> draftConditions(const std::vector<std::filesystem::path>& files)
{
    std::map<std::pair<std::string, char>, std::set<int>> ordinals;
    for (const auto& file : files)
    {
        const Mark mark = markOf(file.stem().string());
        ordinals[{mark.stem, mark.kind}].insert(mark.ordinal);
    }
    static const std::regex numbered(R"((.*?)([0-9]+(?:\.[0-9]+)*)([^0-9]*))");
    std::map<std::tuple<std::string, double, std::string>, DraftedCondition> sorted;
    for (const auto& file : files)
    {
        const Mark mark = markOf(file.stem().string());
        std::string name =
            numbersRepeats(mark.kind, ordinals[{mark.stem, mark.kind}]) ? mark.stem : file.stem().string();
        name = name.empty() ? "measured" : name;
        std::smatch parts;
        const bool isNumbered = std::regex_match(name, parts, numbered);
        const std::string series = isNumbered ? parts.str(1) + '*' + parts.str(3) : name;
        auto& condition = sorted[{series, isNumbered ? std::stod(parts[2]) : 0.0, name}];
        condition.name = name;
        condition.number = isNumbered ? parts.str(2) : "";
        condition.series = series;
        condition.files.push_back(file);
    }
    auto conditions = mapped(sorted, [](const auto& each) { return each.second; });
    proposeHeldOut(conditions);
    return conditions;
}

} // namespace clepsydra::identification
