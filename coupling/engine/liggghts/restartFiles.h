#pragma once

#include "engine/liggghts/script.h"

#include <filesystem>
#include <vector>

namespace clepsydra
{

class LiggghtsProgram;

/// Checks the file of a command `read_restart`; LIGGGHTS does not return from a file that is truncated or not a restart
/// file.
/// \throws DemEngineError for such a file
void requireUndamagedInput(const LiggghtsProgram& program, const ScriptCommand& command);

/// Writes all of a run's state that LIGGGHTS holds, for `read_restart`: into one file, or where the name has a `%`,
/// into one file per rank and a base. Afterwards the state of the program is that of one that has read these files.
/// Collective.
/// \return the files that this rank has written
/// \throws FileError where not all of them are on the disk
std::vector<std::filesystem::path> writeRestart(LiggghtsProgram& program, const std::filesystem::path& name);

} // namespace clepsydra
