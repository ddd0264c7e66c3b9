#include "files/timeFolders.h"

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
    std::error_code missing;
    for (const auto& entry : std::filesystem::directory_iterator(folder, missing))
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
