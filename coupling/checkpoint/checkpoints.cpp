#include "checkpoint/checkpoints.h"

#include "checkpoint/manifest.h"
#include "checkpoint/partsOfCase.h"
#include "engine/demEngine.h"
#include "files/timeFolders.h"
#include "openfoam/compatibility.h"
#include "ranks.h"

#include "IFstream.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "fileOperation.H"

#include <clepsydra/version.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <numeric>
#include <set>

namespace clepsydra
{

using namespace Foam;

namespace
{

namespace fs = std::filesystem;

const std::string folderName("checkpoints");
const std::string completeName("complete");
/// A file for each rank, see DemEngine::writeCheckpoint().
const std::string particlesName("particles.%.restart");
/// File with the particles of all ranks in checkpoints of earlier versions.
const std::string oldParticlesName("particles.restart");
/// Holds the time of the fresh start, whose fields are the user's own.
const std::string beginningName("beginning");
/// Marks each time folder that this program has written as half of a checkpoint.
const word halfName("checkpoint");
const fileName halfFolder("uniform");

/// The case's own folder and those of the ranks.
fileNameList partsOf(const fileName& caseDirectory)
{
    fileNameList parts(1, caseDirectory);
    for (const std::string& folder : foldersOfRanks(std::string(caseDirectory)))
    {
        parts.append(caseDirectory / folder);
    }
    return parts;
}

/// Time of the fresh start; its name is empty where there was none. Collective.
instant beginningOf(const fileName& folder)
{
    const fileName file = folder / beginningName;
    string line;
    if (Pstream::master() && isFile(file))
    {
        IFstream(file).getLine(line);
    }
    Pstream::scatter(line);
    scalar value = 0;
    if (!line.empty() && !readScalar(line, value))
    {
        FatalErrorInFunction << file << " holds '" << line.c_str() << "'; allowed: the time of the fresh start"
                             << exit(FatalError);
    }
    return {value, line};
}

bool startsWith(const std::string& text, const std::string& beginning)
{
    return text.compare(0, beginning.size(), beginning) == 0;
}

bool isParticlesFile(const Manifest::File& file)
{
    return startsWith(file.name, folderName + '/');
}

/// Folder of the particles, relative to the case directory in which the program runs. In an absolute path LIGGGHTS
/// would replace a `%` by the rank.
fs::path particlesOf(const std::string& timeName)
{
    return fs::path(folderName) / timeName;
}

/// Error that this rank finds in files of which none belongs to a single rank. They are divided evenly between the
/// ranks, whichever ranks have written them.
template<class IsOfThese>
std::string mismatchOfShared(const fs::path& caseDirectory, const Manifest& manifest, const IsOfThese& isOfThese)
{
    int turn = 0;
    for (const Manifest::File& file : manifest.files)
    {
        if (isOfThese(file) && turn++ % Pstream::nProcs() == Pstream::myProcNo())
        {
            if (std::string found = Manifest::mismatch(caseDirectory, file); !found.empty())
            {
                return found;
            }
        }
    }
    return {};
}

/// Error that this rank finds in the fields of a checkpoint that was written on the same number of ranks.
std::string mismatchHere(const fs::path& caseDirectory, const Manifest& manifest)
{
    const std::string own = partsOfThisRank(caseDirectory).front();
    for (const Manifest::File& file : manifest.files)
    {
        if (!isParticlesFile(file) && startsWith(file.name, own))
        {
            if (std::string found = Manifest::mismatch(caseDirectory, file); !found.empty())
            {
                return found;
            }
        }
    }
    return mismatchOfShared(caseDirectory, manifest,
        [](const Manifest::File& file) { return !isParticlesFile(file) && isCollated(file.name); });
}

/// Error in the fields of a checkpoint that was written on another number of ranks. The fields are those that
/// reconstructPar or decomposePar has created: all must exist, and those that remain of the original ones must be as
/// they were written.
std::string mismatchAfterRedistribution(const fs::path& caseDirectory, const Manifest& manifest)
{
    const std::vector<std::string> parts = partsOfThisRank(caseDirectory);
    for (const Manifest::File& file : manifest.files)
    {
        if (isParticlesFile(file))
        {
            continue;
        }
        const bool ofRank = startsWith(file.name, "processor");
        // From several ranks to several others, decomposePar has replaced the file.
        const bool replaced = ofRank && Pstream::parRun();
        if (Pstream::master() && !replaced && fs::exists(caseDirectory / file.name))
        {
            if (std::string found = Manifest::mismatch(caseDirectory, file); !found.empty())
            {
                return found;
            }
        }
        const std::string name = nameInPart(file.name);
        const bool isHere = std::any_of(parts.begin(), parts.end(), [&](const std::string& part) {
            std::error_code missing;
            return fs::file_size(caseDirectory / (part + name), missing) > 0 && !missing;
        });
        if (!isHere)
        {
            return parts.front() + name + " is missing or empty (made from " + file.name + ')';
        }
    }
    return {};
}

/// Why a checkpoint cannot be resumed from; empty where it can. Collective.
/// \param manifest  set to the checkpoint's manifest, where that can be read
std::string damageOf(const fileName& caseDirectory, const std::string& timeName, Manifest& manifest)
{
    const fs::path folder(caseDirectory.c_str());
    std::string found;
    try
    {
        manifest = Manifest::read(folder / folderName / timeName / completeName);
        found = manifest.time != timeName ? "it has the manifest of time " + manifest.time
                                          : mismatchOfShared(folder, manifest, isParticlesFile);
        if (found.empty())
        {
            found = manifest.ranks == Pstream::nProcs() ? mismatchHere(folder, manifest)
                                                        : mismatchAfterRedistribution(folder, manifest);
        }
    }
    catch (const std::runtime_error& error)
    {
        found = error.what();
    }
    return firstOfRanks(found);
}

/// Times after the fresh start that a run has written, the latest first. Collective; the same on all ranks.
wordList writtenTimes(const fileName& caseDirectory, scalar beginning)
{
    wordList names;
    if (Pstream::master())
    {
        std::set<std::pair<scalar, word>> times;
        for (const fileName& part : partsOf(caseDirectory))
        {
            for (const TimeFolder& folder : timeFolders(std::string(part)))
            {
                if (folder.time > beginning)
                {
                    times.emplace(folder.time, folder.name);
                }
            }
        }
        std::for_each(times.rbegin(), times.rend(), [&](const auto& time) { names.append(time.second); });
    }
    Pstream::scatter(names);
    return names;
}

void setAside(const fileName& caseDirectory, const word& timeName, const std::string& prefix)
{
    if (Pstream::master())
    {
        for (const fileName& part : partsOf(caseDirectory))
        {
            if (isDir(part / timeName))
            {
                const fileName aside = part / (prefix + timeName);
                rmDir(aside, true);
                mv(part / timeName, aside);
            }
        }
    }
    waitForAllRanks();
}

bool startsFromLatestTime(const fileName& caseDirectory)
{
    IFstream file(caseDirectory / "system/controlDict");
    return dictionary(file).getOrDefault<word>("startFrom", "latestTime") == "latestTime";
}

/// Removes the particles of checkpoints whose fields OpenFOAM's purgeWrite has removed.
void removeParticlesWithoutFields(const fileName& caseDirectory)
{
    const fileNameList parts = partsOf(caseDirectory);
    for (const fileName& time : readDir(caseDirectory / folderName, fileName::DIRECTORY))
    {
        if (std::none_of(parts.begin(), parts.end(), [&](const fileName& part) { return isDir(part / time); }))
        {
            rmDir(caseDirectory / folderName / time);
        }
    }
}

/// A FoamFile ends with a line after which nothing is written. Where it is missing, the disk was full. A file of
/// several ranks is a FoamFile that ends with the block of the last rank.
/// \param ranks  number of ranks that share the file
void requireWholeFoamFile(const fs::path& file, int ranks)
{
    constexpr std::streamoff headerSize = 2000;
    constexpr std::streamoff footerSize = 200;
    std::ifstream input(file, std::ios::binary);
    const auto size = static_cast<std::streamoff>(fs::file_size(file));
    const auto textFrom = [&](std::streamoff start, std::streamoff length) {
        std::string text(static_cast<std::size_t>(std::min(length, size)), '\0');
        input.seekg(std::max<std::streamoff>(start, 0));
        input.read(text.data(), static_cast<std::streamsize>(text.size()));
        return text;
    };
    const std::string header = textFrom(0, headerSize);
    if (header.find("decomposedBlockData") != std::string::npos)
    {
        requireWholeBlocks(file, ranks);
        return;
    }
    const bool isFoamFile = header.find("FoamFile") != std::string::npos;
    if (size == 0 || (isFoamFile && textFrom(size - footerSize, footerSize).find("// ****") == std::string::npos))
    {
        throw FileError(file.string() + " was not written to its end: is the disk full?");
    }
}

/// Time::write() does not report whether this file could be created.
void requireFunctionState(const Time& time)
{
    const fileName file = time.globalPath() / writtenName(time, "functionObjectProperties", "uniform/functionObjects");
    if (!functionObjectState(time).empty() && !isFile(file))
    {
        throw FileError(file + " could not be made");
    }
}

/// Lines of the manifest for the files that this rank has written. \throws FileError
/// \param timeFolder  that of the fields which this rank has written, relative to the case; empty where another rank has
/// \param particles  files of the particles, relative to the case
std::string linesOfThisRank(
    const fs::path& caseDirectory, const fs::path& timeFolder, const std::vector<fs::path>& particles)
{
    std::vector<std::string> names;
    if (!timeFolder.empty())
    {
        for (const auto& entry : fs::recursive_directory_iterator(caseDirectory / timeFolder))
        {
            if (entry.is_regular_file())
            {
                // Not fs::relative(), which would resolve a processor folder that is a symbolic link.
                names.push_back(entry.path().lexically_relative(caseDirectory));
            }
        }
    }
    names.insert(names.end(), particles.begin(), particles.end());
    std::sort(names.begin(), names.end());
    std::string lines;
    for (const std::string& name : names)
    {
        requireWholeFoamFile(caseDirectory / name, ranksOfFile(name));
        flushToDisk(caseDirectory / name);
        lines += Manifest::line({name, contentsOf(caseDirectory / name)});
    }
    return lines;
}

/// Times that a start must not use as the latest time, the latest first.
struct UnusableTimes
{
    wordList unfinished;
    /// Only with `startFrom latestTime`.
    wordList damaged;
    std::string damages;
    /// The latest time without these; empty without `startFrom latestTime`.
    word latestUsable;

