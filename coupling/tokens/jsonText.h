#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace clepsydra
{

using JsonValue = std::variant<int, std::int64_t, double, std::map<std::string, double>>;

/// A JSON object of these entries in this order, two blanks for each level. The JSON library is compiled here alone: beside
/// OpenFOAM's headers it takes ten times as long.
std::string jsonText(const std::vector<std::pair<std::string, JsonValue>>& entries);

} // namespace clepsydra
