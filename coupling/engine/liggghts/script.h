#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace clepsydra
{

using ScriptVariables = std::vector<std::pair<std::string, std::string>>;

/// A command of a LIGGGHTS script, and its place for error messages.
struct ScriptCommand
{
    std::string text;
    std::string where; // "DEM/in.filling line 12"
};

/// Reads the commands of a script in order; lines are joined at `&`, and `include`d files are inserted. The commands
/// are executed by LIGGGHTS one by one, so that an error can name its line; therefore `jump`, `label` and `next` are
/// not supported.
/// \param variables  name and value, for the names of included files: `include DEM/in.${sizes}`
/// \throws DemEngineError where a file cannot be read, ends in `&` or includes itself (also through another file),
/// where a file's name has an unknown variable, and where a command jumps or runs. The same applies within an `if`,
/// which must not create particles either.
std::vector<ScriptCommand> readScript(const std::filesystem::path& script, const ScriptVariables& variables);

/// Whether the command has this name.
bool isCommand(const std::string& command, const std::string& name);

/// Whether the command only writes files, immediately or while LIGGGHTS runs.
bool writesFiles(const std::string& command);

/// The command without the file that a `fix` would write in addition to its effect.
std::string withoutFiles(const std::string& command);

/// Whether a checkpoint holds the result of the command: true for commands that create, read or change particles.
bool makesParticles(const std::string& command);

} // namespace clepsydra
