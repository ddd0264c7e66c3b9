#include "runner/entries.h"

#include "files/wholeFile.h"

#include <fstream>
#include <iomanip>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

const std::regex& entryLine()
{
    static const std::regex pattern(R"(^(\s*)(\w+)(\s+)([^;/{}]+);(.*)$)");
    return pattern;
}

std::string stripped(const std::string& text)
{
    const auto end = text.find_last_not_of(" \t\r");
    return end == std::string::npos ? "" : text.substr(0, end + 1);
}

} // namespace

Entries readEntries(const std::filesystem::path& file)
{
    std::ifstream lines(file);
    if (!lines)
    {
        throw std::runtime_error(file.string() + ": cannot be read");
    }
    Entries entries;
    std::smatch parts;
    for (std::string line; std::getline(lines, line);)
    {
        if (std::regex_match(line, parts, entryLine()))
        {
            entries[parts[2]] = stripped(parts[4]);
        }
    }
    return entries;
}

void replaceEntries(const std::filesystem::path& file, const Entries& changes)
{
    std::ifstream lines(file);
    if (!lines)
    {
        throw std::runtime_error(file.string() + ": cannot be read");
    }
    std::ostringstream changed;
    std::set<std::string> done;
    std::smatch parts;
    for (std::string line; std::getline(lines, line);)
    {
        if (std::regex_match(line, parts, entryLine()))
        {
            if (const auto change = changes.find(parts[2]); change != changes.end())
            {
                done.insert(change->first);
                line = parts[1].str() + change->first + parts[3].str() + change->second + ';' + parts[5].str();
            }
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

Expression::Variables numbersOf(const Entries& entries)
{
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
