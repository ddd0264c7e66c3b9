#include "checkpoint/partsOfCase.h"

#include "files/wholeFile.h"

#include "IOobject.H"
#include "Pstream.H"
#include "fileOperation.H"

#include <fstream>
#include <regex>

namespace clepsydra
{

using namespace Foam;

namespace
{

namespace fs = std::filesystem;

/// processors4, or processors4_0-1 for the ranks 0 and 1 of 4.
const std::regex ofSeveralRanks("processors(\\d+)(?:_(\\d+)-(\\d+))?");

bool isRanksFolder(const std::string& name)
{
    return name.rfind("processor", 0) == 0;
}

std::string folderOf(const std::string& name)
{
    return name.substr(0, name.find('/'));
}

} // namespace

std::vector<std::string> foldersOfRanks(const fs::path& caseDirectory)
{
    std::vector<std::string> folders;
    for (const auto& entry : fs::directory_iterator(caseDirectory))
    {
        const std::string name = entry.path().filename().string();
        if (isRanksFolder(name) && entry.is_directory())
        {
            folders.push_back(name);
        }
    }
    return folders;
}

std::vector<std::string> partsOfThisRank(const fs::path& caseDirectory)
{
    if (!Pstream::parRun())
    {
        return {""};
    }
    std::vector<std::string> parts = {"processor" + std::to_string(Pstream::myProcNo()) + '/'};
    for (const std::string& folder : foldersOfRanks(caseDirectory))
    {
        std::smatch ranks;
        if (std::regex_match(folder, ranks, ofSeveralRanks) && std::stoi(ranks[1]) == Pstream::nProcs()
            && (!ranks[2].matched
                || (std::stoi(ranks[2]) <= Pstream::myProcNo() && Pstream::myProcNo() <= std::stoi(ranks[3]))))
        {
            parts.push_back(folder + '/');
        }
    }
    return parts;
}

bool isCollated(const std::string& name)
{
    return std::regex_match(folderOf(name), ofSeveralRanks);
}

int ranksOfFile(const std::string& name)
{
    const std::string folder = folderOf(name);
    std::smatch ranks;
    if (!std::regex_match(folder, ranks, ofSeveralRanks))
    {
        return 1;
    }
    return ranks[2].matched ? std::stoi(ranks[3]) - std::stoi(ranks[2]) + 1 : std::stoi(ranks[1]);
}

std::string nameInPart(const std::string& name)
{
    return isRanksFolder(name) ? name.substr(name.find('/') + 1) : name;
}

std::string writtenName(const Time& time, const word& name, const fileName& local)
{
    const IOobject object(name, time.timeName(), local, time, IOobject::NO_READ, IOobject::NO_WRITE, false);
    const fs::path file = std::string(fileHandler().objectPath(object, word::null));
    return file.lexically_relative(std::string(time.globalPath()));
}

bool writesItsPart(const Time& time)
{
    stringList parts(Pstream::nProcs());
    parts[Pstream::myProcNo()] = writtenName(time, "any", "");
    Pstream::gatherList(parts);
    Pstream::scatterList(parts);
    return parts.find(parts[Pstream::myProcNo()]) == Pstream::myProcNo();
}

void requireWholeBlocks(const fs::path& file, int blocks)
{
    const auto cut = [&] { return FileError(file.string() + " was not written to its end: is the disk full?"); };
    std::ifstream input(file, std::ios::binary);
    const std::streamoff size = static_cast<std::streamoff>(fs::file_size(file));
    static const std::regex beginning("// [Pp]rocessor\\d+");
    int found = 0;
    for (std::string line; found < blocks && std::getline(input, line);)
    {
        if (!std::regex_match(line, beginning))
        {
            continue;
        }
        std::streamoff length = 0;
        if (!(input >> length) || length < 0)
        {
            throw cut();
        }
        if (length > 0)
        {
            char opening = 0;
            char closing = 0;
            if (!(input >> opening) || opening != '(' || input.tellg() + length >= size
                || !input.seekg(length, std::ios::cur) || !input.get(closing) || closing != ')')
            {
                throw cut();
            }
        }
        ++found;
    }
    if (found != blocks)
    {
        throw cut();
    }
}

} // namespace clepsydra
