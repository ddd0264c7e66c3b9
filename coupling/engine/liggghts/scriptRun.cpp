#include "engine/liggghts/scriptRun.h"

#include "engine/liggghts/liggghtsProgram.h"
#include "engine/liggghts/outputFiles.h"
#include "engine/liggghts/particleChecks.h"
#include "engine/liggghts/restartFiles.h"
#include "engine/liggghts/subdomains.h"
#include "tokens/didYouMean.h"

#include <atom.h>
#include <lammps.h>

#include <algorithm>
#include <exception>
#include <string>

namespace clepsydra
{

namespace
{

/// Whether LIGGGHTS reads the text as a number. std::stod would also take INF, NAN and 0x10, which are words of the
/// script.
bool isNumber(const std::string& text)
{
    if (text.find_first_not_of("0123456789.+-eE") != std::string::npos)
    {
        return false;
    }
    std::size_t used = 0;
    try
    {
        std::stod(text, &used);
    }
    catch (const std::exception&)
    {
        return false;
    }
    return used == text.size();
}

/// A value of several words as one token of a command.
std::string asToken(const std::string& value)
{
    return value.find_first_of(" \t") == std::string::npos ? value : '"' + value + '"';
}

/// Executes a command of the script. LIGGGHTS gives no message where create_atoms creates no particle because its
/// positions are outside the box.
/// \return the command with the values of its variables
ScriptCommand execute(LiggghtsProgram& program, const ScriptCommand& command)
{
    const auto before = program->atom->natoms;
    program.execute(command.text, command.where);
    ScriptCommand executed{program.withVariables(command.text), command.where};
    if (isCommand(command.text, "create_atoms") && program->atom->natoms == before)
    {
        throw DemEngineError(command.where + ": '" + command.text + "'" + program.valuesIn(command.text)
                             + " made no particle; allowed: positions in " + boxText(*program));
    }
    return executed;
}

/// The values of variables are looked up only where they are needed, because that may draw random numbers.
OnResume whatOnResume(const LiggghtsProgram& program, const std::string& command)
{
    return onResume(!command.empty() && command.front() == '$' ? program.withVariables(command) : command);
}

/// The script must not replace a variable that the case sets, but for `variable NAME index VALUE`, which LIGGGHTS takes
/// for a default. A misspelt variable of the case would leave such a default in its place.
void requireVariablesOfTheCase(const ScriptVariables& variables, const std::vector<ScriptCommand>& commands)
{
    constexpr std::size_t name = 1;
    constexpr std::size_t style = 2;
    const std::vector<std::string> set = namesOf(variables);
    std::vector<std::string> defaults; // that the case does not set
    std::string script;
    for (const ScriptCommand& command : commands)
    {
        script += command.text + '\n';
        const std::vector<std::string> words = tokensOf(command.text);
        if (!isCommand(command.text, "variable") || words.size() <= style)
        {
            continue;
        }
        const bool isSet = std::find(set.begin(), set.end(), words[name]) != set.end();
        const bool isDefault = words[style] == "index";
        if (isSet && !isDefault)
        {
            throw DemEngineError(command.where + ": '" + command.text + "' replaces the value of DEM { variables { "
                                 + words[name] + " } }; allowed: one of the two, or 'variable " + words[name]
                                 + " index <default>', which keeps the value of the case");
        }
        if (!isSet && isDefault)
        {
            defaults.push_back(words[name]);
        }
    }
    for (const std::string& each : set)
    {
        const std::string near = didYouMean(each, defaults);
        if (!near.empty() && script.find("${" + each + '}') == std::string::npos)
        {
            throw DemEngineError("DEM { variables { " + each + " } } has no effect: the script does not use it" + near);
        }
    }
}

/// Particles with a radius and a mass each, which the coupling reads from LIGGGHTS' arrays.
void requireSpheres(const LiggghtsProgram& program)
{
    const LAMMPS_NS::Atom& atom = *program->atom;
    if (atom.radius_flag == 0 || atom.rmass_flag == 0)
    {
        throw DemEngineError(std::string("The script's particles have the atom_style '") + atom.atom_style
                             + "', which gives them no radius or no mass of their own; allowed: atom_style granular");
    }
}

} // namespace

std::vector<ScriptCommand> runScript(LiggghtsProgram& program, OutputFiles& outputFiles, const LiggghtsSetup& setup)
{
    for (const auto& [name, value] : setup.variables)
    {
        const std::string style = isNumber(value) ? "equal" : "string";
        program.execute("variable " + name + ' ' + style + ' ' + asToken(value), "DEM variables");
    }
    std::vector<ScriptCommand> executed;
    const bool resumes = !setup.resumeFrom.empty();
    bool boxMade = false;
    std::vector<ScriptCommand> commands = readScript(setup.script, setup.variables);
    requireVariablesOfTheCase(setup.variables, commands);
    for (ScriptCommand& command : commands)
    {
        if (setup.writesNothing && writesFiles(command.text))
        {
            continue;
        }
        if (setup.writesNothing)
        {
            command.text = withoutFiles(command.text);
        }
        if (resumes && hasArgument(command.text, "overwrite"))
        {
            // Such a file is replaced as a whole each time.
            outputFiles.beginAgain(argumentAfter(program.withVariables(command.text), "file"));
        }
        const OnResume onResume = whatOnResume(program, command.text);
        if (!resumes || onResume == OnResume::repeat || onResume == OnResume::unknown)
        {
            requireUndamagedInput(program, command);
            executed.push_back(execute(program, command));
        }
        else if (onResume == OnResume::takeFromCheckpoint && !boxMade)
        {
            readSubdomains(program, setup.resumeFrom);
            program.execute("read_restart " + setup.resumeFrom.string(), command.where + ", resumed");
            boxMade = true;
        }
        if (onResume == OnResume::unknown)
        {
            // After LIGGGHTS, which has its own message for a command that does not exist.
            throw DemEngineError(command.where + ": '" + command.text
                                 + "' is not supported, because it is not known whether a resumed run must repeat "
                                   "it; allowed: the commands in docs/howTo/stopAndResume.md and those that set up the "
                                   "contact law, walls, fixes and output");
        }
    }
    requireSpheres(program);
    return executed;
}

} // namespace clepsydra
