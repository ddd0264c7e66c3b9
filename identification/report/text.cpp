#include "report/text.h"

#include "report/numbers.h"

#include <filesystem>

namespace clepsydra::identification
{

namespace
{

using Json = nlohmann::ordered_json;

void writeList(const Json& report, const std::string& key, std::ostream& out)
{
    for (const auto& sentence : report.value(key, Json::array()))
    {
        out << sentence.get<std::string>() << '\n';
    }
}

} // namespace

std::string estimateText(const Json& estimate)
{
    return estimate.is_object() && estimate.at("value").is_number() ? withError({estimate.at("value").get<double>(),
               estimate.at("standardError").is_number() ? estimate.at("standardError").get<double>() : 0.0})
                                                                    : "-";
}

void writeText(const Json& report, std::ostream& out)
{
    out << report.at("summary").get<std::string>() << "\n\n";
    writeList(report, "details", out);
    for (const auto& number : report.value("fitted", Json::array()))
    {
        const std::string unit = number["unit"].get<std::string>();
        const auto with = [&](const std::string& key) {
            return estimateText(number[key]) + (unit.empty() ? "" : ' ' + unit);
        };
        out << "Fitted: " << number["name"].get<std::string>() << ' '
            << (number["withEffect"].is_null() ? with("withoutEffect")
                                               : with("withEffect") + "; without an effect " + with("withoutEffect"))
            << (number["independent"].is_null() ? "" : "; measured independently " + with("independent"))
            << (number.contains("assumed") && !number["assumed"].is_null()
                       ? (number["from"] == "guess" ? "; guessed before " : "; in a handbook ") + with("assumed")
                       : "")
            << '\n';
    }
    writeList(report, "measureNext", out);
    if (report.contains("runs"))
    {
        for (const auto& failure : report["runs"]["failures"])
        {
            out << "Run failed: " << failure["purpose"].get<std::string>() << ", "
                << failure["condition"].get<std::string>() << ", seed " << failure["seed"]
                << (failure["repeatedWithAnotherSeed"].get<bool>() ? " (repeated with another seed)" : " (excluded)")
                << '\n';
        }
    }
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
