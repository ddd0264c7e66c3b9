#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace clepsydra
{

/// A number in JSON, with as many digits as it takes to read the very same one again; "null" for one that is not finite.
std::string jsonText(double number);

/// A JSON object, its entries in the order in which they are added. What a run writes needs no more, and a JSON library takes
/// twenty times as long to compile.
class JsonObject
{
public:
    /// \param name  without characters that JSON would escape
    void add(const std::string& name, double value);
    void add(const std::string& name, std::int64_t value);
    void add(const std::string& name, int value);
    void add(const std::string& name, const std::map<std::string, double>& values);

    /// Two blanks for each level.
    std::string text() const;

private:
    std::string text(const std::string& indentation) const;

    std::vector<std::pair<std::string, std::string>> entries_;
};

} // namespace clepsydra
