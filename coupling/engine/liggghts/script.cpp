#include "engine/liggghts/script.h"

#include "engine/demEngine.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <sstream>

namespace clepsydra
{

namespace
{

std::string token(const std::string& command, int index)
{
    std::istringstream tokens(command);
    std::string found;
    for (int i = 0; i <= index; ++i)
    {
        found.clear();
        tokens >> found;
    }
    return found;
}

bool isQuote(char c)
{
    return c == '"' || c == '\'';
}

/// Commands whose results a checkpoint holds.
const std::set<std::string> held = {"change_box", "create_atoms", "create_box", "delete_atoms", "delete_bonds",
    "displace_atoms", "group", "read_data", "read_dump", "read_restart", "replicate", "reset_timestep", "rotate", "set",
    "velocity"};

/// Commands that write a file once, at the start. Repeated, they would write the state of the checkpoint over it.
const std::set<std::string> writing = {"info", "pair_write", "write_data", "write_dump", "write_restart"};

/// Commands that a resumed run needs again.
const std::set<std::string> repeated = {"angle_coeff", "angle_style", "atom_modify", "atom_style", "bond_coeff",
    "bond_style", "boundary", "box", "communicate", "compute", "compute_modify", "dielectric", "dihedral_coeff",
    "dihedral_style", "dimension", "dump", "dump_modify", "echo", "fix", "fix_modify", "force_dt_reset",
    "hard_particles", "if", "improper_coeff", "improper_style", "kspace_modify", "kspace_style", "lattice", "log",
    "mass", "min_modify", "min_style", "modify_timing", "neigh_modify", "neigh_settings", "neighbor", "newton",
    "package", "pair_coeff", "pair_modify", "pair_style", "processors", "region", "restart", "run_style",
    "soft_particles", "special_bonds", "suffix", "thermo", "thermo_log", "thermo_modify", "thermo_style", "timestep",
    "uncompute", "undump", "unfix", "units", "variable"};

bool isLeftOutOnResume(const std::string& command)
{
    const OnResume what = onResume(command);
    return what == OnResume::takeFromCheckpoint || what == OnResume::leaveOut;
}

/// Commands within `if` are executed by LIGGGHTS and not seen line by line here, so commands that this program must
/// know of are refused.
void requireHarmless(const std::string& ifCommand, const std::string& where)
{
    static const std::set<std::string> others = {"run", "run_time", "rerun", "minimize", "jump", "label", "next",
        "include", "clear", "partition", "quit", "write_restart_on_signal"};
    for (const std::string& found : tokensOf(ifCommand))
    {
        const bool quoted = isQuote(found.front());
        const std::string inside = quoted ? found.substr(1, found.size() - 2) : found;
        const std::string name = token(inside, 0);
        if (quoted && name == "if")
        {
            requireHarmless(inside, where);
        }
        else if (others.count(name) > 0 || isLeftOutOnResume(inside))
        {
            throw DemEngineError(
                where + ": '" + ifCommand + "'; allowed: an 'if' without '" + name
                + "', because the coupling cannot see when it is executed, and a resumed run would repeat it");
        }
    }
}

/// A text with the values of the variables that the dictionary DEM/variables sets.
std::string withValues(std::string text, const ScriptVariables& variables)
{
    for (const auto& [variable, value] : variables)
    {
        const std::string reference = "${" + variable + '}';
        for (std::size_t at = 0; (at = text.find(reference, at)) != std::string::npos; at += value.size())
        {
            text.replace(at, reference.size(), value);
        }
    }
    return text;
}

/// The name of an included file with the values of its variables.
std::string nameOfIncluded(const std::string& text, const ScriptVariables& variables, const std::string& where)
{
    std::string name = withValues(text, variables);
    if (name.find('$') != std::string::npos)
    {
        throw DemEngineError(where + ": include '" + name
                             + "'; allowed in a file's name: variables that the "
                               "dictionary DEM/variables sets");
    }
    return name;
}

/// Whether a file is among others, by whatever path.
bool isAmong(const std::filesystem::path& file, const std::vector<std::filesystem::path>& files)
{
    std::error_code notThere;
    return std::any_of(files.begin(), files.end(),
        [&](const auto& other) { return std::filesystem::equivalent(file, other, notThere); });
}

/// \param open  files that are being read, each of which includes the next
std::vector<ScriptCommand> readFile(
    const std::filesystem::path& script, const ScriptVariables& variables, std::vector<std::filesystem::path> open)
{
    open.push_back(script);
    std::ifstream lines(script);
    if (!lines)
    {
        throw DemEngineError("cannot read the DEM script " + script.string() + "; allowed: a file that can be read");
    }
    std::vector<ScriptCommand> commands;
    std::string text;
    std::string line;
    for (int lineNumber = 1; std::getline(lines, line); ++lineNumber)
    {
        text += line.substr(0, line.find_last_not_of(" \t\r") + 1);
        if (!text.empty() && text.back() == '&')
        {
            text.back() = ' ';
            continue;
        }
        const std::string where = script.string() + " line " + std::to_string(lineNumber);
        const std::string name = token(text, 0);
        if (name == "jump" || name == "label" || name == "next")
        {
            throw DemEngineError(
                where + ": '" + name + "' is not supported; allowed: commands that can be executed line by line");
        }
        if (name == "clear" || name == "partition" || name == "quit" || name == "write_restart_on_signal")
        {
            throw DemEngineError(where + ": '" + text + "'; allowed: a script without '" + name
                                 + "', because pimpleDemFoam starts and ends LIGGGHTS itself");
        }
        if (name == "run" || name == "run_time" || name == "rerun" || name == "minimize")
        {
            throw DemEngineError(
                where + ": '" + text + "'; allowed: a script without '" + name
                + "', because the coupling runs LIGGGHTS in every coupling step; particles can be filled in "
                  "by a case of its own with 'fluid none;'");
        }
        if (name == "if")
        {
            requireHarmless(text, where);
        }
        if (name == "include")
        {
            const std::string file = nameOfIncluded(token(text, 1), variables, where);
            if (isAmong(file, open))
            {
                throw DemEngineError(where + ": include '" + file + "'; allowed: a file that does not include "
                                     + script.string() + " itself, because reading would never end");
            }
            const std::vector<ScriptCommand> included = readFile(file, variables, open);
            commands.insert(commands.end(), included.begin(), included.end());
        }
        else
        {
            commands.push_back({text, where});
        }
        text.clear();
    }
    if (!text.empty())
    {
        throw DemEngineError(script.string() + ": the last line, '" + text
                             + "', ends in '&'; allowed: '&' only where another line follows");
    }
    return commands;
}

} // namespace

std::vector<ScriptCommand> readScript(const std::filesystem::path& script, const ScriptVariables& variables)
{
    return readFile(script, variables, {});
}

std::vector<std::string> tokensOf(const std::string& command)
{
    const auto isSpace = [](unsigned char c) { return std::isspace(c) != 0; };
    std::vector<std::string> tokens;
    for (auto at = command.begin(); (at = std::find_if_not(at, command.end(), isSpace)) != command.end();)
    {
        auto end = std::find_if(at, command.end(), isSpace);
        if (isQuote(*at))
        {
            end = std::find(at + 1, command.end(), *at);
            end += end == command.end() ? 0 : 1;
        }
        tokens.emplace_back(at, end);
        at = end;
    }
    return tokens;
}

bool isCommand(const std::string& command, const std::string& name)
{
    return token(command, 0) == name;
}

bool writesFiles(const std::string& command)
{
    static const std::set<std::string> commands = {
        "dump", "dump_modify", "undump", "restart", "write_restart", "write_data", "write_dump", "log", "shell"};
    return commands.count(token(command, 0)) > 0;
}

std::string withoutFiles(const std::string& command)
{
    std::vector<std::string> tokens = tokensOf(command);
    const auto writes = [](const std::string& style) {
        return style.rfind("ave/", 0) == 0 || style == "print" || style == "massflow/mesh";
    };
    constexpr std::size_t style = 3; // fix ID group style
    if (tokens.size() <= style || tokens[0] != "fix" || !writes(tokens[style]))
    {
        return command;
    }
    std::string result;
    for (std::size_t i = 0; i < tokens.size(); ++i)
    {
        if (i > style && (tokens[i] == "file" || tokens[i] == "append"))
        {
            ++i;
            continue;
        }
        result += tokens[i] + ' ';
    }
    return result;
}

OnResume onResume(const std::string& command)
{
    const std::string name = token(command, 0);
    if (name.empty() || name.front() == '#' || repeated.count(name) > 0)
    {
        return OnResume::repeat;
    }
    if (held.count(name) > 0)
    {
        return OnResume::takeFromCheckpoint;
    }
    if (name == "print")
    {
        const bool writesFile = hasArgument(command, "file") || hasArgument(command, "append");
        return writesFile ? OnResume::leaveOut : OnResume::repeat;
    }
    if (name == "shell")
    {
        // Others may remove or move what the run has written.
        static const std::set<std::string> harmless = {"cd", "mkdir", "putenv"};
        return harmless.count(token(command, 1)) > 0 ? OnResume::repeat : OnResume::leaveOut;
    }
    return writing.count(name) > 0 ? OnResume::leaveOut : OnResume::unknown;
}

bool hasArgument(const std::string& command, const std::string& word)
{
    const std::vector<std::string> tokens = tokensOf(command);
    return tokens.size() > 1 && std::find(tokens.begin() + 1, tokens.end(), word) != tokens.end();
}

std::string argumentAfter(const std::string& command, const std::string& word)
{
    const std::vector<std::string> tokens = tokensOf(command);
    const auto found = std::find(tokens.begin(), tokens.end(), word);
    if (found == tokens.end() || found + 1 == tokens.end())
    {
        return {};
    }
    const std::string& argument = *(found + 1);
    return isQuote(argument.front()) ? argument.substr(1, argument.size() - 2) : argument;
}

std::vector<std::filesystem::path> filesOfScript(const std::filesystem::path& script, const ScriptVariables& variables)
{
    std::vector<std::filesystem::path> files{script};
    const auto add = [&](const std::string& file) {
        if (std::find(files.begin(), files.end(), file) == files.end())
        {
            files.emplace_back(file);
        }
    };
    for (const ScriptCommand& command : readScript(script, variables))
    {
        add(command.where.substr(0, command.where.rfind(" line ")));
        constexpr int style = 3; // fix ID group style
        if (isCommand(command.text, "fix") && token(command.text, style).rfind("mesh/", 0) == 0)
        {
            const std::string surface = withValues(argumentAfter(command.text, "file"), variables);
            if (!surface.empty() && surface.find('$') == std::string::npos)
            {
                add(surface);
            }
        }
    }
    return files;
}

} // namespace clepsydra
