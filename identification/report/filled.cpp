#include "report/filled.h"

#include "report/numbers.h"

#include <kainjow/mustache.hpp>

#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

using Json = nlohmann::ordered_json;
namespace mustache = kainjow::mustache;

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

} // namespace clepsydra::identification
