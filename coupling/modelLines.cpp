#include "modelLines.h"

#include <algorithm>
#include <iomanip>
#include <iostream>

namespace clepsydra
{

namespace
{

/// Created at first use, because it is filled before main() starts.
std::map<std::string, std::map<std::string, std::string>>& table()
{
    static std::map<std::string, std::map<std::string, std::string>> lines;
    return lines;
}

} // namespace

ModelLines::ModelLines(const std::string& entry, std::initializer_list<std::pair<const char*, const char*>> lines)
{
    for (const auto& [name, line] : lines)
    {
        names_.append(Foam::word(name));
        table()[entry][name] = line;
    }
}

const std::map<std::string, std::map<std::string, std::string>>& ModelLines::all()
{
    return table();
}

void listModels()
{
    for (const auto& [entry, lines] : ModelLines::all())
    {
        std::cout << entry << '\n';
        const auto longest = std::max_element(lines.begin(), lines.end(),
            [](const auto& one, const auto& other) { return one.first.size() < other.first.size(); });
        for (const auto& [name, line] : lines)
        {
            std::cout << "    " << std::left << std::setw(static_cast<int>(longest->first.size()) + 2) << name << line
                      << '\n';
        }
    }
}

} // namespace clepsydra
