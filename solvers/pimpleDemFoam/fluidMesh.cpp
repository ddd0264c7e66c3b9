#include "fluidMesh.h"

#include "openfoam/compatibility.h"
#include "runTimeSelection.h"

#include "IOdictionary.H"
#include "columnFvMesh.H"
#include "staticFvMesh.H"

namespace clepsydra
{

using namespace Foam;

namespace
{

const char* const dictName = "dynamicMeshDict";

/// Whether constant/dynamicMeshDict lets the points of the mesh move. FatalIOError where it asks for anything else.
bool readsMotion(const Time& time)
{
    IOobject file(dictName, time.constant(), time, IOobject::MUST_READ, IOobject::NO_WRITE, false);
    if (clepsydra::typeFilePath<IOdictionary>(file).empty())
    {
        return false;
    }
    const IOdictionary dict(file);
    const word type = dict.getOrDefault<word>("dynamicFvMesh", "none");
    if (type == staticFvMesh::typeName)
    {
        return false;
    }
    if (type != "dynamicMotionSolverFvMesh")
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'dynamicFvMesh' of constant/" << dictName << " is " << type
            << "; allowed: dynamicMotionSolverFvMesh, whose points move, and staticFvMesh, or no "
            << "such file, because cells that are made, refined or removed during the run would "
            << "not hold the particles that the old ones have held" << exit(FatalIOError);
    }
    const word solver = dict.getCompat<word>("motionSolver", {{"solver", -1612}});
    if (solver != "solidBody" && solver != "displacementLaplacian")
    {
        FatalIOErrorInFunction(dict) << "Entry 'motionSolver' of constant/" << dictName << " is " << solver
                                     << "; allowed: solidBody and displacementLaplacian, with which resumed runs have "
                                     << "been tested" << exit(FatalIOError);
    }
    return true;
}

void requireEuler(const fvMesh& mesh)
{
    for (const word name : {"ddt(voidFraction,U)", "ddt(voidFraction)", "ddt(voidFraction,k)", "ddt(voidFraction,T)"})
    {
        const token first(mesh.ddtScheme(name));
        if (!first.isWord() || first.wordToken() != "Euler")
        {
            FatalErrorInFunction << "The scheme '" << name << "' in system/fvSchemes is " << first
                                 << "; allowed while the "
                                 << "mesh moves: Euler, because a resumed run has the volumes of one step only"
                                 << exit(FatalError);
        }
    }
}

/// OpenFOAM's own lines, which replace the mesh with `-dry-run`.
autoPtr<fvMesh> meshAtRest(const argList& args, const Time& runTime)
{
#include "createMesh.H"
    static_cast<void>(mesh);
    return meshPtr;
}

} // namespace

FluidMesh::FluidMesh(const argList& args, const Time& time)
{
    const bool isReplaced = args.found("dry-run") || args.found("dry-run-write");
    if (!readsMotion(time) || isReplaced)
    {
        mesh_ = meshAtRest(args, time);
        return;
    }
    Info << "Create mesh for time = " << time.timeName() << nl << endl;
    autoPtr<dynamicFvMesh> mesh(
        dynamicFvMesh::New(IOobject(fvMesh::defaultRegion, time.timeName(), time, IOobject::MUST_READ)));
    dynamic_ = mesh.get();
    mesh_.reset(mesh.release());
}

void FluidMesh::requireCaseForMotion(const CouplingSettings& settings, const FluidProperties& fluid) const
{
    if (!moves())
    {
        if (const word entry = "patchesWithoutDemWall"; settings.dict().found(entry))
        {
            FatalIOErrorInFunction(settings.dict())
                << "Entry '" << entry << "' has no effect on a mesh at rest; allowed: "
                << "together with a motion in constant/" << dictName << exit(FatalIOError);
        }
        return;
    }
    const fvMesh& mesh = *mesh_;
    const IOdictionary dict(
        IOobject(dictName, mesh.time().constant(), mesh.time(), IOobject::MUST_READ, IOobject::NO_WRITE, false));
    const auto refuse = [&](const std::string& objection) {
        FatalIOErrorInFunction(dict) << "The mesh moves, " << objection.c_str() << exit(FatalIOError);
    };
    if (!settings.hasFluid())
    {
        refuse(
            "but entry 'fluid' of constant/couplingProperties is none; allowed: staticFvMesh, or no such file, because "
            "particles alone have no mesh");
    }
    if (!settings.ddtVoidFraction())
    {
        refuse(
            "and entry 'useDDTvoidfraction' of constant/couplingProperties is off; allowed: on, because the volume of "
            "the cells changes with their void fraction");
    }
    if (fluid.stratification.isThere())
    {
        refuse(
            "and constant/transportProperties has a stratified liquid; allowed: one of them, because the layers do not "
            "move with the mesh");
    }
    const Periodicity periodic = periodicityOf(mesh);
    for (const std::string& patches : periodic.patches)
    {
        if (!patches.empty())
        {
            refuse("and has the cyclic patches " + patches
                   + "; allowed: one of them, because the periodic box of the particles is at rest");
        }
    }
    const dictionary& pimple = mesh.solutionDict().subOrEmptyDict("PIMPLE");
    if (pimple.getOrDefault<Switch>("moveMeshOuterCorrectors", false))
    {
        FatalIOErrorInFunction(pimple)
            << "Entry 'moveMeshOuterCorrectors' of PIMPLE in system/fvSolution is on; allowed: "
            << "off, because the particles are located once in a coupling step, after the mesh "
            << "has moved" << exit(FatalIOError);
    }
    requireEuler(mesh);
}

} // namespace clepsydra
