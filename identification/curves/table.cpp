#include "curves/table.h"

#include "lists.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace clepsydra::identification
{

namespace
{

namespace fs = std::filesystem;

/// Some spreadsheets write it at the beginning of the file.
constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::string trimmed(const std::string& text)
{
    const auto first = text.find_first_not_of(" \t\r\"");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

struct Title
{
    std::string name;
    std::string unit;
};

/// Round brackets belong to vectors, unless they hold a unit.
std::string withoutRoundBrackets(std::string text)
{
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '(' || c == ')'; }, ' ');
    return text;
}

/// Splits "mass [kg]" or "mass (kg)" into "mass" and "kg". Other brackets belong to vectors.
Title titleOf(const std::string& text)
{
    const auto open = text.find_first_of("[(");
    const auto close = open == std::string::npos ? open : text.find(text[open] == '[' ? ']' : ')', open);
    if (open == 0 || close == std::string::npos)
    {
        return {trimmed(withoutRoundBrackets(text.substr(0, text.find('[')))), ""};
    }
    return {trimmed(text.substr(0, open)), trimmed(text.substr(open + 1, close - open - 1))};
}

bool holds(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// Separator of a line; a blank stands for any white space. If there are semicolons, commas are decimal commas.
char separatorOf(const std::string& line)
{
    return holds(line, ";") ? ';' : holds(line, ",") ? ',' : holds(line, "\t\t") ? '\t' : ' ';
}

/// Fields of a line. Between commas, semicolons and tabs a field may be empty.
std::vector<std::string> split(const std::string& line, char separator)
{
    std::vector<std::string> parts;
    std::istringstream words(line);
    std::string word;
    const auto next = [&] { return !(separator == ' ' ? words >> word : std::getline(words, word, separator)).fail(); };
    while (next())
    {
        parts.push_back(trimmed(word));
    }
    if (separator != ' ' && line.back() == separator)
    {
        parts.emplace_back();
    }
    return parts;
}

/// \param tabs  whether tabs separate the columns of the file, and commas are decimal commas
std::vector<std::string> fields(const std::string& row, bool tabs)
{
    std::string line = withoutRoundBrackets(row);
    const char separator = tabs ? '\t' : separatorOf(line);
    if (separator == ';' || tabs)
    {
        std::replace(line.begin(), line.end(), ',', '.');
    }
    return split(line, separator);
}

/// Titles of the columns. If blanks separate the titles, a field in brackets is the unit of the title before it.
std::vector<Title> titlesOf(const std::string& line)
{
    const char separator = holds(line, "\t") ? '\t' : separatorOf(line);
    std::vector<std::string> texts;
    for (const auto& part : split(line, separator))
    {
        const std::string ends = part.empty() ? "" : std::string{part.front(), part.back()};
        if (separator == ' ' && (ends == "[]" || ends == "()") && !texts.empty())
        {
            texts.back() += part;
        }
        else
        {
            texts.push_back(part);
        }
    }
    return mapped(texts, titleOf);
}

/// Larger numbers are refused, because their squares could overflow.
constexpr double largest = 1e30;

/// The number that a whole text stands for, as strtod reads it.
std::optional<double> numberOfAll(const std::string& text)
{
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    return end == text.c_str() + text.size() ? std::optional(number) : std::nullopt;
}

/// A number in plain decimal notation, or NaN for a missing value; empty for other texts, as inf, nan and hexadecimal
/// numbers.
std::optional<double> numberOf(const std::string& text)
{
    if (text.empty() || text == "NA" || text == "na" || text == "-")
    {
        return missing;
    }
    const auto number = numberOfAll(text);
    const bool isPlain = text.find_first_not_of("0123456789+-.eE") == std::string::npos;
    return isPlain && number && std::abs(*number) <= largest ? number : std::nullopt;
}

/// Whether a line is a row of numbers with decimal commas, separated by tabs.
bool hasTabsAndDecimalCommas(const std::string& line)
{
    if (!holds(line, "\t") || !holds(line, ","))
    {
        return false;
    }
    const auto isDigit = [&](std::size_t at) { return at < line.size() && line[at] >= '0' && line[at] <= '9'; };
    for (std::size_t at = line.find(','); at != std::string::npos; at = line.find(',', at + 1))
    {
        if (at == 0 || !isDigit(at - 1) || !isDigit(at + 1))
        {
            return false;
        }
    }
    const auto words = fields(line, true);
    return std::all_of(words.begin(), words.end(), [](const auto& word) { return numberOf(word).has_value(); });
}

/// Whether a row of numbers has at least one valid number and others that are refused, as inf, nan or 1e308.
bool isNearlyNumbers(const std::vector<std::string>& words)
{
    const auto isFinite = [](const std::string& word) { return std::isfinite(numberOf(word).value_or(missing)); };
    const auto wasMeant = [](const std::string& word) { return numberOfAll(word).has_value(); };
    return std::any_of(words.begin(), words.end(), isFinite) && std::all_of(words.begin(), words.end(), wasMeant);
}

/// A column of the tables of a run, one after the other. Where they overlap, the later one is used.
Curve joined(const std::vector<Table>& tables, const std::string& timeColumn, const std::string& valueColumn)
{
    Curve curve;
    for (const auto& table : tables)
    {
        const auto& time = table.columns[table.index(timeColumn)];
        const auto& value = table.columns[table.index(valueColumn)];
        while (!curve.time.empty() && curve.time.back() >= time.front())
        {
            curve.time.pop_back();
            curve.value.pop_back();
        }
        curve.time.insert(curve.time.end(), time.begin(), time.end());
        curve.value.insert(curve.value.end(), value.begin(), value.end());
    }
    return tidied(std::move(curve));
}

} // namespace

std::size_t Table::index(const std::string& column) const
{
    const Title title = titleOf(column);
    std::string known;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        if (names[i] == title.name && (title.unit.empty() || units[i] == title.unit))
        {
            return i;
        }
        known += ' ' + names[i];
    }
    const double position = numberOf(column).value_or(missing);
    if (position >= 1.0 && position <= static_cast<double>(columns.size()))
    {
        return static_cast<std::size_t>(position) - 1;
    }
    throw std::runtime_error("no column '" + column + "'; there are " + std::to_string(columns.size())
                             + " columns, named:" + (known.empty() ? " (none has a name)" : known));
}

