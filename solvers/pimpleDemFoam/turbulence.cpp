#include "turbulence.h"

#include "knownEntries.h"
#include "openfoam/compatibility.h"
#include "runTimeSelection.h"

#include "IOdictionary.H"

#include <dlfcn.h>

#include <filesystem>

namespace clepsydra
{

using namespace Foam;

namespace
{

const ModelLines simulationTypes("turbulenceProperties { simulationType }",
    {{"laminar", "no turbulence model (the default)"}, {"RAS", "Reynolds-averaged equations, closed by RASModel"},
        {"LES", "filtered equations of large eddies, closed by LESModel"}});

const ModelLines rasModels("turbulenceProperties { RAS { RASModel } }",
    {{"kEpsilon", "standard k-epsilon model"}, {"RNGkEpsilon", "k-epsilon model of the renormalisation group"},
        {"realizableKE", "realizable k-epsilon model"},
        {"LaunderSharmaKE", "k-epsilon model of Launder and Sharma for low Reynolds numbers"},
        {"kOmega", "k-omega model of Wilcox"}, {"kOmegaSST", "k-omega model of Menter, shear-stress transport"},
        {"kOmegaSSTSAS", "kOmegaSST with scale-adaptive simulation"},
        {"kOmegaSSTLM", "kOmegaSST with the transition model of Langtry and Menter"},
        {"SpalartAllmaras", "one equation, for the eddy viscosity"}});

const ModelLines lesModels("turbulenceProperties { LES { LESModel } }",
    {{"Smagorinsky", "Smagorinsky's eddy viscosity"}, {"WALE", "wall-adapting local eddy viscosity"},
        {"kEqn", "one equation, for k of the eddies below the filter width"},
        {"dynamicKEqn", "kEqn with coefficients from the resolved flow"},
        {"dynamicLagrangian", "Smagorinsky with a coefficient averaged along path lines"},
        {"SpalartAllmarasDES", "detached eddies with SpalartAllmaras"},
        {"SpalartAllmarasDDES", "delayed detached eddies with SpalartAllmaras"},
        {"SpalartAllmarasIDDES", "improved delayed detached eddies with SpalartAllmaras"},
        {"kOmegaSSTDES", "detached eddies with kOmegaSST"}, {"kOmegaSSTDDES", "delayed detached eddies with kOmegaSST"},
        {"kOmegaSSTIDDES", "improved delayed detached eddies with kOmegaSST"}});

/// The entry that names the model. OpenFOAM calls it `model`, too, since v2006; earlier versions report the other name.
word entryOfModel(const dictionary& dict, const word& type)
{
    const word name(type + "Model");
    return !dict.found(name) && dict.found("model") ? word("model") : name;
}

/// The program may have been moved with its libraries, whose folder lies beside its own.
std::filesystem::path libraryOfModels()
{
    return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path()
           / "lib/libclepsydraTurbulence.so";
}

NewFluidTurbulence* functionOfLibrary()
{
    const std::filesystem::path file = libraryOfModels();
    // It stays loaded until the end, since OpenFOAM's tables refer to it.
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
    void* const function = library == nullptr ? nullptr : dlsym(library, nameOfNewFluidTurbulence);
    if (function == nullptr)
    {
        FatalErrorInFunction << "The library of turbulence models could not be loaded: " << dlerror()
                             << "; allowed: simulationType laminar in constant/turbulenceProperties, or an "
                             << "installation that has this library and OpenFOAM's turbulence models"
                             << exit(FatalError);
    }
    return reinterpret_cast<NewFluidTurbulence*>(function);
}

} // namespace

std::string readTurbulence(const Time& time)
{
    const IOobject file(
        "turbulenceProperties", time.constant(), time, IOobject::READ_IF_PRESENT, IOobject::NO_WRITE, false);
    if (clepsydra::typeFilePath<IOdictionary>(file).empty())
    {
        return {};
    }
    const IOdictionary dict(file);
    requireKnownEntries(dict, {"simulationType"}, {"laminar", "RAS", "LES"});
    const word type = selectedModel(dict, "simulationType", simulationTypes.names());
    if (type == "laminar")
    {
        const dictionary& laminar = dict.subOrEmptyDict("laminar");
        if (const word entry = entryOfModel(laminar, type); laminar.found(entry))
        {
            selectedModel(laminar, entry, {"Stokes"});
        }
        return {};
    }
    const dictionary& ofType = dict.subDict(type);
    return type + ' '
           + selectedModel(ofType, entryOfModel(ofType, type), type == "RAS" ? rasModels.names() : lesModels.names());
}

std::unique_ptr<FluidTurbulence> newTurbulence(const TurbulentFluid& fluid, bool resumed)
{
    return std::unique_ptr<FluidTurbulence>(functionOfLibrary()(fluid, resumed));
}

} // namespace clepsydra
