#include "study/yaml.h"

#include "lists.h"
#include "tokens/didYouMean.h"

#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <utility>

namespace clepsydra::identification
{

namespace
{

/// Lines `---` or `...` separate documents. They are searched for here, because YAML::LoadAll never returns from some
/// texts, as `,a`.
void refuseMoreDocuments(const std::filesystem::path& file)
{
    std::ifstream lines(file);
    bool content = false;
    bool ended = false;
    for (std::string line; std::getline(lines, line);)
    {
        const bool isMark = (line.rfind("---", 0) == 0 || line.rfind("...", 0) == 0)
                            && (line.size() == 3 || std::isspace(static_cast<unsigned char>(line[3])) != 0);
        const auto first = line.find_first_not_of(" \t\r", isMark ? 3 : 0);
        ended = ended || (isMark && content);
        const bool isContent = first != std::string::npos && line[first] != '#' && line[first] != '%';
        if (isContent && ended)
        {
            throw StudyError(file.string() + ": holds several documents (parts between lines '---'); allowed is one");
        }
        content = content || isContent;
    }
}

} // namespace

YamlPlace::YamlPlace(const YAML::Node& node, std::shared_ptr<const std::filesystem::path> file, std::string name)
    : node_(node),
      file_(std::move(file)),
      name_(std::move(name))
{}

YamlPlace YamlPlace::fileAt(const std::filesystem::path& file)
{
    YamlPlace place = parsed(file);
    if (const std::string places = place.toBeFilledIn(); !places.empty())
    {
        throw StudyError(places + "Replace these by values");
    }
    return place;
}

std::string YamlPlace::placesToFillIn(const std::filesystem::path& file)
{
    return parsed(file).toBeFilledIn();
}

/// The recursion ends, because checkKeys has checked the depth.
std::string YamlPlace::toBeFilledIn() const
{
    const bool isOne = node_.IsScalar() && node_.Scalar().rfind("FILL IN", 0) == 0;
    std::string places = isOne ? where() + node_.Scalar() + '\n' : "";
    for (const auto& [key, value] : children())
    {
        places += value.toBeFilledIn();
    }
    return places;
}

YamlPlace YamlPlace::parsed(const std::filesystem::path& file)
{
    try
    {
        refuseMoreDocuments(file);
        YamlPlace place(YAML::LoadFile(file.string()), std::make_shared<const std::filesystem::path>(file), "");
        int places = 0;
        place.checkKeys(0, places);
        return place;
    }
    catch (const YAML::BadFile&)
    {
        throw StudyError(file.string() + ": cannot be read");
    }
    catch (const YAML::ParserException& error)
    {
        throw StudyError(
            file.string() + ":" + std::to_string(error.mark.line + 1) + ": is not valid YAML: " + error.msg);
    }
}

void YamlPlace::checkKeys(int depth, int& places) const
{
    // With anchors, a place can contain itself, and a few lines can expand to any size.
    constexpr int deepest = 50;
    constexpr int most = 100000;
    failIf(depth > deepest || ++places > most,
        "the file is nested too deeply, is too large, or holds itself by way of an anchor");
    std::map<std::string, int> lines;
    for (const auto& [key, value] : children())
    {
        const auto [first, isNew] = lines.emplace(key, value.node_.Mark().line + 1);
        value.failIf(!isNew, "given twice, in line " + std::to_string(first->second) + " already");
        value.failIf(node_.IsMap() && value.node_.IsNull(), "has no value; give one, or leave the key out");
        value.checkKeys(depth + 1, places);
    }
}

std::vector<std::pair<std::string, YamlPlace>> YamlPlace::children() const
{
    std::vector<std::pair<std::string, YamlPlace>> places;
    const bool isList = node_.IsSequence();
    for (const auto& entry : node_)
    {
        failIf(!isList && !entry.first.IsScalar(), "a key must be a word");
        const std::string key = isList ? '[' + std::to_string(places.size() + 1) + ']' : entry.first.Scalar();
        const std::string name = name_ + (isList || name_.empty() ? "" : ".") + key;
        places.emplace_back(key, YamlPlace(isList ? YAML::Node(entry) : entry.second, file_, name));
    }
    return places;
}

std::string YamlPlace::where() const
{
    const int line = node_.Mark().line;
    return file_->string() + ":" + (line >= 0 ? std::to_string(line + 1) + ":" : "") + " "
           + (name_.empty() ? "" : name_ + ": ");
}

void YamlPlace::fail(const std::string& what) const
{
    throw StudyError(where() + what);
}

void YamlPlace::failIf(bool isWrong, const std::string& what) const
{
    if (isWrong)
    {
        fail(what);
    }
}

void YamlPlace::allow(const std::vector<std::string>& allowed) const
{
    for (const auto& [key, value] : map())
    {
        value.failIf(
            !contains(allowed, key), "unknown key" + didYouMean(key, allowed) + "; allowed here: " + listed(allowed));
    }
}

bool YamlPlace::has(const std::string& key) const
{
    return node_.IsMap() && node_[key].IsDefined() && !node_[key].IsNull();
}

YamlPlace YamlPlace::at(const std::string& key) const
{
    failIf(!has(key), "needs the key '" + key + "'");
    return {node_[key], file_, name_.empty() ? key : name_ + '.' + key};
}

YamlPlace YamlPlace::optional(const std::string& key) const
{
    return has(key) ? at(key) : YamlPlace(YAML::Node(YAML::NodeType::Undefined), file_, name_);
}

std::vector<YamlPlace> YamlPlace::list() const
{
    failIf(node_.IsDefined() && !node_.IsSequence(), "must be a list");
    return mapped(children(), [](const auto& child) { return child.second; });
}

std::vector<YamlPlace> YamlPlace::oneOrMore() const
{
    return node_.IsSequence() || !node_.IsDefined() ? list() : std::vector<YamlPlace>{*this};
}

std::vector<std::pair<std::string, YamlPlace>> YamlPlace::map() const
{
    failIf(node_.IsDefined() && !node_.IsMap(), "must be a map of 'key: value'");
    return children();
}

std::string YamlPlace::text() const
{
    failIf(!node_.IsScalar(), "must be a single value");
    return node_.Scalar();
}

double YamlPlace::number() const
{
    double value = 0.0;
    failIf(!node_.IsScalar() || !YAML::convert<double>::decode(node_, value) || !std::isfinite(value),
        "must be a number" + (node_.IsScalar() ? ", not '" + node_.Scalar() + "'" : ""));
    return value;
}

double YamlPlace::positive() const
{
    const double value = number();
    failIf(value <= 0.0, "must be above 0, not " + text());
    return value;
}

int YamlPlace::count(int smallest) const
{
    const double value = number();
    failIf(value != std::floor(value) || value < smallest || value > 1e9,
        "must be a whole number of at least " + std::to_string(smallest) + ", not " + text());
    return static_cast<int>(value);
}

bool YamlPlace::flag() const
{
    bool value = false;
    failIf(!node_.IsScalar() || !YAML::convert<bool>::decode(node_, value), "must be true or false");
    return value;
}

std::size_t YamlPlace::indexIn(const std::vector<std::string>& words) const
{
    const std::string word = text();
    failIf(!contains(words, word),
        "must be " + (words.empty() ? "left out" : listed(words)) + ", not '" + word + "'" + didYouMean(word, words));
    return std::find(words.begin(), words.end(), word) - words.begin();
}

std::string YamlPlace::oneOf(const std::vector<std::string>& words) const
{
    return words[indexIn(words)];
}

std::pair<double, double> YamlPlace::range(const std::string& what) const
{
    const auto ends = list();
    failIf(ends.size() != 2 || ends[0].number() >= ends[1].number(), "must be " + what);
    return {ends[0].number(), ends[1].number()};
}

std::filesystem::path YamlPlace::path() const
{
    return (std::filesystem::absolute(*file_).parent_path() / text()).lexically_normal();
}

} // namespace clepsydra::identification
