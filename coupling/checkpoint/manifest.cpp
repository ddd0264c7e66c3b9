#include "checkpoint/manifest.h"

#include "tokens/exactText.h"

#include <sstream>

namespace clepsydra
{

namespace
{

const std::string runWord = "run";
const std::string meshWord = "mesh";
const std::string inputWord = "input";
const std::string outputWord = "output";
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

/// The rest of a line, without the space before it.
std::string restOf(std::istream& line)
{
    std::string rest;
    line.ignore();
    std::getline(line, rest);
    return rest;
}

void readLine(Manifest& manifest, const std::string& text)
{
    std::istringstream line(text);
    std::string first;
    line >> first;
    if (first == runWord)
    {
        line >> manifest.run;
    }
    else if (first == meshWord)
    {
        line >> manifest.mesh.cells >> manifest.mesh.volume >> manifest.mesh.squaredVolume;
    }
    else if (first == outputWord)
    {
        Manifest::Output output;
        line >> output.size;
        output.name = restOf(line);
        manifest.outputs.push_back(output);
    }
    else
    {
        const bool isInput = first == inputWord;
        Manifest::File file;
        file.contents.sha256 = first;
        if (isInput)
        {
            line >> file.contents.sha256;
        }
        line >> file.contents.size;
        file.name = restOf(line);
        (isInput ? manifest.inputs : manifest.files).push_back(file);
    }
}

} // namespace

std::string Manifest::line(const File& file)
{
    return file.contents.sha256 + ' ' + std::to_string(file.contents.size) + ' ' + file.name + '\n';
}

std::string Manifest::inputLine(const File& file)
{
    return inputWord + ' ' + line(file);
}

std::string Manifest::outputLine(const Output& file)
{
    return outputWord + ' ' + std::to_string(file.size) + ' ' + file.name + '\n';
}

std::string Manifest::text(const std::string& lines) const
{
    const std::string body = "time " + time + "\nranks " + std::to_string(ranks) + "\ncommit " + commit + '\n' + runWord
                             + ' ' + run + '\n' + meshWord + ' ' + std::to_string(mesh.cells) + ' '
                             + exactText(mesh.volume) + ' ' + exactText(mesh.squaredVolume) + '\n' + lines;
    return body + lastWord + sha256(body) + '\n';
}

Manifest Manifest::read(const std::filesystem::path& file)
{
    const std::string text = textOf(file);
    if (text.empty())
    {
        throw FileError(file.string() + " is empty");
    }
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
    for (std::string line; std::getline(lines >> std::ws, line);)
    {
        readLine(manifest, line);
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
