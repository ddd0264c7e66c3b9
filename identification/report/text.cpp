#include "report/text.h"

#include "emulator/distributions.h"

#include <kainjow/mustache.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

namespace mustache = kainjow::mustache;

int powerOfTen(double value)
{
    return static_cast<int>(std::floor(std::log10(std::abs(value))));
}

/// Whether a number of this magnitude is written without a power of ten.
bool isPlain(int power)
{
    return power >= -4 && power <= 6;
}

std::string estimateText(const Json& estimate)
{
    const Json error = estimate.value("standardError", estimate.value("sd", Json()));
    const Json& value = estimate.at("value");
    return value.is_number() ? withError({value, error.is_number() ? error.get<double>() : 0.0}) : "-";
}

mustache::data dataOf(const Json& json)
{
    if (json.empty() || json == "" || json.is_boolean())
    {
        return json == true;
    }
    if (json.is_string())
    {
        return json.get<std::string>();
    }
    if (json.is_array())
    {
        mustache::data list(mustache::data::type::list);
        for (const auto& item : json)
        {
            list << dataOf(item);
        }
        return list;
    }
    mustache::data data;
    if (json.is_number())
    {
        const auto value = json.get<double>();
        data["short"] = rounded(value);
        data["p"] = pValueText(value);
        data["text"] = json.is_number_integer() ? json.dump() : rounded(value, 3);
        data["share"] = percent(value);
        data["percent"] = rounded(100.0 * value) + " %";
        return data;
    }
    for (const auto& [key, value] : json.items())
    {
        data[key] = dataOf(value);
    }
    if (json.contains("value"))
    {
        data["text"] = estimateText(json);
    }
    return data;
}

} // namespace

void to_json(Json& json, const Estimate& estimate)
{
    json = {{"value", estimate.value}, {"standardError", estimate.standardError}};
}

std::string formatted(double value, std::ios_base& (*format)(std::ios_base&), int digits)
{
    std::ostringstream text;
    text << format << std::setprecision(std::max(0, digits)) << value;
    return text.str();
}

std::string rounded(double value, int digits)
{
    if (value == 0.0 || !std::isfinite(value))
    {
        return std::isfinite(value) ? "0" : "-";
    }
    const double unit = std::pow(10.0, powerOfTen(value) + 1 - digits);
    const double near = std::round(value / unit) * unit;
    const int power = powerOfTen(near * (1.0 + 1e-9)); // rounding may have raised it: 0.0999 has become 0.1
    return isPlain(power) ? formatted(near, std::fixed, digits - 1 - power)
                          : formatted(near, std::scientific, digits - 1);
}

std::string percent(double share)
{
    constexpr double least = 0.01;
    return share < least ? "<1 %" : share > 1.0 - least ? ">99 %" : std::to_string(std::lround(100.0 * share)) + " %";
}

std::string pValueText(double pValue)
{
    return pValue <= leastPValue ? "p below 1e-6" : "p = " + rounded(pValue, pValue < 0.1 ? 1 : 2);
}

std::string withError(const Estimate& estimate)
{
    constexpr int exact = 4;
    const auto& [value, error] = estimate;
    if (!(error > 0.0) || !std::isfinite(error))
    {
        return rounded(value, exact);
    }
    const int decimals = 1 - powerOfTen(error);
    if (isPlain(powerOfTen(error)) || (value != 0.0 && isPlain(powerOfTen(value))))
    {
        return formatted(value, std::fixed, decimals) + " ± " + formatted(error, std::fixed, decimals);
    }
    const int digits = value == 0.0 ? 1 : powerOfTen(value) + decimals;
    return formatted(value, std::scientific, digits) + " ± " + formatted(error, std::scientific, 1);
}

std::string filled(const char* pattern, const Json& data, Escape escape)
{
    mustache::mustache page(pattern);
    if (escape == Escape::none)
    {
        page.set_custom_escape([](const std::string& text) { return text; });
    }
    const std::string text = page.render(dataOf(data));
    if (!page.is_valid())
    {
        throw std::logic_error("in a template of the report: " + page.error_message());
    }
    return text;
}

void writeText(const Json& report, std::ostream& out)
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
