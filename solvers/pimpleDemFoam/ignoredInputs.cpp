#include "ignoredInputs.h"

#include "tokens/renamed.h"

#include "IOdictionary.H"
#include "Time.H"

#include <map>

namespace clepsydra
{

using namespace Foam;

void refuseRenamedFunctionObjects(const Time& time)
{
    for (const entry& item : time.controlDict().subOrEmptyDict("functions"))
    {
        const word type = item.isDict() ? item.dict().getOrDefault<word>("type", word::null) : word::null;
        if (const Renamed* const change = renamed(type))
        {
            FatalIOErrorInFunction(item.dict())
                << "Function object '" << item.keyword() << "' has the type '" << type << "', which is now called '"
                << change->newName.c_str() << "'" << exit(FatalIOError);
        }
    }
}

void refuseUnsupported(const fvMesh& mesh)
{
    const IOdictionary zones(
        IOobject("MRFProperties", mesh.time().constant(), mesh, IOobject::READ_IF_PRESENT, IOobject::NO_WRITE, false));
    for (const entry& item : zones)
    {
        if (item.isDict() && item.dict().getOrDefault<bool>("active", true))
        {
            FatalIOErrorInFunction(item.dict())
                << "The rotating zone '" << item.keyword()
                << "' (MRF) would have no effect, because this solver has no "
                << "rotating frames; allowed: active no;, a moving mesh (constant/dynamicMeshDict), or no such file"
                << exit(FatalIOError);
        }
    }
    const dictionary& pimple = mesh.solutionDict().subOrEmptyDict("PIMPLE");
    for (const auto& [entry, only] :
        std::map<word, bool>{{"consistent", false}, {"transonic", false}, {"frozenFlow", false}, {"solveFlow", true}})
    {
        if (pimple.getOrDefault<bool>(entry, only) != only)
        {
            FatalIOErrorInFunction(pimple) << "'" << entry << ' ' << (only ? "no" : "yes")
                                           << "' has no effect in this solver; allowed: " << (only ? "yes" : "no")
                                           << ", or no such entry" << exit(FatalIOError);
        }
    }
}

void checkScalarTransport(const fvMesh& mesh)
{
    for (const entry& item : mesh.time().controlDict().subOrEmptyDict("functions"))
    {
        if (!item.isDict() || item.dict().getOrDefault<word>("type", word::null) != "scalarTransport"
            || !item.dict().getOrDefault<bool>("enabled", true))
        {
            continue;
        }
        const dictionary& dict = item.dict();
        const word field = dict.getOrDefault<word>("field", "s");
        const word flux = dict.getOrDefault<word>("phi", "phi");
        // OpenFOAM takes this scheme whatever the flux is called.
        const word scheme("div(phi," + dict.getOrDefault<word>("schemesField", field) + ')');
        const token first(mesh.divScheme(scheme));
        if (first.isWord() && first.wordToken() == "bounded")
        {
            continue;
        }
        if (flux == "phi")
        {
            FatalIOErrorInFunction(dict)
                << "Function object '" << item.keyword() << "' (scalarTransport) would change a uniform " << field
                << ", because the flux phi between the particles is not solenoidal; allowed: a scheme '" << scheme
                << "' in system/fvSchemes that begins with 'bounded', such as bounded Gauss upwind"
                << exit(FatalIOError);
        }
        WarningInFunction << "Function object '" << item.keyword() << "' (scalarTransport) with the flux " << flux
                          << " is right only where the void fraction does not change in time, and for a steady "
                          << field << "; otherwise use phi with a scheme '" << scheme
                          << "' in system/fvSchemes that begins with 'bounded'" << endl;
    }
}

} // namespace clepsydra
