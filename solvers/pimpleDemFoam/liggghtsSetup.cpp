#include "liggghtsSetup.h"

#include "runTimeSelection.h"
#include "tokens/exactText.h"

#include "OSspecific.H"

#include <cctype>

namespace clepsydra
{

namespace
{

/// A value as text for LIGGGHTS, with all its digits.
std::string valueOf(const dictionary& variables, const word& name)
{
    const ITstream& values = variables.lookup(name);
    if (values.size() != 1)
    {
        FatalIOErrorInFunction(variables) << "Entry '" << name << "' of DEM/variables has " << values.size()
                                          << " values; allowed: one number, word or \"text\"" << exit(FatalIOError);
    }
    const token& value = values[0];
    if (value.isLabel())
    {
        return std::to_string(value.labelToken());
    }
    if (value.isNumber())
    {
        if (!isOfUsableSize(value.number()))
        {
            FatalIOErrorInFunction(variables)
                << "Entry '" << name << "' of DEM/variables is " << value.number()
                << "; allowed: 0, or a number of a size from 1e-60 to 1e60" << exit(FatalIOError);
        }
        return exactText(value.number());
    }
    if (!value.isWord() && !value.isString())
    {
        FatalIOErrorInFunction(variables) << "Entry '" << name << "' of DEM/variables is " << value.info()
                                          << "; allowed: one number, word or \"text\"" << exit(FatalIOError);
    }
    return value.isString() ? value.stringToken() : value.wordToken();
}

/// Checks values of materials: no negative friction or cohesion, no density or diameter of zero. The script's own
/// checks come too late or do not exist. The quantity is recognised by the variable's name, because the script may use
/// any names. A value that is no number, such as `cohesionStyle sjkr`, is the name of a model or a file.
void checkMaterialValues(const dictionary& variables)
{
    const auto names = [](const word& name, const std::string& quantity) {
        return name.find(quantity) != string::npos
               || name.find(static_cast<char>(std::toupper(quantity[0])) + quantity.substr(1)) != string::npos;
    };
    for (const word& name : variables.toc())
    {
        scalar value = 0;
        if (!readScalar(valueOf(variables, name).c_str(), value))
        {
            continue;
        }
        if (names(name, "friction") || names(name, "cohesion"))
        {
            requirePositive(variables, name, value, true);
        }
        else if (names(name, "density") || names(name, "diameter"))
        {
            requirePositive(variables, name, value);
        }
    }
}

/// \param changes  the dictionary DEM/groupChanges, with one sub-dictionary per change
std::vector<GroupChange> readGroupChanges(const dictionary& changes)
{
    std::vector<GroupChange> read;
    for (const entry& item : changes)
    {
        if (!item.isDict())
        {
            FatalIOErrorInFunction(changes)
                << "Entry '" << item.keyword() << "' of DEM/groupChanges is not a dictionary; allowed: "
                << "name { from <group>; to <group>; below <z>; }" << exit(FatalIOError);
        }
        const dictionary& dict = item.dict();
        requireKnownEntries(dict, {"from", "to", "below", "slowerThan", "during"});
        GroupChange change{item.keyword(), dict.get<word>("from"), dict.get<word>("to"), dict.get<double>("below"), {}};
        if (dict.found("slowerThan") || dict.found("during"))
        {
            change.rest = GroupChange::Rest{positiveEntry(dict, "slowerThan"), positiveEntry(dict, "during")};
        }
        read.push_back(std::move(change));
    }
    return read;
}

} // namespace

LiggghtsSetup liggghtsSetup(const CouplingSettings& settings, bool writesNothing)
{
    const dictionary& dem = settings.demDict();
    LiggghtsSetup setup;
    setup.script = dem.get<fileName>("script").c_str();
    if (!isFile(fileName(setup.script.string())))
    {
        FatalIOErrorInFunction(dem) << "Entry 'script' is " << setup.script.c_str()
                                    << "; allowed: a file, relative to the case directory "
                                    << settings.dict().time().globalPath() << exit(FatalIOError);
    }
    const dictionary variables = dem.subOrEmptyDict("variables");
    for (const word& name : variables.toc())
    {
        setup.variables.emplace_back(name, valueOf(variables, name));
    }
    checkMaterialValues(variables);
    setup.groupChanges = readGroupChanges(dem.subOrEmptyDict("groupChanges"));
    setup.logFile = writesNothing ? "/dev/null" : "log.liggghts";
    setup.writesNothing = writesNothing;
    setup.onWarning = [](const std::string& warning) { WarningInFunction << warning.c_str() << endl; };
    return setup;
}

void resume(LiggghtsSetup& setup, const Checkpoints& checkpoints)
{
    setup.resumeFrom = checkpoints.particles();
    if (setup.writesNothing)
    {
        return;
    }
    for (const Manifest::Output& output : checkpoints.outputs())
    {
        setup.outputs.push_back({output.name, output.size});
    }
}

} // namespace clepsydra
