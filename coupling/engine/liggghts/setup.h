#pragma once

#include "engine/demEngine.h"
#include "engine/liggghts/groupChanges.h"

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace clepsydra
{

/// Settings of a LIGGGHTS run.
struct LiggghtsSetup
{
    std::filesystem::path script;
    /// Each becomes `variable <name> equal|string <value>` before the first line of the script.
    std::vector<std::pair<std::string, std::string>> variables;
    std::filesystem::path logFile;
    /// Leaves out the script's commands that write files.
    bool writesNothing = false;
    /// Name of a checkpoint to resume from, as it was passed to DemEngine::writeCheckpoint(); empty for a fresh start.
    /// With a checkpoint, the script's first `create_box`, `read_data` or `read_restart` reads the checkpoint instead,
    /// and other commands whose result it holds (`create_atoms`, `group`, `set`, `velocity`, `replicate`, ...) or that
    /// wrote a file at the start are left out; see onResume(). Materials, walls and fixes are created as in a fresh
    /// start.
    std::filesystem::path resumeFrom;
    /// The files that the run had open at the checkpoint, on all ranks, with their sizes then. They are continued from
    /// there.
    std::vector<EngineOutput> outputs;
    /// Applied in this order after each coupling step.
    std::vector<GroupChange> groupChanges;
    /// Called on the first rank with each warning: of LIGGGHTS, with the place in the script, and of the engine.
    std::function<void(const std::string&)> onWarning;
    MPI_Comm communicator = MPI_COMM_WORLD;
};

} // namespace clepsydra
