#include "checkpoint/manifest.h"

#include <fstream>
#include <sstream>

namespace clepsydra
{

namespace
{

const std::string lastWord = "end ";

/// The value of a line "<name> <value>".
template<class Value>
Value entry(std::istream& lines, const std::string& name, const std::filesystem::path& file)
{
    std::string found;
    Value value{};
    if (!(lines >> found >> value) || found != name)
    {
        throw FileError(file.string() + " has no entry '" + name + "'");
    }
    return value;
}

} // namespace

std::string Manifest::line(const File& file)
{
    return file.contents.sha256 + ' ' + std::to_string(file.contents.size) + ' ' + file.name + '\n';
}

std::string Manifest::text(const std::string& fileLines) const
{
    const std::string lines =
        "time " + time + "\nranks " + std::to_string(ranks) + "\ncommit " + commit + '\n' + fileLines;
    return lines + lastWord + sha256(lines) + '\n';
}

Manifest Manifest::read(const std::filesystem::path& file)
{
    std::ifstream input(file);
    std::ostringstream all;
    all << input.rdbuf();
    if (!input)
    {
        throw FileError(file.string() + " cannot be read, or is empty");
    }
    const std::string text = all.str();
    const std::size_t end = text.rfind('\n' + lastWord);
    const std::string body = end == std::string::npos ? "" : text.substr(0, end + 1);
    if (body.empty() || text != body + lastWord + sha256(body) + '\n')
    {
        throw FileError(file.string() + " is damaged");
    }
    std::istringstream lines(body);
    Manifest manifest;
    manifest.time = entry<std::string>(lines, "time", file);
    manifest.ranks = entry<int>(lines, "ranks", file);
    manifest.commit = entry<std::string>(lines, "commit", file);
    for (File listed;
         lines >> listed.contents.sha256 >> listed.contents.size && lines.ignore() && std::getline(lines, listed.name);)
    {
        manifest.files.push_back(listed);
    }
    return manifest;
}

std::string Manifest::mismatch(const std::filesystem::path& caseDirectory, const File& file)
{
    if (!std::filesystem::exists(caseDirectory / file.name))
    {
        return file.name + " is missing";
    }
    try
    {
        return contentsOf(caseDirectory / file.name) == file.contents
                   ? ""
                   : file.name + " is not what this run wrote: damaged, exchanged or edited";
    }
    catch (const FileError& error)
    {
        return error.what();
    }
}

} // namespace clepsydra
