#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace clepsydra::identification
{

/// Bad input. The text begins with "file:line: ".
class StudyError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// A place in a YAML file. Every look at it is checked; errors name file, line, key and what is allowed.
class YamlPlace
{
public:
    /// How a value begins that is still to be given, as `traceResidual new` writes it, with what to do behind it.
    static constexpr const char* toFillIn = "FILL IN";

    /// \throws StudyError if the file cannot be read, is no YAML, has a key twice or without a value anywhere, or values
    /// that are still to be filled in, all of which it lists
    static YamlPlace fileAt(const std::filesystem::path& file);

    /// A line for each value that is still to be filled in: file, line, key, and what to do.
    static std::string placesToFillIn(const std::filesystem::path& file);

    /// \throws StudyError naming the line of the first key that is not among `allowed`, or if this is no map
    void allow(const std::vector<std::string>& allowed) const;

    bool has(const std::string& key) const;
    /// \throws StudyError if there is no such key
    YamlPlace at(const std::string& key) const;
    /// The same; where there is no such key, a place that holds nothing: an empty list and an empty map.
    YamlPlace optional(const std::string& key) const;

    std::vector<YamlPlace> list() const;
    /// A list, or an isolated value as a list of one.
    std::vector<YamlPlace> oneOrMore() const;
    std::vector<std::pair<std::string, YamlPlace>> map() const;

    std::string text() const;
    double number() const;
    double positive() const;
    int count(int smallest) const;
    bool flag() const;
    /// One of a few words.
    std::string oneOf(const std::vector<std::string>& words) const;
    /// Two numbers, the second above the first. \param what  they must be, for the error
    std::pair<double, double> range(const std::string& what) const;
    /// Relative to the file's folder.
    std::filesystem::path path() const;

    std::string textOr(const std::string& key, const std::string& byDefault) const;
    double numberOr(const std::string& key, double byDefault) const;
    double positiveOr(const std::string& key, double byDefault) const;
    int countOr(const std::string& key, int byDefault, int smallest) const;
    bool flagOr(const std::string& key, bool byDefault) const;

    [[noreturn]] void fail(const std::string& what) const;

    const std::filesystem::path& file() const
    {
        return *file_;
    }

private:
    static YamlPlace parsed(const std::filesystem::path& file);
    void checkKeys(int depth, int& places) const;
    std::string toBeFilledIn() const;
    std::string where() const;
    YamlPlace(const YAML::Node& node, std::shared_ptr<const std::filesystem::path> file, std::string name);

    YAML::Node node_;
    std::shared_ptr<const std::filesystem::path> file_;
    std::string name_;
};

} // namespace clepsydra::identification
