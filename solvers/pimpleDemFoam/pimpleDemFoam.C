// Grains and water: OpenFOAM solves the volume-averaged Navier-Stokes equations by PIMPLE, LIGGGHTS moves the beads,
// both in this process. With `fluid none;` in constant/couplingProperties the beads move alone.

#include "checkpoint/caseLock.h"
#include "interval/couplingInterval.h"
#include "mpiSession.h"
#include "output/runOutput.h"

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

void runWithFluid(
    Time& runTime, fvMesh& mesh, const FluidProperties& fluid, CouplingInterval& interval, RunOutput& output)
{
    pimpleControl pimple(mesh);
    #include "createFields.H"

    const FluidCoupling& beadsOnFluid = interval.fluid();
    const volScalarField& voidFraction = beadsOnFluid.voidFraction();
    interval.start(U, p);

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
        output.afterInterval();
    }
}

void runDry(Time& runTime, CouplingInterval& interval, RunOutput& output)
{
    while (runTime.loop())
    {
        interval.advance();
        output.afterInterval();
    }
}

} // namespace

int main(int argc, char* argv[])
{
    argList::addNote("Grains in water: PIMPLE with LIGGGHTS beads, coupled by constant/couplingProperties");
    #include "setRootCase.H"
    const MpiSession mpi;
    chDir(args.globalPath());
    const CaseLock lock(args.globalPath());

    #include "createTime.H"
    #include "createMesh.H"

    try
    {
        const CouplingSettings settings(runTime);
        LiggghtsEngine engine(settings.engineSetup());
        const FluidProperties fluid = settings.hasFluid() ? readFluidProperties(runTime) : FluidProperties{};
        CouplingInterval interval(mesh, settings, fluid, engine);

        RunOutput output(runTime, mesh, settings, fluid, engine, interval);

        if (settings.hasFluid())
        {
            requireSameGravity(fluid, engine);
            runWithFluid(runTime, mesh, fluid, interval, output);
        }
        else
        {
            runDry(runTime, interval, output);
        }

        output.finish();
        if (!settings.finalRestart().empty())
        {
            engine.writeCheckpoint(settings.finalRestart().c_str());
        }
    }
    catch (const DemEngineError& error)
    {
        FatalErrorInFunction << error.what() << exit(FatalError);
    }

    Info<< "End\n" << endl;
    return 0;
}
