#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace clepsydra
{

using ScriptVariables = std::vector<std::pair<std::string, std::string>>;

/// A command of a LIGGGHTS script and where it stands, for errors.
struct ScriptCommand
{
    std::string text;
    std::string where; // "DEM/in.filling line 12"
};

/// The commands of a script in their order: lines joined at `&`, `include`d files in their place.
/// The commands are given to LIGGGHTS one by one, so that an error can name its line. Hence no `jump`, `label`, `next`.
/// \param variables  name and value, for the names of included files: `include DEM/in.${sizes}`
/// \throws DemEngineError where a file cannot be read, ends in `&` or includes itself (or a file that does), a file's name
/// has another variable, or a command jumps or runs, also one within an `if`, where none may make particles either.
std::vector<ScriptCommand> readScript(const std::filesystem::path& script, const ScriptVariables& variables);

/// True for the command of this name.
bool isCommand(const std::string& command, const std::string& name);

/// True for the commands that write files, now or while LIGGGHTS runs, and do nothing else.
bool writesFiles(const std::string& command);

/// A `fix` without the file that it would write beside what it does.
std::string withoutFiles(const std::string& command);

/// True for the commands whose result a checkpoint holds: those that make, read or change particles.
bool makesParticles(const std::string& command);

} // namespace clepsydra
