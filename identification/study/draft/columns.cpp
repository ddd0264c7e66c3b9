#include "study/draft/columns.h"

#include "study/units.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace clepsydra::identification
{

namespace
{

struct Meaning
{
    std::string unit;
    std::string quantity;
};

std::string quantityOfTitle(std::string name)
{
    static const std::map<std::string, std::set<std::string>> words = {
        {"time", {"t", "time"}},
        {"mass", {"m", "w", "mass", "weight"}},
        {"length", {"x", "y", "z", "h", "height", "position", "pos", "gap", "distance", "depth", "level"}},
        {"speed", {"u", "v", "speed", "velocity"}},
        {"share", {"share", "fraction", "percent", "discharged"}},
    };
    std::transform(name.begin(), name.end(), name.begin(),
        [](unsigned char c) { return std::isalnum(c) != 0 ? static_cast<char>(std::tolower(c)) : ' '; });
    std::istringstream parts(name);
    for (std::string part; parts >> part;)
    {
        for (const auto& [quantity, known] : words)
        {
            if (known.count(part) > 0)
            {
                return quantity;
            }
        }
    }
    return "";
}

/// Unit and quantity of a column with a title such as "t_s", "velocity_m_s", "mass g", "mass (g)", or only a unit.
Meaning meaningOf(const std::string& name, const std::string& bracketed)
{
    std::string unit = unitMeant(bracketed);
    std::string word = name;
    constexpr const char* separators = "_ ";
    for (auto at = name.find_first_of(separators); at != std::string::npos && unit.empty();
         at = name.find_first_of(separators, at + 1))
    {
        unit = unitMeant(name.substr(at + 1));
        word = name.substr(0, at);
    }
    const std::string byWord = quantityOfTitle(unit.empty() ? name : word);
    if (unit.empty() && byWord.empty())
    {
        unit = unitMeant(name);
    }
    return {unit, unit.empty() ? byWord : quantityOf(unit)};
}

std::vector<double> finiteOf(const std::vector<double>& column)
{
    std::vector<double> values;
    std::copy_if(
        column.begin(), column.end(), std::back_inserter(values), [](double value) { return std::isfinite(value); });
    return values;
}

bool varies(const std::vector<double>& values)
{
    return values.size() >= 3
           && std::any_of(values.begin(), values.end(), [&](double value) { return value != values.front(); });
}

} // namespace

double GuessedColumn::siUnits() const
{
    return unit.empty() ? 1.0 : siUnitsPer(unit);
}

GuessedColumns guessColumns(const Table& table)
{
    std::vector<Meaning> meanings(table.columns.size());
    std::optional<std::size_t> time;
    std::optional<std::size_t> value;
    for (std::size_t i = 0; i < table.names.size(); ++i)
    {
        meanings[i] = meaningOf(table.names[i], table.units[i]);
    }
    const auto choose = [&](std::optional<std::size_t>& chosen, auto fits) {
        for (std::size_t i = 0; i < table.columns.size() && !chosen; ++i)
        {
            const auto values = finiteOf(table.columns[i]);
            if (i != time && varies(values) && fits(meanings[i], values))
            {
                chosen = i;
            }
        }
    };
    const auto rises = [](const auto& values) { return std::is_sorted(values.begin(), values.end()); };
    choose(time, [&](const Meaning& m, const auto& values) { return m.quantity == "time" && rises(values); });
    choose(time, [&](const Meaning& m, const auto& values) { return m.quantity.empty() && rises(values); });
    choose(value, [](const Meaning& m, const auto& /*unused*/) { return !m.quantity.empty() && m.quantity != "time"; });
    choose(value, [&](const Meaning& m, const auto& /*unused*/) { return m.quantity != "time"; });
    if (!time || !value)
    {
        throw std::runtime_error(
            time ? "no column beside the time has three numbers that differ"
                 : "no column can be the time, which needs three or more numbers that never decrease");
    }
    const auto named = [&](std::size_t i) {
        const bool isNamed = !table.names.empty() && !table.names[i].empty() && table.index(table.names[i]) == i;
        return GuessedColumn{isNamed ? table.names[i] : std::to_string(i + 1), meanings[i].unit};
    };
    return {named(*time), named(*value), meanings[*value].quantity};
}

} // namespace clepsydra::identification
