#pragma once

#include "Time.H"
#include "argList.H"

#include <filesystem>

namespace clepsydra
{

class DemEngine;

/// The states of a run on disk, from which `startFrom latestTime` goes on.
///
/// A checkpoint of time t is OpenFOAM's fields in <t>/ (or processor*/<t>/) together with checkpoints/<t>/, which
/// holds the beads and, written last, the file `complete`. A run that is killed while it writes leaves no `complete`;
/// the next run sets that time aside and goes on from the checkpoint before. The beads' file does not depend on the
/// number of ranks: to go on with another number, reconstruct and decompose the fields as ever.
class Checkpoints
{
public:
    /// Renames the time folders that a killed run left unfinished to `unfinished.<t>`, so that OpenFOAM does not take
    /// them for the latest time. Call before Time is constructed. Collective.
    static void setAsideUnfinished(const Foam::argList& args);

    /// FatalError if the start time has no checkpoint although the case has checkpoints. Collective.
    explicit Checkpoints(const Foam::Time& time);

    /// The beads to resume from; empty for a fresh start.
    const std::filesystem::path& beads() const
    {
        return resumeFrom_;
    }

    bool resumed() const
    {
        return !resumeFrom_.empty();
    }

    /// Call before the fields of a write time are written: an earlier checkpoint of the same time is no longer whole.
    void begin() const;

    /// Call after the fields of a write time are written. Collective.
    void complete(DemEngine& engine) const;

private:
    const Foam::Time& time_;
    std::filesystem::path resumeFrom_;
};

} // namespace clepsydra
