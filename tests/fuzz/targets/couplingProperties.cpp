// constant/couplingProperties, read as the solver reads it at its start: either refused with FatalError or FatalIOError,
// or all settings are there. Nothing that OpenFOAM's dictionaries can compile and run (#calc, #codeStream) is run.
#include "inputFile.h"
#include "liggghtsSetup.h"

#include "distribution/smoothingModel.h"
#include "distribution/voidFractionModel.h"
#include "forces/forceModel.h"
#include "couplingStep/couplingSettings.h"

#include "error.H"
#include "Time.H"
#include "dynamicCode.H"
#include "fileName.H"
#include "messageStream.H"

namespace clepsydra
{

// The models' names alone: what they read of the file, each by itself, is no part of this target.
defineTypeNameAndDebug(ForceModel, 0);
defineTypeNameAndDebug(SmoothingModel, 0);
defineTypeNameAndDebug(VoidFractionModel, 0);
defineRunTimeSelectionTable(ForceModel, dictionary);
defineRunTimeSelectionTable(SmoothingModel, dictionary);
defineRunTimeSelectionTable(VoidFractionModel, dictionary);

} // namespace clepsydra

namespace
{

constexpr double demStep = 4e-5;

template<class Model>
void known(const Foam::wordList& names)
{
    Model::constructdictionaryConstructorTables();
    for (const Foam::word& name : names)
    {
        Model::dictionaryConstructorTablePtr_->insert(name, nullptr);
    }
}

Foam::Time& timeOfCase()
{
    static Foam::Time time = [] {
        Foam::FatalError.throwExceptions();
        Foam::FatalIOError.throwExceptions();
        Foam::messageStream::level = 0;
        Foam::dynamicCode::allowSystemOperations = 0;
        // At 2, the package's choice, a file name with a blank in it ends the program (with a message and status 1).
        Foam::fileName::debug = 1;
        known<clepsydra::ForceModel>({"SchillerNaumannDrag", "DiFeliceDrag", "gradPForce", "viscForce", "Archimedes",
            "virtualMassForce", "historyForce", "lubricationForce"});
        known<clepsydra::SmoothingModel>({"off", "constDiffSmoothing"});
        known<clepsydra::VoidFractionModel>({"divided", "Gaussian"});
        Foam::dictionary controlDict;
        controlDict.add("startFrom", Foam::word("startTime"));
        controlDict.add("startTime", 0.0);
        controlDict.add("stopAt", Foam::word("endTime"));
        controlDict.add("endTime", 1.0);
        controlDict.add("deltaT", 1e-3);
        controlDict.add("writeInterval", 1.0);
        return Foam::Time(controlDict, ".", ".", "system", "constant", false, false);
    }();
    return time;
}

void read()
{
    const clepsydra::CouplingSettings settings(timeOfCase());
    settings.descriptions();
    settings.writeVtk();
    clepsydra::liggghtsSetup(settings);
    settings.finalRestart();
    settings.demStepsPerCouplingStep(demStep);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    clepsydra::inputFile("constant/couplingProperties", data, size);
    try
    {
        read();
    }
    catch (const Foam::error&) // the user's error, reported with its place; IOerror is one of these
    {
        return 0;
    }
    return 0;
}
