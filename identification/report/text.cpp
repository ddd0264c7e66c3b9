#include "report/text.h"

#include "report/filled.h"

#include <filesystem>

namespace clepsydra::identification
{

void writeText(const nlohmann::ordered_json& report, std::ostream& out)
{
    out << filled(
#include "report/summary.mustache"
        , report, Escape::none);
}

std::string fromStudy(const Study& study, std::string text)
{
    const std::string folder = (std::filesystem::absolute(study.file).lexically_normal().parent_path() / "").string();
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
    {
        text.erase(at, folder.size());
    }
    return text;
}

} // namespace clepsydra::identification
