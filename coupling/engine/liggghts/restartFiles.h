#pragma once

#include "engine/liggghts/script.h"

#include <filesystem>
#include <vector>

namespace clepsydra
{

class LiggghtsProgram;

/// LIGGGHTS goes round for ever in a restart file that has been cut, or is none.
/// \throws DemEngineError for a command `read_restart` of such a file
void requireUndamagedInput(const LiggghtsProgram& program, const ScriptCommand& command);

/// All of a run's state that LIGGGHTS knows, for `read_restart`: in one file, or where its name has a `%` in one of each rank and
/// a base. Afterwards the program stands as one that has read them. Collective.
/// \returns the files that this rank has written. \throws FileError where not all of them are on the disk
std::vector<std::filesystem::path> writeRestart(LiggghtsProgram& program, const std::filesystem::path& name);

} // namespace clepsydra
