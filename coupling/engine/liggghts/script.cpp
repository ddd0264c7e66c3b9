#include "engine/liggghts/script.h"

#include "engine/demEngine.h"

#include <fstream>
#include <set>
#include <sstream>

namespace clepsydra
{

namespace
{

std::string word(const std::string& command, int index)
{
    std::istringstream words(command);
    std::string found;
    for (int i = 0; i <= index; ++i)
    {
        found.clear();
        words >> found;
    }
    return found;
}

/// A file's name with the values of its variables.
std::string withValues(std::string name, const ScriptVariables& variables, const std::string& where)
{
    for (const auto& [variable, value] : variables)
    {
        const std::string reference = "${" + variable + '}';
        for (std::size_t at; (at = name.find(reference)) != std::string::npos;)
        {
            name.replace(at, reference.size(), value);
        }
    }
    if (name.find('$') != std::string::npos)
    {
        throw DemEngineError(where + ": include '" + name
                             + "'; allowed in a file's name: variables that the "
                               "dictionary DEM/variables sets");
    }
    return name;
}

} // namespace

std::vector<ScriptCommand> readScript(const std::filesystem::path& script, const ScriptVariables& variables)
{
    std::ifstream lines(script);
    if (!lines)
    {
        throw DemEngineError("cannot read the DEM script " + script.string());
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
        const std::string name = word(text, 0);
        if (name == "jump" || name == "label" || name == "next")
        {
            throw DemEngineError(where + ": '" + name + "' is not supported, the script is run line by line");
        }
        if (name == "run" || name == "rerun" || name == "minimize")
        {
            throw DemEngineError(where + ": '" + text + "'; allowed: a script without '" + name
                                 + "', for the coupling runs LIGGGHTS, from interval to interval");
        }
        if (name == "include")
        {
            const std::vector<ScriptCommand> included =
                readScript(withValues(word(text, 1), variables, where), variables);
            commands.insert(commands.end(), included.begin(), included.end());
        }
        else
        {
            commands.push_back({text, where});
        }
        text.clear();
    }
    return commands;
}

bool isCommand(const std::string& command, const std::string& name)
{
    return word(command, 0) == name;
}

bool writesFiles(const std::string& command)
{
    static const std::set<std::string> commands = {
        "dump", "dump_modify", "undump", "restart", "write_restart", "write_data", "write_dump", "log", "shell"};
    return commands.count(word(command, 0)) > 0;
}

bool makesBeads(const std::string& command)
{
    static const std::set<std::string> commands = {"create_box", "read_data", "read_restart", "create_atoms",
        "delete_atoms", "displace_atoms", "group", "set", "velocity", "reset_timestep"};
    return commands.count(word(command, 0)) > 0;
}

} // namespace clepsydra
