#pragma once

#include "Time.H"
#include "argList.H"

#include <filesystem>

namespace clepsydra
{

class DemEngine;

/// The states of a run on disk, from which `startFrom latestTime` resumes.
///
/// A checkpoint of time t consists of OpenFOAM's fields and the state of function objects in <t>/ (or processor*/<t>/),
/// and of checkpoints/<t>/, which holds the particles and the manifest `complete`. The manifest is written last and
/// lists every file that a resumed run reads, with its checksum. A run that is killed while it writes therefore leaves
/// no manifest, and files that are damaged later are detected before they are read. With `latestTime` the run resumes
/// from the last complete checkpoint, and later times are set aside. Each rank writes a file of its own particles, and
/// any number of ranks can read them; to resume on another number of ranks, reconstruct and decompose the fields as
/// usual. Checkpoints of earlier versions, with one file for all particles, can be read, too.
class Checkpoints
{
public:
    /// Renames time folders that a killed run left unfinished to `unfinished.<t>` and, with `startFrom latestTime`,
    /// those of damaged checkpoints to `damaged.<t>`, so that OpenFOAM does not use them as the latest time. Call
    /// before Time is constructed. Collective. FatalError where all checkpoints are damaged.
    static void setAsideUnusable(const Foam::argList& args);

    /// Determines the start time of a case that must not be changed: the time that would be the latest after
    /// setAsideUnusable(). Empty where that would rename nothing, or where the start is not from the latest time.
    /// Collective. FatalError where all checkpoints are damaged.
    static Foam::word startInPlaceOfUnusable(const Foam::argList& args);

    /// FatalError where the start time has no complete checkpoint although the case has been run before. FatalIOError
    /// where purgeWrite would remove the last checkpoint before the next one is complete, and where files are
    /// compressed. Collective.
    /// \param writes  false where the case must not be changed
    explicit Checkpoints(const Foam::Time& time, bool writes = true);

    /// Name of the particles' files to resume from, relative to the case, as it was passed to
    /// DemEngine::writeCheckpoint(); empty for a fresh start.
    const std::filesystem::path& particles() const
    {
        return resumeFrom_;
    }

    bool resumed() const
    {
        return !resumeFrom_.empty();
    }

    /// Time of the fresh start of the run [s].
    double beginning() const
    {
        return beginning_;
    }

    /// Call before the fields of a write time are written: invalidates an earlier checkpoint of the same time.
    /// FatalError where the case directory is no longer in its place.
    void begin() const;

    /// Call after the fields of a write time have been written. Collective. FatalError where a file of the checkpoint
    /// is not completely on the disk.
    void complete(DemEngine& engine) const;

private:
    void startAfresh(bool writes);

    const Foam::Time& time_;
    std::filesystem::path resumeFrom_;
    double beginning_ = 0;
};

} // namespace clepsydra
