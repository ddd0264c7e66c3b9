#include "files/timeFolders.h"

#include "files/wholeFile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace clepsydra
{

namespace
{

std::optional<double> timeOf(const std::string& name)
{
    double time = 0;
    const char* const end = name.data() + name.size();
    const auto [read, error] = std::from_chars(name.data(), end, time);
    return error == std::errc() && read == end && std::isfinite(time) ? std::optional(time) : std::nullopt;
}

} // namespace

std::vector<TimeFolder> timeFolders(const std::filesystem::path& folder)
{
    std::vector<TimeFolder> found;
    std::error_code problem;
    const std::filesystem::directory_iterator entries(folder, problem);
    if (problem && problem != std::errc::no_such_file_or_directory && problem != std::errc::not_a_directory)
    {
        throw FileError("Cannot read " + folder.string() + ": " + problem.message());
    }
    for (const auto& entry : entries)
    {
        const std::string name = entry.path().filename().string();
        std::error_code unreadable;
        if (const std::optional<double> time = timeOf(name); time && entry.is_directory(unreadable))
        {
            found.push_back({*time, name});
        }
    }
    std::sort(found.begin(), found.end(), [](const TimeFolder& a, const TimeFolder& b) { return a.time < b.time; });
    return found;
}

} // namespace clepsydra
