#include "study/entries.h"

#include "files/wholeFile.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iomanip>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

/// Parts of a line `name value; rest`.
struct EntryLine
{
    std::string before; // name and the blanks around it
    std::string name;
    std::string value;
    std::string after; // from the semicolon on
};

constexpr const char* blanks = " \t\r\f\v";

/// Parsed without std::regex, whose recursion overflows the stack on a line of about 100 kB.
std::optional<EntryLine> entryLine(const std::string& line)
{
    const auto isOfWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    const auto name = std::min(line.find_first_not_of(blanks), line.size());
    const std::size_t nameEnd = std::find_if_not(line.begin() + name, line.end(), isOfWord) - line.begin();
    const auto value = line.find_first_not_of(blanks, nameEnd);
    const auto valueEnd = line.find_first_of(";/{}", nameEnd);
    if (name == nameEnd || value == nameEnd || valueEnd == std::string::npos || line[valueEnd] != ';'
        || value >= valueEnd)
    {
        return std::nullopt;
    }
    const std::string text = line.substr(value, valueEnd - value);
    return EntryLine{line.substr(0, value), line.substr(name, nameEnd - name),
        text.substr(0, text.find_last_not_of(" \t\r") + 1), line.substr(valueEnd)};
}

std::ifstream opened(const std::filesystem::path& file)
{
    std::ifstream lines(file);
    if (!lines)
    {
        throw std::runtime_error(file.string() + ": cannot be read");
    }
    return lines;
}

} // namespace

Entries readEntries(const std::filesystem::path& file)
{
    std::ifstream lines = opened(file);
    Entries entries;
    for (std::string line; std::getline(lines, line);)
    {
        if (const auto entry = entryLine(line))
        {
            entries[entry->name] = entry->value;
        }
    }
    return entries;
}

void replaceEntries(const std::filesystem::path& file, const Entries& changes)
{
    std::ifstream lines = opened(file);
    std::ostringstream changed;
    std::set<std::string> done;
    for (std::string line; std::getline(lines, line);)
    {
        const auto entry = entryLine(line);
        if (entry && changes.count(entry->name) > 0)
        {
            done.insert(entry->name);
            line = entry->before + changes.at(entry->name) + entry->after;
        }
        changed << line << '\n';
    }
    lines.close();
    for (const auto& [name, value] : changes)
    {
        if (done.count(name) == 0)
        {
            throw std::runtime_error(file.string() + ": has no entry '" + name + "' to be set to " + value);
        }
    }
    writeWhole(file, changed.str());
}

Expression::Variables numbersOf(Entries entries, const Entries& defaults)
{
    entries.insert(defaults.begin(), defaults.end());
    Expression::Variables numbers;
    for (const auto& [name, value] : entries)
    {
        std::string text = value;
        for (std::size_t depth = 0; !text.empty() && text.front() == '$' && depth < entries.size(); ++depth)
        {
            const auto other = entries.find(text.substr(1));
            text = other == entries.end() ? "" : other->second;
        }
        char* end = nullptr;
        const double number = std::strtod(text.c_str(), &end);
        if (!text.empty() && end == text.c_str() + text.size())
        {
            numbers[name] = number;
        }
    }
    return numbers;
}

std::string textOf(double number)
{
    std::ostringstream text;
    text << std::setprecision(9) << number;
    return text.str();
}

} // namespace clepsydra::identification
