#include "tokens/jsonText.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace clepsydra
{

namespace
{

const std::string oneLevel = "  ";

} // namespace

std::string jsonText(double number)
{
    if (!std::isfinite(number))
    {
        return "null";
    }
    if (number == 0)
    {
        return std::signbit(number) ? "-0.0" : "0.0";
    }
    // d.ddde-05
    std::array<char, 32> characters{};
    const auto end = std::to_chars(
        characters.data(), characters.data() + characters.size(), std::abs(number), std::chars_format::scientific);
    const std::string scientific(characters.data(), end.ptr);
    const std::size_t exponentAt = scientific.find('e');
    std::string digits = scientific.substr(0, exponentAt);
    digits.erase(std::remove(digits.begin(), digits.end(), '.'), digits.end());
    const int count = static_cast<int>(digits.size());
    const int beforePoint = std::atoi(scientific.c_str() + exponentAt + 1) + 1;
    const std::string sign = number < 0 ? "-" : "";
    constexpr int mostDigits = 15;
    constexpr int mostZeros = 3; // behind the point
    if (beforePoint > mostDigits || beforePoint < -mostZeros)
    {
        return sign + scientific;
    }
    if (beforePoint <= 0)
    {
        return sign + "0." + std::string(-beforePoint, '0') + digits;
    }
    if (count <= beforePoint)
    {
        return sign + digits + std::string(beforePoint - count, '0') + ".0";
    }
    return sign + digits.insert(beforePoint, ".");
}

void JsonObject::add(const std::string& name, double value)
{
    entries_.emplace_back(name, jsonText(value));
}

void JsonObject::add(const std::string& name, std::int64_t value)
{
    entries_.emplace_back(name, std::to_string(value));
}

void JsonObject::add(const std::string& name, int value)
{
    add(name, std::int64_t{value});
}

void JsonObject::add(const std::string& name, const std::map<std::string, double>& values)
{
    JsonObject inner;
    for (const auto& [innerName, value] : values)
    {
        inner.add(innerName, value);
    }
    entries_.emplace_back(name, inner.text(oneLevel));
}

std::string JsonObject::text() const
{
    return text("");
}

std::string JsonObject::text(const std::string& indentation) const
{
    if (entries_.empty())
    {
        return "{}";
    }
    std::string lines;
    for (const auto& [name, value] : entries_)
    {
        lines += lines.empty() ? "{\n" : ",\n";
        lines += indentation + oneLevel + '"' + name + "\": " + value;
    }
    return lines + '\n' + indentation + '}';
}

} // namespace clepsydra
