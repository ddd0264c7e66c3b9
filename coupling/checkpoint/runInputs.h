#pragma once

#include "checkpoint/manifest.h"

#include "fvMesh.H"

#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra
{

/// What a run is made from and what a resumed run reads again: the mesh, the files of the DEM script, and the
/// dictionaries of the coupling and the fluid in constant/. A checkpoint records their digests, so that a resumed run
/// can tell whether it is the same run.
class RunInputs
{
public:
    /// Collective.
    /// \param meshMoves  whether the points move during the run. They are then part of each checkpoint, and those from which
    /// the run began count as its input.
    /// \param scriptFiles  relative to the case: the DEM script and the files that it includes or reads
    RunInputs(const Foam::fvMesh& mesh, bool meshMoves, const std::vector<std::filesystem::path>& scriptFiles);

    const MeshSums& mesh() const
    {
        return sums_;
    }

    /// The manifest's lines of this rank.
    std::string lines() const;

    /// How the mesh differs from that of a checkpoint; empty where it does not. After a redistribution only the sums
    /// over all cells can be compared. Collective; the same on all ranks.
    std::string changeOfMesh(const Manifest& checkpoint) const;

    /// Dictionaries and files that were changed, removed or added since a checkpoint, one phrase each. On the first
    /// rank only.
    std::vector<std::string> changesOfFiles(const Manifest& checkpoint) const;

private:
    MeshSums sums_;
    Manifest::File meshOfThisRank_;
    /// On the first rank only.
    std::vector<Manifest::File> files_;
};

} // namespace clepsydra
