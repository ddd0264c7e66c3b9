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

/// Error in a study file. The message begins with "file:line: ".
class StudyError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// A place in a YAML file. All accesses are checked; errors name file, line, key and what is allowed.
class YamlPlace
{
public:
    /// Reads a file. \throws StudyError if the file cannot be read or is no YAML, if a key is given twice or has no
    /// value, or if values that begin with FILL IN are still to be filled in, which the message lists
    static YamlPlace fileAt(const std::filesystem::path& file);

    /// One line for each value that is still to be filled in: file, line, key, and what to fill in.
    static std::string placesToFillIn(const std::filesystem::path& file);

    /// \throws StudyError naming the line of the first key that is not among `allowed`, or if the place is no map
    void allow(const std::vector<std::string>& allowed) const;

    bool has(const std::string& key) const;
    /// Place of a key. \throws StudyError if there is no such key
    YamlPlace at(const std::string& key) const;
    /// Place of a key; if there is no such key, an empty place, which is an empty list and an empty map.
    YamlPlace optional(const std::string& key) const;

    std::vector<YamlPlace> list() const;
    /// A list; a single value counts as a list of one.
    std::vector<YamlPlace> oneOrMore() const;
    std::vector<std::pair<std::string, YamlPlace>> map() const;

    std::string text() const;
    double number() const;
    double positive() const;
    int count(int smallest) const;
    bool flag() const;
    /// The text, which must be one of `words`.
    std::string oneOf(const std::vector<std::string>& words) const;
    /// Index of the text, which must be one of `words`.
    std::size_t indexIn(const std::vector<std::string>& words) const;
    /// Two numbers, the second above the first. \param what  description of the two numbers for the message
    std::pair<double, double> range(const std::string& what) const;
    /// A path, relative to the file's folder.
    std::filesystem::path path() const;

    std::string textOr(const std::string& key, const std::string& byDefault) const
    {
        return has(key) ? at(key).text() : byDefault;
    }
    /// The text, which must be one of `words` if the key is there.
    std::string wordOr(
        const std::string& key, const std::string& byDefault, const std::vector<std::string>& words) const
    {
        return has(key) ? at(key).oneOf(words) : byDefault;
    }
    double numberOr(const std::string& key, double byDefault) const
    {
        return has(key) ? at(key).number() : byDefault;
    }
    double positiveOr(const std::string& key, double byDefault) const
    {
        return has(key) ? at(key).positive() : byDefault;
    }
    int countOr(const std::string& key, int byDefault, int smallest) const
    {
        return has(key) ? at(key).count(smallest) : byDefault;
    }
    bool flagOr(const std::string& key, bool byDefault) const
    {
        return has(key) ? at(key).flag() : byDefault;
    }

    [[noreturn]] void fail(const std::string& what) const;
    void failIf(bool isWrong, const std::string& what) const;

private:
    static YamlPlace parsed(const std::filesystem::path& file);
    void checkKeys(int depth, int& places) const;
    std::string toBeFilledIn() const;
    /// The values of a list or a map with their keys, which are [1], [2], ... in a list; none of a single value.
    std::vector<std::pair<std::string, YamlPlace>> children() const;
    std::string where() const;
    YamlPlace(const YAML::Node& node, std::shared_ptr<const std::filesystem::path> file, std::string name);

    YAML::Node node_;
    std::shared_ptr<const std::filesystem::path> file_;
    std::string name_;
};

} // namespace clepsydra::identification
