#include "checkpoint/checkpoints.h"

#include "engine/demEngine.h"

#include "IFstream.H"
#include "OFstream.H"
#include "OSspecific.H"
#include "Pstream.H"

#include <clepsydra/version.h>

namespace clepsydra
{

using namespace Foam;

namespace
{

const word folderName("checkpoints");
const word completeName("complete");
const word beadsName("beads.restart");
/// Holds the time of the fresh start, whose fields are the user's own.
const word beginningName("beginning");

bool isComplete(const fileName& checkpoint)
{
    return isFile(checkpoint / completeName);
}

/// The case's own folder and those of the ranks.
fileNameList partsOf(const fileName& caseDirectory)
{
    fileNameList parts(1, caseDirectory);
    for (const fileName& folder : readDir(caseDirectory, fileName::DIRECTORY))
    {
        if (folder.starts_with("processor"))
        {
            parts.append(caseDirectory / folder);
        }
    }
    return parts;
}

/// The name of the time of the fresh start; empty before there was one.
word beginningOf(const fileName& folder)
{
    string line;
    if (isFile(folder / beginningName))
    {
        IFstream(folder / beginningName).getLine(line);
    }
    return word(line);
}

/// No rank goes on before the others have come here: OpenFOAM has no barrier but a reduction.
void waitForAllRanks()
{
    label nothing = 0;
    reduce(nothing, sumOp<label>());
}

void setAside(const fileName& part, const word& timeName)
{
    const fileName aside = part / ("unfinished." + timeName);
    rmDir(aside, true);
    mv(part / timeName, aside);
}

} // namespace

void Checkpoints::setAsideUnfinished(const argList& args)
{
    const fileName caseDirectory = args.globalPath();
    const fileName folder = caseDirectory / folderName;
    const word beginning = beginningOf(folder);
    if (Pstream::master() && !beginning.empty())
    {
        for (const fileName& part : partsOf(caseDirectory))
        {
            for (const instant& time : Time::findTimes(part))
            {
                if (time.name() != "constant" && time.name() != beginning && !isComplete(folder / time.name()))
                {
                    Info << "Setting aside " << part.name() / time.name()
                         << ": the run was ended while it wrote this time" << endl;
                    setAside(part, time.name());
                }
            }
        }
    }
    waitForAllRanks();
}

Checkpoints::Checkpoints(const Time& time)
    : time_(time)
{
    const fileName folder = time.globalPath() / folderName;
    const fileName checkpoint = folder / time.timeName();
    if (isComplete(checkpoint))
    {
        resumeFrom_ = (checkpoint / beadsName).c_str();
        Info << "Resuming from the checkpoint of time " << time.timeName() << nl << endl;
        return;
    }
    const word beginning = beginningOf(folder);
    if (!beginning.empty() && beginning != time.timeName())
    {
        FatalErrorInFunction << "There is no complete checkpoint of time " << time.timeName() << " in " << folder
                             << "; it has those of times " << flatOutput(readDir(folder, fileName::DIRECTORY))
                             << ". Choose one of them by startTime in system/controlDict, or remove " << folder
                             << " to start afresh" << exit(FatalError);
    }
    waitForAllRanks();
    if (Pstream::master())
    {
        mkDir(folder);
        OFstream file(folder / beginningName);
        file << time.timeName() << nl;
    }
}

void Checkpoints::begin() const
{
    if (Pstream::master())
    {
        rm(time_.globalPath() / folderName / time_.timeName() / completeName);
    }
}

void Checkpoints::complete(DemEngine& engine) const
{
    const fileName checkpoint = time_.globalPath() / folderName / time_.timeName();
    if (Pstream::master())
    {
        mkDir(checkpoint);
    }
    // Collective, and with a barrier at its end: all ranks' fields are on disk then, too.
    engine.writeCheckpoint((checkpoint / beadsName).c_str());
    if (Pstream::master())
    {
        const fileName marker = checkpoint / completeName;
        {
            OFstream unfinished(marker + ".unfinished");
            unfinished << "time " << time_.timeName() << nl << "ranks " << Pstream::nProcs() << nl << "commit "
                       << gitCommit << nl;
        }
        mv(marker + ".unfinished", marker);
    }
}

} // namespace clepsydra
