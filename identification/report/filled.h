#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace clepsydra::identification
{

enum class Escape
{
    none,
    html
};

/// Fills a mustache template (https://mustache.github.io/mustache.5.html). What is null or empty counts as false, and a
/// number is an object of its forms:
///     text     three significant digits, or all digits of an integer
///     share    a share in percent: "<1 %"
///     percent  "2.1 %"
/// An estimate, an object with `value` and `standardError` or `sd`, has besides these keys its `text`: "0.17 ± 0.01".
std::string filled(const char* pattern, const nlohmann::ordered_json& data, Escape escape);

} // namespace clepsydra::identification
