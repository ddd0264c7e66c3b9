#include "tokens/jsonText.h"

#include <nlohmann/json.hpp>

namespace clepsydra
{

std::string jsonText(const std::vector<std::pair<std::string, JsonValue>>& entries)
{
    auto object = nlohmann::ordered_json::object();
    for (const auto& [name, value] : entries)
    {
        std::visit([&object, &name = name](const auto& held) { object[name] = held; }, value);
    }
    return object.dump(2);
}

} // namespace clepsydra
