#include "fluidSources.h"

#include "couplingStep/viscousStress.h"
#include "openfoam/compatibility.h"

#include "dlLibraryTable.H"
#include "fvMatrices.H"
#include "fvOptions.H"

#include <array>
#include <utility>

namespace clepsydra
{

namespace
{

const word fileOfOptions("fvOptions");

IOobject optionsIn(const fileName& folder, const Time& time)
{
    return IOobject(fileOfOptions, folder, time, IOobject::NO_READ, IOobject::NO_WRITE, false);
}

/// File of the options, constant/fvOptions or system/fvOptions; empty where there is none. Collective.
fileName findOptions(const Time& time)
{
    const fileName inConstant = clepsydra::typeFilePath<IOdictionary>(optionsIn(time.constant(), time));
    const fileName inSystem = clepsydra::typeFilePath<IOdictionary>(optionsIn(time.system(), time));
    if (!inConstant.empty() && !inSystem.empty())
    {
        FatalErrorInFunction << "There are both " << inConstant << " and " << inSystem
                             << "; allowed: one of them, because OpenFOAM would read constant/fvOptions only"
                             << exit(FatalError);
    }
    return inConstant.empty() ? inSystem : inConstant;
}

/// Why a type of option is wrong in this solver, although OpenFOAM would apply it; empty where it is not.
std::string objectionTo(const word& type)
{
    const std::array<std::pair<const char*, const char*>, 2> objections = {{
        {"buoyancyForce", "p is without its hydrostatic part, and constant/g has the gravity"},
        {"tabulatedAccelerationSource", "it would accelerate the fluid's frame of reference, but not the particles'"},
    }};
    for (const auto& [name, reason] : objections)
    {
        if (type == name)
        {
            return reason;
        }
    }
    return type.ends_with("PhaseLimitStabilization") ? "OpenFOAM applies it in equations of several phases only" : "";
}

void checkOptions(fv::options& options, const word& velocity)
{
    const dictionary& all = options;
    for (const fv::option& option : static_cast<const fv::optionList&>(options))
    {
        const dictionary& dict = all.subOrEmptyDict("options").found(option.name())
                                     ? all.subDict("options").subDict(option.name())
                                     : all.subDict(option.name());
        if (!dict.getOrDefault<bool>("active", true))
        {
            continue;
        }
        const word type = dict.get<word>("type");
        if (option.applyToField(velocity) < 0)
        {
            FatalIOErrorInFunction(dict) << "Option '" << option.name() << "' of type " << type
                                         << " does not act on the field " << velocity
                                         << ", and options are added to the momentum equation only; allowed: options "
                                         << "that act on " << velocity << exit(FatalIOError);
        }
        if (const std::string objection = objectionTo(type); !objection.empty())
        {
            FatalIOErrorInFunction(dict) << "Option '" << option.name() << "' is of type " << type
                                         << ", which is not allowed, because " << objection.c_str()
                                         << exit(FatalIOError);
        }
    }
}

} // namespace

FluidSources::FluidSources(const fvMesh& mesh, const FluidProperties& fluid, ModelType modelType)
{
    const fileName file = findOptions(mesh.time());
    if (file.empty())
    {
        return;
    }
    // The library is not linked, so that runs without options neither load it nor need it.
    const fileName library("libfvOptions.so");
    if (!const_cast<Time&>(mesh.time()).libs().open(library, false))
    {
        FatalErrorInFunction << "OpenFOAM's library " << library << " could not be loaded, which " << file << " needs"
                             << exit(FatalError);
    }
    nu_ = kinematicViscosity(
        IOobject("nu", mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE), mesh, fluid);
    options_ = &fv::options::New(mesh);
    checkOptions(*options_, "U");
    if (modelType == ModelType::B)
    {
        WarningInFunction << "With modelType B, particles do not receive the pressure gradient that the options in "
                          << file << " cause; where there are particles, use modelType A" << endl;
    }
}

FluidSources::~FluidSources() = default;

void FluidSources::addTo(fvVectorMatrix& UEqn, volVectorField& U, const volScalarField& voidFraction) const
{
    if (options_)
    {
        UEqn -= voidFraction * (*options_)(U);
    }
}

void FluidSources::constrain(fvVectorMatrix& UEqn) const
{
    if (options_)
    {
        options_->constrain(UEqn);
    }
}

void FluidSources::correct(volVectorField& U) const
{
    if (options_)
    {
        options_->correct(U);
    }
}

void warnOfFluidSources(const Time& time)
{
    const fileName file = findOptions(time);
    if (!file.empty())
    {
        WarningInFunction << "The options in " << file << " have no effect, because couplingProperties has fluid none"
                          << endl;
    }
}

} // namespace clepsydra
