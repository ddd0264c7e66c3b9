#include "checkpoint/checkpoints.h"

#include "checkpoint/manifest.h"
#include "checkpoint/partsOfCase.h"
#include "engine/demEngine.h"
#include "files/fileSystemProbe.h"
#include "files/timeFolders.h"
#include "openfoam/compatibility.h"
#include "ranks.h"

#include "IFstream.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "fileOperation.H"
#include "functionObject.H"

#include <clepsydra/version.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iomanip>
#include <numeric>
#include <random>
#include <set>
#include <sstream>

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
/// Holds the time of the fresh start, whose fields are the user's own, and the identifier of the run.
const std::string beginningName("beginning");
const std::string runPrefix("run ");
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

/// The fresh start of a run.
struct Beginning
{
    /// Its name is empty where there was no fresh start.
    instant time;
    /// Empty where an earlier version has started the run.
    std::string run;
};

/// Collective.
Beginning beginningOf(const fileName& folder)
{
    const fileName file = folder / beginningName;
    string line;
    string run;
    if (Pstream::master() && isFile(file))
    {
        IFstream text(file);
        text.getLine(line);
        text.getLine(run);
    }
    Pstream::scatter(line);
    Pstream::scatter(run);
    scalar value = 0;
    if (!line.empty() && !readScalar(line, value))
    {
        FatalErrorInFunction << file << " holds '" << line.c_str() << "'; allowed: the time of the fresh start"
                             << exit(FatalError);
    }
    return {{value, line}, run.compare(0, runPrefix.size(), runPrefix) == 0 ? run.substr(runPrefix.size()) : string()};
}

/// The same on all ranks. Collective.
std::string randomIdentifier()
{
    string identifier;
    if (Pstream::master())
    {
        std::random_device random;
        std::ostringstream text;
        text << std::hex << std::setfill('0');
        for (int part = 0; part < 4; ++part)
        {
            text << std::setw(8) << random();
        }
        identifier = text.str();
    }
    Pstream::scatter(identifier);
    return identifier;
}

bool startsWith(const std::string& text, const std::string& beginning)
{
    return text.compare(0, beginning.size(), beginning) == 0;
}

bool isParticlesFile(const Manifest::File& file)
{
    return startsWith(file.name, folderName + '/');
}

/// Whether the file marks the fields of a time as half of a checkpoint.
bool isHalf(const Manifest::File& file)
{
    const std::string ending = '/' + halfFolder + '/' + halfName;
    return file.name.size() > ending.size()
           && file.name.compare(file.name.size() - ending.size(), ending.size(), ending) == 0;
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
        // The mark of the fields' half holds random identifiers, and reconstructPar and decomposePar copy it last.
        const auto isOfThisCheckpoint = [&](const std::string& part) {
            return Manifest::mismatch(caseDirectory, {part + name, file.contents}).empty();
        };
        if (isHalf(file) && std::none_of(parts.begin(), parts.end(), isOfThisCheckpoint))
        {
            return parts.front() + name
                   + " is not that of this checkpoint, so the fields in that folder are those of another run, or "
                     "older: run reconstructPar or decomposePar for this time";
        }
    }
    return {};
}

