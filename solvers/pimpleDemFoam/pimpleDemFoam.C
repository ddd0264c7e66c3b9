// Grains and water: OpenFOAM solves the volume-averaged Navier-Stokes equations by PIMPLE, LIGGGHTS moves the beads,
// both in this process. With `fluid none;` in constant/couplingProperties the beads move alone.

#include "checkpoint/caseLock.h"
#include "checkpoint/checkpoints.h"
#include "interval/couplingInterval.h"
#include "mpiSession.h"
#include "output/demTimeScales.h"
#include "output/runOutput.h"
#include "output/startReport.h"

#include "constrainHbyA.H"
#include "constrainPressure.H"
#include "fvCFD.H"
#include "pimpleControl.H"
#include "uniformDimensionedFields.H"

namespace
{

using namespace clepsydra;

FluidProperties readFluidProperties(const Time& runTime)
{
    const IOdictionary transportProperties(
        IOobject("transportProperties", runTime.constant(), runTime, IOobject::MUST_READ, IOobject::NO_WRITE));
    const uniformDimensionedVectorField g(
        IOobject("g", runTime.constant(), runTime, IOobject::MUST_READ, IOobject::NO_WRITE));

    const auto positive = [&](const word& entry, const dimensionSet& dimensions) {
        const dimensionedScalar value(entry, dimensions, transportProperties);
        if (!(value.value() > 0))
        {
            FatalIOErrorInFunction(transportProperties)
                << "Entry '" << entry << "' is " << value.value() << "; allowed: a number > 0" << exit(FatalIOError);
        }
        return value.value();
    };
    const double density = positive("rho", dimDensity);
    const double kinematicViscosity = positive("nu", dimViscosity);

    return {density, density*kinematicViscosity, Vector3d(g.value().x(), g.value().y(), g.value().z())};
}

/// Everything that the dictionaries say of models, before LIGGGHTS starts and opens its log: a case with a mistake
/// stays as it was.
void checkModels(const fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid)
{
    const Ledger ledger(settings.dict(), mesh.time());
    if (settings.hasFluid())
    {
        PhaseTimers timers;
        const BeadForces forces(settings.dict(), fluid, timers);
        const Distribution distribution(settings.dict(), mesh);
    }
}

/// The weight of the beads is the DEM script's, their buoyancy is constant/g's.
void requireSameGravity(const FluidProperties& fluid, const DemEngine& engine)
{
    const Vector3d dem = engine.gravity();
    if ((fluid.gravity - dem).norm() > 1e-6*fluid.gravity.norm())
    {
        FatalErrorInFunction << "constant/g is (" << fluid.gravity.x() << ' ' << fluid.gravity.y() << ' '
                             << fluid.gravity.z() << ") m/s2, fix gravity of the DEM script gives (" << dem.x() << ' '
                             << dem.y() << ' ' << dem.z() << ") m/s2; allowed: the same in both" << exit(FatalError);
    }
}

/// \param startOutput  makes the RunOutput, once there are the fields that function objects may look for.
template<class StartOutput>
void runWithFluid(Time& runTime, fvMesh& mesh, const FluidProperties& fluid, CouplingInterval& interval,
    const StartOutput& startOutput)
{
    pimpleControl pimple(mesh);
    #include "createFields.H"

    const FluidCoupling& beadsOnFluid = interval.fluid();
    const volScalarField& voidFraction = beadsOnFluid.voidFraction();
    interval.start(U, p);
    RunOutput output = startOutput();

    while (runTime.loop())
    {
        interval.advance(U, p, [&] {
            while (pimple.loop())
            {
                #include "UEqn.H"
                while (pimple.correct())
                {
                    #include "pEqn.H"
                }
            }
        });
        if (output.afterInterval())
        {
            interval.restartInPlace(U, p);
        }
    }
    output.finish();
}

template<class StartOutput>
void runDry(Time& runTime, CouplingInterval& interval, const StartOutput& startOutput)
{
    RunOutput output = startOutput();
    while (runTime.loop())
    {
        interval.advance();
        if (output.afterInterval())
        {
            interval.restartInPlace();
        }
    }
    output.finish();
}

} // namespace

int main(int argc, char* argv[])
{
    argList::addNote("Grains in water: PIMPLE with LIGGGHTS beads, coupled by constant/couplingProperties");
    #include "setRootCase.H"
    const MpiSession mpi;
    chDir(args.globalPath());
    const CaseLock lock(args.globalPath());
    Checkpoints::setAsideUnfinished(args);

    #include "createTime.H"
    #include "createMesh.H"

    const CouplingSettings settings(runTime);
    try
    {
        const FluidProperties fluid = settings.hasFluid() ? readFluidProperties(runTime) : FluidProperties{};
        checkModels(mesh, settings, fluid);
        const Checkpoints checkpoints(runTime);
        LiggghtsEngine engine(settings.engineSetup(checkpoints.beads()));
        CouplingInterval interval(mesh, settings, fluid, engine, checkpoints.resumed());
        if (settings.hasFluid())
        {
            requireSameGravity(fluid, engine);
        }
        checkDemStep(demTimeScales(engine, settings.couplingInterval(), nullptr, mesh), settings.demDict());

        const auto startOutput = [&] {
            // They check their entries when they start: before RunOutput replaces beads of an earlier run.
            runTime.functionObjects().start();
            return RunOutput(runTime, mesh, settings, fluid, engine, interval, checkpoints);
        };
        if (settings.hasFluid())
        {
            runWithFluid(runTime, mesh, fluid, interval, startOutput);
        }
        else
        {
            runDry(runTime, interval, startOutput);
        }

        if (!settings.finalRestart().empty())
        {
            engine.writeCheckpoint(settings.finalRestart().c_str());
        }
    }
    catch (const DemEngineError& error)
    {
        FatalErrorInFunction << error.what() << nl << nl << "file: "
                             << settings.demDict().get<fileName>("script").c_str() << exit(FatalError);
    }

    Info<< "End\n" << endl;
    return 0;
}
