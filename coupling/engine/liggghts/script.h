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

/// The words of a command; a text in quotes is one word, with its quotes.
std::vector<std::string> tokensOf(const std::string& command);

/// Whether the command has this name.
bool isCommand(const std::string& command, const std::string& name);

/// Whether the command only writes files, immediately or while LIGGGHTS runs.
bool writesFiles(const std::string& command);

/// The command without the file that a `fix` would write in addition to its effect.
std::string withoutFiles(const std::string& command);

/// What a resumed run does with a command of the script.
enum class OnResume
{
    /// Repeats it: materials, walls, fixes, output.
    repeat,
    /// Leaves it out, because the checkpoint holds its result: it has created, read or changed particles or the box.
    takeFromCheckpoint,
    /// Leaves it out, because its result lies in a file that it has written at the start.
    leaveOut,
    /// Unknown: this program has no such command in its list.
    unknown
};

/// \param command  with the values of its variables
OnResume onResume(const std::string& command);

/// Whether the command has this word as one of its arguments.
bool hasArgument(const std::string& command, const std::string& word);

/// The argument that follows a word in the command, without quotes; empty where there is none.
std::string argumentAfter(const std::string& command, const std::string& word);

/// The files that a resumed run reads again: the script, those that it includes, and the surfaces of `fix mesh/...`.
/// A surface whose name has a variable that the script itself sets is not among them.
/// \throws DemEngineError as readScript()
std::vector<std::filesystem::path> filesOfScript(const std::filesystem::path& script, const ScriptVariables& variables);

} // namespace clepsydra
