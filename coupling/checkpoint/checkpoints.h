#pragma once

#include "Time.H"
#include "argList.H"

#include <filesystem>

namespace clepsydra
{

class DemEngine;

/// The states of a run on disk, from which `startFrom latestTime` goes on.
///
/// A checkpoint of time t is OpenFOAM's fields and the state of function objects in <t>/ (or processor*/<t>/), together
/// with checkpoints/<t>/, which holds the particles and, written last, the manifest `complete`: every file that a resume
/// reads, with its checksum. So a run that is killed while it writes leaves no manifest, and what is damaged later is
/// found before it is read. With `latestTime` the run then goes on from the last checkpoint that is whole, and sets aside
/// what is later. Each rank writes a file of its own particles, and any number of ranks can read them: to go on with another
/// number, reconstruct and decompose the fields as ever. A checkpoint of one file with all particles, as they were, is read, too.
class Checkpoints
{
public:
    /// Renames time folders that a killed run left unfinished to `unfinished.<t>` and, with `startFrom latestTime`, those
    /// of damaged checkpoints to `damaged.<t>`, so that OpenFOAM does not take them for the latest time. Call before Time
    /// is constructed. Collective. FatalError where all checkpoints are damaged.
    static void setAsideUnusable(const Foam::argList& args);

    /// For a case that must stay as it is: the time that would be the latest if setAsideUnusable() had been called; empty
    /// where it would rename nothing, or the start is not from the latest. Collective. FatalError as there.
    static Foam::word startInPlaceOfUnusable(const Foam::argList& args);

    /// FatalError if the start time has no whole checkpoint although the case was run before. FatalIOError where
    /// purgeWrite would remove the last checkpoint before the next is there, or files are compressed. Collective.
    /// \param writes  false where the case must stay as it is
    explicit Checkpoints(const Foam::Time& time, bool writes = true);

    /// The particles to resume from, relative to the case, as DemEngine::writeCheckpoint() was reported; empty for a fresh start.
    const std::filesystem::path& particles() const
    {
        return resumeFrom_;
    }

    bool resumed() const
    {
        return !resumeFrom_.empty();
    }

    /// Time of the fresh start [s].
    double beginning() const
    {
        return beginning_;
    }

    /// Call before the fields of a write time are written: an earlier checkpoint of the same time is no longer whole.
    /// FatalError where the case has gone from its place.
    void begin() const;

    /// Call after the fields of a write time are written. Collective. FatalError where a file of the checkpoint is not
    /// on the disk as a whole.
    void complete(DemEngine& engine) const;

private:
    void startAfresh(bool writes);

    const Foam::Time& time_;
    std::filesystem::path resumeFrom_;
    double beginning_ = 0;
};

} // namespace clepsydra