/// Why a checkpoint cannot be resumed from; empty where it can. Collective.
/// \param run  identifier of the run; empty where it has none
/// \param manifest  set to the checkpoint's manifest, where that can be read
std::string damageOf(
    const fileName& caseDirectory, const std::string& timeName, const std::string& run, Manifest& manifest)
{
    const fs::path folder(caseDirectory.c_str());
    std::string found;
    try
    {
        manifest = Manifest::read(folder / folderName / timeName / completeName);
        if (manifest.time != timeName)
        {
            found = "it has the manifest of time " + manifest.time;
        }
        else if (!run.empty() && !manifest.run.empty() && manifest.run != run)
        {
            found = "it is of another run (" + manifest.run + ") than " + folderName + '/' + beginningName + " (" + run
                    + ')';
        }
        else
        {
            found = mismatchOfShared(folder, manifest, isParticlesFile);
        }
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
    std::set<std::pair<scalar, word>> times;
    const std::string problem = problemOfRanks([&] {
        for (const fileName& part : Pstream::master() ? partsOf(caseDirectory) : fileNameList())
        {
            for (const TimeFolder& folder : timeFolders(std::string(part)))
            {
                if (folder.time > beginning)
                {
                    times.emplace(folder.time, folder.name);
                }
            }
        }
    });
    if (!problem.empty())
    {
        FatalErrorInFunction << problem.c_str() << exit(FatalError);
    }
    wordList names;
    std::for_each(times.rbegin(), times.rend(), [&](const auto& time) { names.append(time.second); });
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
                fileName aside = part / (prefix + timeName);
                for (int other = 2; isDir(aside); ++other)
                {
                    aside = part / (prefix + timeName + '-' + Foam::name(other));
                }
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

/// Lines of the manifest for the files to which this rank's engine appends, which are on the disk afterwards.
/// \throws FileError
std::string linesOfOutputs(const std::vector<EngineOutput>& outputs)
{
    std::string lines;
    for (const EngineOutput& output : outputs)
    {
        flushToDisk(output.file);
        lines += Manifest::outputLine({output.file.string(), output.size});
    }
    return lines;
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

/// FatalError where a checkpoint could not be written here, which would otherwise show when the first is due.
/// Collective.
void requireUsableFileSystem(const fileName& folder)
{
    const std::string problem = problemOfRanks(
        [&] { probeFileSystem(fs::path(folder.c_str()), "probe." + std::to_string(Pstream::myProcNo())); });
    if (!problem.empty())
    {
        FatalErrorInFunction << problem.c_str() << exit(FatalError);
    }
}

/// Syncs a folder and all folders in it, so that the names of new files are on the disk.
void flushTree(const fs::path& folder)
{
    flushToDisk(folder);
    for (const auto& entry : fs::recursive_directory_iterator(folder))
    {
        if (entry.is_directory() && !entry.is_symlink())
        {
            flushToDisk(entry.path());
        }
    }
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
    const Beginning beginning = beginningOf(folder);
    if (beginning.time.name().empty())
    {
        return found;
    }

    wordList finished;
    for (const word& time : writtenTimes(caseDirectory, beginning.time.value()))
    {
        const bool isFinished = returnReduce(isFile(folder / time / completeName), orOp<bool>());
        (isFinished ? finished : found.unfinished).append(time);
    }
    if (!startsFromLatestTime(caseDirectory))
    {
        return found;
    }
    found.latestUsable = beginning.time.name();
    for (const word& time : finished)
    {
        Manifest manifest;
        const std::string damage = damageOf(caseDirectory, time, beginning.run, manifest);
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
        Info << "Setting aside time " << time << " as unfinished." << time << ": it has no whole checkpoint, as where "
             << "the run was killed while it wrote it" << endl;
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

Checkpoints::Checkpoints(const Time& time, RunInputs inputs, bool writes)
    : time_(time),
      inputs_(std::move(inputs))
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
    const Beginning beginning = beginningOf(folder);
    const word start = time.timeName();
    if (beginning.time.name().empty() || beginning.time.name() == start)
    {
        startAfresh(writes);
        return;
    }
    beginning_ = beginning.time.value();
    run_ = beginning.run;
    Manifest manifest;
    const std::string damage = damageOf(time.globalPath(), start, run_, manifest);
    if (!damage.empty())
    {
        FatalErrorInFunction
            << "There is no complete checkpoint of time " << start << ": " << damage.c_str()
            << "\nThere are checkpoints of the times " << flatOutput(readDir(folder, fileName::DIRECTORY))
            << ": choose one by startTime in system/controlDict, or use startFrom latestTime. To start "
            << "afresh, remove the folder " << folder << " and all times after " << beginning.time.name()
            << exit(FatalError);
    }
    resumeFrom(manifest, writes);
}

void Checkpoints::resumeFrom(const Manifest& manifest, bool writes)
{
    const word start = time_.timeName();
    if (!manifest.run.empty())
    {
        if (const std::string change = inputs_.changeOfMesh(manifest); !change.empty())
        {
            FatalErrorInFunction << "The mesh is not that of the checkpoint of time " << start << ": " << change.c_str()
                                 << "; allowed: the mesh with which the run began. For another mesh, map the fields "
                                    "to a new case (mapFields) and start afresh there"
                                 << exit(FatalError);
        }
    }
    if (writes)
    {
        requireUsableFileSystem(time_.globalPath() / folderName);
    }
    const fs::path oldParticles = particlesOf(start) / oldParticlesName;
    const bool old = std::any_of(manifest.files.begin(), manifest.files.end(),
        [&](const Manifest::File& file) { return file.name == oldParticles.string(); });
    resumeFrom_ = old ? oldParticles : particlesOf(start) / particlesName;
    outputs_ = manifest.outputs;
    Info << "Resuming from the checkpoint of time " << start << nl << endl;
    warnOfChanges(manifest);
    if (run_.empty())
    {
        run_ = randomIdentifier();
        if (writes)
        {
            writeBeginning(beginningOf(time_.globalPath() / folderName).time.name());
        }
    }
}

void Checkpoints::warnOfChanges(const Manifest& manifest) const
{
    if (!Pstream::master())
    {
        return;
    }
    if (manifest.run.empty())
    {
        Info << "WARNING: this checkpoint was written by an earlier version, which did not record from which mesh, "
                "DEM script and dictionaries its run was made. Whether they are the same now is not known"
             << nl << endl;
        return;
    }
    const std::vector<std::string> changes = inputs_.changesOfFiles(manifest);
    if (!changes.empty())
    {
        Info << "WARNING: inputs have changed since the checkpoint was written, so that the resumed run differs "
                "from one that never stopped:";
        for (const std::string& change : changes)
        {
            Info << "\n    " << change.c_str();
        }
        Info << nl << endl;
    }
    for (const Manifest::Output& output : manifest.outputs)
    {
        std::error_code missing;
        const std::uintmax_t size = fs::file_size(time_.globalPath().c_str() / fs::path(output.name), missing);
        if (missing || size < output.size)
        {
            Info << "WARNING: " << output.name.c_str() << " has " << (missing ? 0 : size)
                 << " bytes, but the DEM engine had written " << output.size
                 << " before this checkpoint: was it edited, truncated or removed since then?" << nl << endl;
        }
    }
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
    run_ = randomIdentifier();
    if (writes)
    {
        if (Pstream::master())
        {
            mkDir(time_.globalPath() / folderName);
        }
        waitForAllRanks();
        requireUsableFileSystem(time_.globalPath() / folderName);
        writeBeginning(time_.timeName());
    }
}

void Checkpoints::writeBeginning(const word& startTime) const
{
    const std::string problem = problemOfRanks([&] {
        if (Pstream::master())
        {
            writeWhole(
                (time_.globalPath() / folderName / beginningName).c_str(), startTime + '\n' + runPrefix + run_ + '\n');
        }
    });
    if (!problem.empty())
    {
        FatalErrorInFunction << problem.c_str() << exit(FatalError);
    }
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

void Checkpoints::flushTables() const
{
    const fs::path folder((time_.globalPath() / functionObject::outputPrefix).c_str());
    if (!Pstream::master() || !fs::is_directory(folder))
    {
        return;
    }
    bool anyNew = false;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
    {
        if (entry.is_regular_file())
        {
            const fs::file_time_type changed = entry.last_write_time();
            const auto [before, isNew] = flushed_.try_emplace(entry.path(), changed);
            if (isNew || before->second != changed)
            {
                before->second = changed;
                flushToDisk(entry.path());
            }
            anyNew = anyNew || isNew;
        }
    }
    if (anyNew)
    {
        flushTree(folder);
    }
}

void Checkpoints::flushFolders(const fs::path& timeFolder) const
{
    const fs::path caseDirectory(time_.globalPath().c_str());
    if (!timeFolder.empty())
    {
        flushTree(caseDirectory / timeFolder);
        flushToDisk((caseDirectory / timeFolder).parent_path());
    }
    if (Pstream::master())
    {
        flushTree(caseDirectory / folderName / time_.timeName().c_str());
        flushToDisk(caseDirectory / folderName);
        flushToDisk(caseDirectory);
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
    const std::string identifier = randomIdentifier();
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
                writeWhole(caseDirectory / half, "The particles of this time are in the case's folder " + folderName
                                                     + '/' + timeName + ".\n" + runPrefix + run_ + "\ncheckpoint "
                                                     + identifier + '\n');
            }
        },
        [&] { particles = engine.writeCheckpoint(particlesOf(timeName) / particlesName); },
        [&] {
            if (writesFields)
            {
                requireFunctionState(time_);
            }
            linesOfRanks[Pstream::myProcNo()] = linesOfOutputs(engine.outputs()) + inputs_.lines()
                                                + linesOfThisRank(caseDirectory, timeFolder, particles);
        },
        // What the manifest names is on the disk before the manifest itself, also after a loss of power.
        [&] {
            flushTables();
            flushFolders(timeFolder);
        },
        [&] {
            Pstream::gatherList(linesOfRanks);
            if (Pstream::master())
            {
                const Manifest manifest{timeName, Pstream::nProcs(), gitCommit, run_, inputs_.mesh(), {}, {}, {}};
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
                             << "\nWith `startFrom latestTime` the same command resumes from the previous checkpoint"
                             << exit(FatalError);
    }
    if (Pstream::master() && time_.controlDict().getOrDefault<label>("purgeWrite", 0) > 0)
    {
        removeParticlesWithoutFields(time_.globalPath());
    }
}

} // namespace clepsydra
