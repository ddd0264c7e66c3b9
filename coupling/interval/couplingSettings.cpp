#include "interval/couplingSettings.h"

#include "distribution/smoothingModel.h"
#include "distribution/voidFractionModel.h"
#include "forces/forceModel.h"
#include "interval/dictionaryText.h"

#include "OSspecific.H"
#include "runTimeSelection.h"
#include "words/exactText.h"

#include <cctype>
#include <cmath>

namespace clepsydra
{

namespace
{

/// Times that should be equal or whole multiples may differ by rounding of their decimal fractions.
constexpr double sameTime = 1e-6;

/// A value as LIGGGHTS is to read it, every digit kept.
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

/// No material has a negative friction, nor a density or diameter of zero; the script's own checks come too late or
/// not at all. Variables are known by their names, since the script may call them what it likes.
void checkMaterialValues(const dictionary& variables)
{
    const auto names = [](const word& name, const std::string& quantity) {
        return name.find(quantity) != string::npos
               || name.find(static_cast<char>(std::toupper(quantity[0])) + quantity.substr(1)) != string::npos;
    };
    for (const word& name : variables.toc())
    {
        if (names(name, "friction") || names(name, "cohesion"))
        {
            positiveEntry(variables, name, true);
        }
        else if (names(name, "density") || names(name, "diameter"))
        {
            positiveEntry(variables, name);
        }
    }
}

/// The names, and <model>Props of every model: those of one that is not chosen may stay in the file.
wordList coefficientsOfModels(wordList names)
{
    for (const wordList& models : {ForceModel::dictionaryConstructorTablePtr_->sortedToc(),
             VoidFractionModel::dictionaryConstructorTablePtr_->sortedToc(),
             SmoothingModel::dictionaryConstructorTablePtr_->sortedToc()})
    {
        for (const word& model : models)
        {
            names.append(model + "Props");
        }
    }
    return names;
}

/// \param changes  the dictionary DEM/groupChanges, a sub-dictionary each.
std::vector<GroupChange> readGroupChanges(const dictionary& changes)
{
    std::vector<GroupChange> read;
    for (const entry& item : changes)
    {
        if (!item.isDict())
        {
            FatalIOErrorInFunction(changes)
                << "Entry '" << item.keyword() << "' of DEM/groupChanges is no dictionary; allowed: "
                << "name { from <group>; to <group>; below <z>; }" << exit(FatalIOError);
        }
        const dictionary& dict = item.dict();
        requireKnownEntries(dict, {"from", "to", "below", "slowerThan", "during"});
        GroupChange change{item.keyword(), dict.get<word>("from"), dict.get<word>("to"), dict.get<double>("below"), {}};
        if (dict.found("slowerThan"))
        {
            change.rest = GroupChange::Rest{positiveEntry(dict, "slowerThan"), positiveEntry(dict, "during")};
        }
        read.push_back(std::move(change));
    }
    return read;
}

/// A file that is not there is refused by the IOdictionary that is made from this.
IOobject couplingProperties(const Time& time)
{
    IOobject object("couplingProperties", time.constant(), time, IOobject::MUST_READ, IOobject::NO_WRITE);
    checkDictionaryText(typeFilePath<IOdictionary>(object));
    return object;
}

} // namespace

CouplingSettings::CouplingSettings(const Time& time)
    : time_(time),
      dict_(couplingProperties(time))
{
    requireKnownEntries(dict_,
        {"fluid", "couplingInterval", "adjustableInterval", "maxCo", "minInterval", "maxInterval", "modelType",
            "voidFractionModel", "smoothingModel", "selfDisturbance", "forceModels", "momCoupleModels",
            "useDDTvoidfraction", "beadOutlets", "insertionTime"},
        coefficientsOfModels({"useDDTvoidfractionProps", "DEM", "beadOutput", "ledger"}));
    requireKnownEntries(dict_.subDict("DEM"), {"engine", "script", "writeRestart", "maxRayleighFraction"},
        {"variables", "groupChanges"});
    requireKnownEntries(dict_.subOrEmptyDict("beadOutput"), {"writeVtk"});
    readChoices();
    checkTimeStep();
}

void CouplingSettings::readChoices()
{
    couplingInterval_ = positiveEntry(dict_, "couplingInterval");
    hasFluid_ = selectedModel(dict_, "fluid", {"incompressible", "none"}) != "none";
    if (!hasFluid_)
    {
        return;
    }
    readAdjustableInterval();
    selectedModel(dict_, "modelType", {"A", "B"});
    ddtVoidFraction_ = dict_.getOrDefault<Switch>("useDDTvoidfraction", true);

    const dictionary ddtProps = dict_.subOrEmptyDict("useDDTvoidfractionProps");
    requireKnownEntries(ddtProps, {"smoothingTime"});
    if (ddtProps.found("smoothingTime"))
    {
        ddtSmoothingTime_ = positiveEntry(ddtProps, "smoothingTime", true);
    }

    const wordList momentumModels = dict_.get<wordList>("momCoupleModels");
    if (momentumModels.size() != 1)
    {
        FatalIOErrorInFunction(dict_) << "Entry 'momCoupleModels' lists " << momentumModels.size()
                                      << " models; allowed: one of (implicitCouple explicitCouple)"
                                      << exit(FatalIOError);
    }
    // The name with the file's path, for the message.
    dictionary choice(static_cast<const dictionary&>(dict_).name());
    choice.add("momCoupleModels", momentumModels.first());
    implicitCoupling_ =
        selectedModel(choice, "momCoupleModels", {"implicitCouple", "explicitCouple"}) == "implicitCouple";

    const dictionary voidFractionProps = dict_.subOrEmptyDict(dict_.get<word>("voidFractionModel") + "Props");
    if (voidFractionProps.found("alphaMin"))
    {
        minimumVoidFraction_ = positiveEntry(voidFractionProps, "alphaMin");
    }
}

void CouplingSettings::readAdjustableInterval()
{
    if (!dict_.getOrDefault<Switch>("adjustableInterval", false))
    {
        return;
    }
    adjustableInterval_ = AdjustableInterval{
        positiveEntry(dict_, "maxCo"), positiveEntry(dict_, "minInterval"), positiveEntry(dict_, "maxInterval")};
    const auto [largestCourantNumber, shortest, longest] = *adjustableInterval_;
    if (shortest > longest)
    {
        FatalIOErrorInFunction(dict_) << "Entry 'minInterval' is " << shortest << " s; allowed: at most maxInterval, "
                                      << "which is " << longest << " s" << exit(FatalIOError);
    }
    if (couplingInterval_ < shortest * (1 - sameTime) || couplingInterval_ > longest * (1 + sameTime))
    {
        FatalIOErrorInFunction(dict_) << "Entry 'couplingInterval' is " << couplingInterval_
                                      << " s; allowed: from minInterval to maxInterval, " << shortest << " to "
                                      << longest << " s, for it is the first interval" << exit(FatalIOError);
    }
}

void CouplingSettings::checkTimeStep() const
{
    if (time_.controlDict().getOrDefault<Switch>("adjustTimeStep", false))
    {
        FatalIOErrorInFunction(time_.controlDict())
            << "Entry 'adjustTimeStep' is on; allowed: off, for the fluid's time step is the coupling interval"
            << exit(FatalIOError);
    }
    if (std::abs(time_.deltaTValue() / couplingInterval_ - 1) > sameTime)
    {
        FatalIOErrorInFunction(dict_) << "Entry 'couplingInterval' is " << couplingInterval_
                                      << " s; allowed: the value of deltaT in system/controlDict, which is "
                                      << time_.deltaTValue() << " s" << exit(FatalIOError);
    }
}

std::vector<std::string> CouplingSettings::descriptions() const
{
    if (!hasFluid_)
    {
        return {"fluid          none: a dry run"};
    }
    return {
        "equations      model " + std::string(dict_.get<word>("modelType")) + ", pressure without its hydrostatic part",
        adjustableInterval_ ? "interval       adjustable, Courant numbers to "
                                  + std::to_string(adjustableInterval_->largestCourantNumber)
                            : std::string("interval       constant"),
        "momentum       " + std::string(implicitCoupling_ ? "implicitCouple" : "explicitCouple"),
        "alphaMin       " + std::to_string(minimumVoidFraction_),
        ddtVoidFraction_ ? "d(eps)/dt      in continuity, smoothingTime " + std::to_string(ddtSmoothingTime_) + " s"
                         : std::string("d(eps)/dt      OFF: WARNING, this removes what dilation does to the fluid, the "
                                       "surge of a submerged hopper with it"),
        "drag in DEM    at every step, from the bead's own velocity and the frozen fluid"};
}

LiggghtsSetup CouplingSettings::engineSetup(const std::filesystem::path& resumeFrom, bool writesNothing) const
{
    const dictionary& dem = dict_.subDict("DEM");
    selectedModel(dem, "engine", {"liggghts"});

    LiggghtsSetup setup;
    setup.script = dem.get<fileName>("script").c_str();
    if (!isFile(fileName(setup.script.string())))
    {
        FatalIOErrorInFunction(dem) << "Entry 'script' is " << setup.script.c_str()
                                    << "; allowed: a file, relative to the case directory " << time_.globalPath()
                                    << exit(FatalIOError);
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
    setup.resumeFrom = resumeFrom;
    return setup;
}

fileName CouplingSettings::finalRestart() const
{
    return dict_.subDict("DEM").getOrDefault<fileName>("writeRestart", fileName::null);
}

int CouplingSettings::stepsPerInterval(double demTimeStep) const
{
    return static_cast<int>(wholeSteps(dict_, "couplingInterval", couplingInterval_, demTimeStep));
}

double CouplingSettings::wholeSteps(const dictionary& dict, const word& entry, double time, double demTimeStep) const
{
    const double steps = time / demTimeStep;
    if (steps < 0.5 || std::abs(steps - std::round(steps)) > sameTime * steps)
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is " << time
                                     << " s; allowed: a whole multiple of the DEM step, which is " << demTimeStep
                                     << " s in the script " << demDict().get<fileName>("script").c_str()
                                     << exit(FatalIOError);
    }
    return std::round(steps);
}

} // namespace clepsydra
