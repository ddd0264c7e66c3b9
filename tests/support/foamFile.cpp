#include "support/foamFile.h"

#include "tokens/exactText.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace clepsydra::tests
{

namespace
{

using Entries = std::vector<std::pair<std::string, std::string>>;

void writeEntries(std::ostream& os, const Entries& entries, const std::string& indent)
{
    std::vector<std::string> written;
    for (const auto& [path, value] : entries)
    {
        const std::size_t slash = path.find('/');
        const std::string name = path.substr(0, slash);
        if (slash == std::string::npos)
        {
            os << indent << name << ' ' << value << (!value.empty() && value.back() == '}' ? "\n" : ";\n");
        }
        else if (std::find(written.begin(), written.end(), name) == written.end())
        {
            written.push_back(name);
            Entries inner;
            for (const auto& [innerPath, innerValue] : entries)
            {
                if (innerPath.compare(0, slash + 1, name + '/') == 0)
                {
                    inner.emplace_back(innerPath.substr(slash + 1), innerValue);
                }
            }
            os << indent << name << '\n' << indent << "{\n";
            writeEntries(os, inner, indent + "    ");
            os << indent << "}\n";
        }
    }
}

} // namespace

FoamFile& FoamFile::set(const std::string& path, const std::string& value)
{
    const auto old = std::find_if(entries_.begin(), entries_.end(), [&](const auto& e) { return e.first == path; });
    if (old == entries_.end())
    {
        entries_.emplace_back(path, value);
    }
    else
    {
        old->second = value;
    }
    return *this;
}

FoamFile& FoamFile::set(const std::string& path, double value)
{
    return set(path, exactText(value));
}

FoamFile& FoamFile::remove(const std::string& path)
{
    const auto belongs = [&](const auto& entry) {
        return entry.first == path || entry.first.compare(0, path.size() + 1, path + '/') == 0;
    };
    entries_.erase(std::remove_if(entries_.begin(), entries_.end(), belongs), entries_.end());
    return *this;
}

std::string FoamFile::text(const std::string& object) const
{
    std::ostringstream os;
    os << "FoamFile { version 2.0; format ascii; class " << foamClass_ << "; object " << object << "; }\n\n";
    writeEntries(os, entries_, "");
    return os.str();
}

std::string vectorText(const Eigen::Vector3d& v)
{
    return '(' + exactText(v.x()) + ' ' + exactText(v.y()) + ' ' + exactText(v.z()) + ')';
}

Eigen::MatrixXd readInternalField(const std::filesystem::path& file)
{
    std::ifstream is(file);
    if (!is)
    {
        throw std::runtime_error("cannot read the field " + file.string());
    }
    std::string content{std::istreambuf_iterator<char>(is), std::istreambuf_iterator<char>()};
    const std::size_t entry = content.find("internalField");
    const std::size_t end = content.find(';', entry);
    if (entry == std::string::npos || end == std::string::npos)
    {
        throw std::runtime_error("no internalField in " + file.string());
    }
    content = content.substr(entry, end - entry);
    const bool isVector = content.find("nonuniform") == std::string::npos
                              ? content.find('(') != std::string::npos
                              : content.find("<vector>") != std::string::npos;
    const bool isUniform = content.find("nonuniform") == std::string::npos;

    // Words and brackets out of the way, what remains is [cell count] numbers.
    for (const char* word : {"internalField", "nonuniform", "uniform", "List<vector>", "List<scalar>"})
    {
        const std::size_t at = content.find(word);
        if (at != std::string::npos)
        {
            content.erase(at, std::string(word).size());
        }
    }
    std::replace_if(
        content.begin(), content.end(), [](char c) { return c == '(' || c == ')'; }, ' ');
    std::istringstream numbers(content);
    const Eigen::Index components = isVector ? 3 : 1;
    Eigen::Index cells = 1;
    if (!isUniform)
    {
        numbers >> cells;
    }
    Eigen::MatrixXd values(components, cells);
    for (Eigen::Index i = 0; i < values.size(); ++i)
    {
        if (!(numbers >> values.data()[i]))
        {
            throw std::runtime_error("not a plain ascii field: " + file.string());
        }
    }
    return values;
}

} // namespace clepsydra::tests