Table readTable(const fs::path& file)
{
    std::ifstream content(file);
    if (!content)
    {
        throw std::runtime_error(file.string() + ": cannot be read");
    }
    std::vector<std::string> lines;
    for (std::string line; std::getline(content, line);)
    {
        lines.push_back(lines.empty() && line.rfind(byteOrderMark, 0) == 0 ? line.substr(byteOrderMark.size()) : line);
    }
    // One row is enough to tell, since in others the numbers may be whole or the last fields empty.
    const bool tabs = std::any_of(lines.begin(), lines.end(), hasTabsAndDecimalCommas);
    Table table;
    std::string header;
    int lineNumber = 0;
    for (const std::string& whole : lines)
    {
        ++lineNumber;
        const std::string line = trimmed(whole);
        if (line.empty())
        {
            continue;
        }
        if (line.front() == '#')
        {
            header = table.columns.empty() ? trimmed(line.substr(1)) : header;
            continue;
        }
        const auto words = fields(tabs ? whole : line, tabs); // the last field may be empty
        const auto row = mapped(words, [](const std::string& word) { return numberOf(word); });
        const auto wrong = words.begin() + (std::find(row.begin(), row.end(), std::nullopt) - row.begin());
        // Names and other text may stand above the numbers, but a row with an invalid number is an error.
        if (wrong != words.end() && table.columns.empty() && !isNearlyNumbers(words))
        {
            header = line;
            continue;
        }
        const std::string where = file.string() + ":" + std::to_string(lineNumber) + ": ";
        if (wrong != words.end())
        {
            constexpr std::size_t longest = 40;
            throw std::runtime_error(
                where + "'" + wrong->substr(0, longest) + (wrong->size() > longest ? "..." : "")
                + "' is not a number from -1e30 to 1e30; for a missing value, leave the field empty or write NA or -");
        }
        if (!table.columns.empty() && row.size() != table.columns.size())
        {
            throw std::runtime_error(where + "expected " + std::to_string(table.columns.size()) + " numbers, found "
                                     + std::to_string(row.size()));
        }
        table.lines.push_back(lineNumber);
        table.columns.resize(row.size());
        for (std::size_t i = 0; i < row.size(); ++i)
        {
            table.columns[i].push_back(*row[i]);
        }
    }
    if (table.columns.empty())
    {
        throw std::runtime_error(
            file.string()
            + ": contains no line of numbers; allowed: columns separated by commas, semicolons, tabs "
              "or spaces, with decimal commas beside semicolons or tabs");
    }
    const auto titles = titlesOf(header);
    if (titles.size() == table.columns.size())
    {
        table.names = mapped(titles, [](const Title& title) { return title.name; });
        table.units = mapped(titles, [](const Title& title) { return title.unit; });
    }
    return table;
}

std::vector<fs::path> filesMatching(const fs::path& pattern)
{
    const auto numberOfTime = [](const fs::path& path) { return numberOf(path.filename().string()).value_or(0.0); };
    std::vector<fs::path> found{fs::path()};
    for (const auto& part : pattern)
    {
        std::vector<fs::path> next;
        for (const auto& path : found)
        {
            if (part != "*")
            {
                next.push_back(path / part);
            }
            else if (fs::is_directory(path))
            {
                next.insert(next.end(), fs::directory_iterator(path), fs::directory_iterator());
            }
        }
        std::sort(
            next.begin(), next.end(), [&](const auto& a, const auto& b) { return numberOfTime(a) < numberOfTime(b); });
        found = std::move(next);
    }
    eraseIf(found, [](const auto& path) { return !fs::is_regular_file(path); });
    return found;
}

Curve readCurve(const fs::path& pattern, const std::string& timeColumn, const std::string& valueColumn,
    const std::vector<std::string>& furtherColumns)
{
    const auto files = filesMatching(pattern);
    if (files.empty())
    {
        throw std::runtime_error(pattern.string() + ": no such file");
    }
    const auto tables = mapped(files, readTable);
    Curve curve = joined(tables, timeColumn, valueColumn);
    curve.others =
        mapped(furtherColumns, [&](const std::string& column) { return joined(tables, timeColumn, column); });
    return curve;
}

Curve tidied(Curve curve)
{
    auto order = numbersWhere(curve.time.size(),
        [&](std::size_t i) { return std::isfinite(curve.time[i]) && std::isfinite(curve.value[i]); });
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return curve.time[a] < curve.time[b]; });
    return {mapped(order, [&](std::size_t i) { return curve.time[i]; }),
        mapped(order, [&](std::size_t i) { return curve.value[i]; })};
}

} // namespace clepsydra::identification