    bool areThere() const
    {
        return !unfinished.empty() || !damaged.empty();
    }
};

/// Collective. FatalError where all checkpoints are damaged.
UnusableTimes unusableTimes(const fileName& caseDirectory)
{
    UnusableTimes found;
    const fileName folder = caseDirectory / folderName;
    const instant beginning = beginningOf(folder);
    if (beginning.name().empty())
    {
        return found;
    }

    wordList finished;
    for (const word& time : writtenTimes(caseDirectory, beginning.value()))
    {
        const bool isFinished = returnReduce(isFile(folder / time / completeName), orOp<bool>());
        (isFinished ? finished : found.unfinished).append(time);
    }
    if (!startsFromLatestTime(caseDirectory))
    {
        return found;
    }
    found.latestUsable = beginning.name();
    for (const word& time : finished)
    {
        Manifest manifest;
        const std::string damage = damageOf(caseDirectory, time, manifest);
        if (damage.empty())
        {
            found.latestUsable = time;
            return found;
        }
        found.damaged.append(time);
        found.damages += "\n    time " + time + ": " + damage;
    }
    if (!finished.empty())
    {
        FatalErrorInFunction << "No checkpoint of this case can be resumed from:" << found.damages.c_str()
                             << "\nTo start afresh, remove the folder " << folder << " and the times "
                             << flatOutput(finished) << exit(FatalError);
    }
    return found;
}

} // namespace

void Checkpoints::setAsideUnusable(const argList& args)
{
    const fileName caseDirectory = args.globalPath();
    const UnusableTimes found = unusableTimes(caseDirectory);
    for (const word& time : found.unfinished)
    {
        Info << "Setting aside time " << time << ": the run ended while it was being written" << endl;
        setAside(caseDirectory, time, "unfinished.");
    }
    for (const word& time : found.damaged)
    {
        setAside(caseDirectory, time, "damaged.");
    }
    if (!found.damaged.empty())
    {
        Info << "WARNING: damaged checkpoints, set aside as damaged.<time>:" << found.damages.c_str()
             << "\n    resuming from the last complete one, time " << found.latestUsable << nl << endl;
    }
}

word Checkpoints::startInPlaceOfUnusable(const argList& args)
{
    const UnusableTimes found = unusableTimes(args.globalPath());
    if (!found.areThere() || found.latestUsable.empty())
    {
        return word();
    }
    Info << "WARNING: a start sets aside unfinished times, " << flatOutput(found.unfinished) << ", and damaged ones, "
         << flatOutput(found.damaged) << found.damages.c_str() << "\n    and resumes from time " << found.latestUsable
         << nl << endl;
    return found.latestUsable;
}

Checkpoints::Checkpoints(const Time& time, bool writes)
    : time_(time)
{
    if (time.controlDict().getOrDefault<label>("purgeWrite", 0) == 1)
    {
        FatalIOErrorInFunction(time.controlDict()) << "Entry 'purgeWrite' is 1; allowed: 0 for all times, or at least "
                                                      "2, because the last one is removed before the "
                                                   << "next is complete" << exit(FatalIOError);
    }
    // OpenFOAM's stream does not report that the disk was full for a compressed file, and requireWholeFoamFile() cannot
    // read its end. With `writeFormat binary` OpenFOAM compresses nothing.
    if (time.writeCompression() == IOstream::COMPRESSED)
    {
        FatalIOErrorInFunction(time.controlDict())
            << "Entry 'writeCompression' is " << time.controlDict().get<word>("writeCompression")
            << "; allowed: off, because a compressed file that a full disk has truncated could not be detected"
            << exit(FatalIOError);
    }

    const fileName folder = time.globalPath() / folderName;
    const instant beginning = beginningOf(folder);
    const word start = time.timeName();
    if (beginning.name().empty() || beginning.name() == start)
    {
        startAfresh(writes);
        return;
    }
    beginning_ = beginning.value();
    Manifest manifest;
    const std::string damage = damageOf(time.globalPath(), start, manifest);
    if (!damage.empty())
    {
        FatalErrorInFunction
            << "There is no complete checkpoint of time " << start << ": " << damage.c_str()
            << "\nThere are checkpoints of the times " << flatOutput(readDir(folder, fileName::DIRECTORY))
            << ": choose one by startTime in system/controlDict, or use startFrom latestTime. To start "
            << "afresh, remove the folder " << folder << " and all times after " << beginning.name()
            << exit(FatalError);
    }
    const fs::path oldParticles = particlesOf(start) / oldParticlesName;
    const bool old = std::any_of(manifest.files.begin(), manifest.files.end(),
        [&](const Manifest::File& file) { return file.name == oldParticles.string(); });
    resumeFrom_ = old ? oldParticles : particlesOf(start) / particlesName;
    Info << "Resuming from the checkpoint of time " << start << nl << endl;
}

void Checkpoints::startAfresh(bool writes)
{
    const fileNameList parts = partsOf(time_.globalPath());
    const bool isHalf = std::any_of(parts.begin(), parts.end(),
        [&](const fileName& part) { return isFile(part / time_.timeName() / halfFolder / halfName); });
    if (returnReduce(isHalf, orOp<bool>()))
    {
        FatalErrorInFunction
            << "The fields of time " << time_.timeName() << " are half of a checkpoint whose other half, "
            << "the particles, is missing in " << time_.globalPath() / folderName
            << ". To start afresh, remove that time and all others that were written, or copy the files that "
            << "you want to keep into a new case" << exit(FatalError);
    }
    beginning_ = time_.value();
    if (writes && Pstream::master())
    {
        mkDir(time_.globalPath() / folderName);
        try
        {
            writeWhole((time_.globalPath() / folderName / beginningName).c_str(), time_.timeName() + '\n');
        }
        catch (const FileError& error)
        {
            FatalErrorInFunction << error.what() << exit(FatalError);
        }
    }
    waitForAllRanks();
}

void Checkpoints::begin() const
{
    if (Pstream::master())
    {
        // OpenFOAM would create the folders again, and the run would end in an unexpected place.
        if (!isFile(time_.globalPath() / folderName / beginningName))
        {
            FatalErrorInFunction << "There is no " << time_.globalPath() / folderName / beginningName
                                 << " any more: was the case moved or removed while the run was in progress?"
                                 << exit(FatalError);
        }
        const fileName earlier = time_.globalPath() / folderName / time_.timeName();
        rm(earlier / completeName);
        // It may be from a run on more ranks.
        rmDir(earlier, true);
    }
}

void Checkpoints::complete(DemEngine& engine) const
{
    const fs::path caseDirectory(time_.globalPath().c_str());
    const std::string timeName = time_.timeName();
    const fs::path checkpoint = caseDirectory / folderName / timeName;
    if (Pstream::master())
    {
        mkDir(checkpoint.c_str());
    }
    const bool writesFields = writesItsPart(time_);
    const fs::path half = writtenName(time_, halfName, halfFolder);
    const fs::path timeFolder = writesFields ? half.parent_path().parent_path() : fs::path();
    std::vector<fs::path> particles;
    List<string> linesOfRanks(Pstream::nProcs());
    const std::function<void()> steps[] = {
        [&] {
            // A thread of the file handler may still be writing.
            fileHandler().flush();
            if (writesFields)
            {
                fs::create_directories((caseDirectory / half).parent_path());
                writeWhole(caseDirectory / half,
                    "The particles of this time are in the case's folder " + folderName + '/' + timeName + ".\n");
            }
        },
        [&] { particles = engine.writeCheckpoint(particlesOf(timeName) / particlesName); },
        [&] {
            if (writesFields)
            {
                requireFunctionState(time_);
            }
            linesOfRanks[Pstream::myProcNo()] = linesOfThisRank(caseDirectory, timeFolder, particles);
        },
        [&] {
            Pstream::gatherList(linesOfRanks);
            if (Pstream::master())
            {
                const Manifest manifest{timeName, Pstream::nProcs(), gitCommit, {}};
                writeWhole(checkpoint / completeName,
                    manifest.text(std::accumulate(linesOfRanks.begin(), linesOfRanks.end(), std::string())));
            }
        },
    };
    // No rank starts a step before all ranks have completed the previous one, and none continues after an error on
    // another.
    std::string problem;
    for (const std::function<void()>& step : steps)
    {
        if (problem.empty())
        {
            problem = problemOfRanks(step);
        }
    }
    if (!problem.empty())
    {
        FatalErrorInFunction << "The checkpoint of time " << timeName << " could not be written: " << problem.c_str()
                             << "\nThe same command resumes from the previous checkpoint" << exit(FatalError);
    }
    if (Pstream::master() && time_.controlDict().getOrDefault<label>("purgeWrite", 0) > 0)
    {
        removeParticlesWithoutFields(time_.globalPath());
    }
}

} // namespace clepsydra
