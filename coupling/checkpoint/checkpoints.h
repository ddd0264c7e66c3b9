#pragma once

#include "checkpoint/manifest.h"
#include "checkpoint/runInputs.h"

#include "Time.H"
#include "argList.H"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

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
/// usual. Checkpoints of earlier versions, with one file for all particles or without the identifier of their run, can
/// be read, too.
///
/// Each run has a random identifier, which `checkpoints/beginning`, the manifests and the fields' half of each
/// checkpoint hold, so that nothing is put together from two runs.
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

    /// FatalError where the start time has no complete checkpoint although the case has been run before, where the mesh
    /// is not that of the checkpoint, and where the file system cannot hold a checkpoint; a warning that names them
    /// where other inputs have changed. FatalIOError where purgeWrite would remove the last checkpoint before the next
    /// one is complete, and where files are compressed. Collective.
    /// \param writes  false where the case must not be changed
    Checkpoints(const Foam::Time& time, RunInputs inputs, bool writes = true);

    /// Name of the particles' files to resume from, relative to the case, as it was passed to
    /// DemEngine::writeCheckpoint(); empty for a fresh start.
    const std::filesystem::path& particles() const
    {
        return resumeFrom_;
    }

    /// The files to which the DEM engine had appended, of all ranks, with their sizes at the checkpoint.
    const std::vector<Manifest::Output>& outputs() const
    {
        return outputs_;
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
    void resumeFrom(const Manifest& manifest, bool writes);
    void warnOfChanges(const Manifest& manifest) const;
    void writeBeginning(const Foam::word& startTime) const;
    void flushTables() const;
    /// \param timeFolder  the fields' folder, relative to the case; empty where another rank has written it
    void flushFolders(const std::filesystem::path& timeFolder) const;

    const Foam::Time& time_;
    const RunInputs inputs_;
    std::filesystem::path resumeFrom_;
    std::vector<Manifest::Output> outputs_;
    double beginning_ = 0;
    /// The random identifier of the run.
    std::string run_;
    /// Tables that are on the disk, with the time of their last change then.
    mutable std::map<std::filesystem::path, std::filesystem::file_time_type> flushed_;
};

} // namespace clepsydra
