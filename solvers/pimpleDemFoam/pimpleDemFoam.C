// Solver for particles in a fluid. OpenFOAM solves the volume-averaged Navier-Stokes equations by PIMPLE, and LIGGGHTS
// moves the particles in the same process. With `fluid none;` in constant/couplingProperties the run is DEM only.

#include "checkpoint/caseLock.h"
#include "checkpoint/checkpoints.h"
#include "checkpoint/runTime.h"
#include "files/standardStreams.h"
#include "files/wholeFile.h"
#include "couplingStep/couplingStep.h"
#include "demProgram.h"
#include "ignoredInputs.h"
#include "fluidMesh.h"
#include "fluidSources.h"
#include "fluidTemperature.h"
#include "modelLines.h"
#include "mpiSession.h"
#include "run/caseSizes.h"
#include "run/runOutput.h"
#include "runTimeSelection.h"
#include "turbulence.h"
#include "vectors.h"
#include "voidFractionFlow.h"

#include "fvCFD.H"
#include "uniformDimensionedFields.H"

#include <algorithm>
#include <optional>
#include <string_view>

namespace
{

using namespace clepsydra;

/// What a case with fluid states of it.
struct Fluid
{
    FluidProperties properties = {};
    /// Empty where the case has no temperatures.
    std::optional<Energy> energy = {};
};

Fluid readFluid(const Time& runTime, const boundBox& mesh, const CouplingSettings& settings)
{
    const IOdictionary transportProperties(
        IOobject("transportProperties", runTime.constant(), runTime, IOobject::MUST_READ, IOobject::NO_WRITE));
    const uniformDimensionedVectorField g(
        IOobject("g", runTime.constant(), runTime, IOobject::MUST_READ, IOobject::NO_WRITE));

    requireKnownEntries(
        transportProperties, {"transportModel", "rho", "nu", "Cp", "kappa", "Prt", "beta", "TRef"}, {"stratification"});
    if (transportProperties.found("transportModel"))
    {
        selectedModel(transportProperties, "transportModel", {"Newtonian"});
    }
    const auto positive = [&](const word& entry, const dimensionSet& dimensions) {
        const dimensionedScalar value(entry, dimensions, transportProperties);
        requirePositive(transportProperties, entry, value.value());
        return value.value();
    };
    const double density = positive("rho", dimDensity);
    const double kinematicViscosity = positive("nu", dimViscosity);

    const Vector3d gravity = toEigen(g.value());
    const FluidProperties properties{density, density * kinematicViscosity, gravity,
        readStratification(transportProperties, gravity, mesh), readTurbulence(runTime)};
    return {properties, readEnergy(settings, transportProperties, !properties.turbulence.empty())};
}

/// Writes the particles for other runs, with a checksum that these runs check.
void writeFinalParticles(DemEngine& engine, const std::filesystem::path& file)
{
    // Removes the checksums of an earlier run first. The particles are in one file, or in parts, of which this rank
    // writes one and the first rank also the base.
    for (const std::string& part : {std::string("base"), std::to_string(Pstream::myProcNo())})
    {
        std::string name = file;
        if (const std::size_t at = name.find('%'); at != std::string::npos)
        {
            name.replace(at, 1, part);
        }
        std::filesystem::remove(checksumName(name));
    }
    for (const std::filesystem::path& written : engine.writeCheckpoint(file))
    {
        writeChecksum(written);
    }
}

/// Suppresses the solvers' lines on a terminal, where they would break the progress bar. In a log they remain.
class QuietOnTerminal
{
public:
    explicit QuietOnTerminal(const RunOutput& output)
    {
        if (output.onTerminal())
        {
            messageStream::level = 0;
        }
    }

    ~QuietOnTerminal()
    {
        messageStream::level = before_;
    }

    QuietOnTerminal(const QuietOnTerminal&) = delete;
    QuietOnTerminal& operator=(const QuietOnTerminal&) = delete;

private:
    const int before_ = messageStream::level;
};

/// \param temperature  null where the case has none
void runWithFluid(RunTime& runTime, FluidMesh& mesh, DemProgram& demProgram, const FluidProperties& fluid,
    ModelType modelType, FluidModels& models, FluidTemperature* temperature, CouplingStep& couplingStep,
    RunOutput& output, bool resumed)
{
    VoidFractionFlow flow(*mesh, mesh.moves(), fluid, modelType, models.viscousStress, couplingStep.timers());
    flow.addTurbulence(fluid, couplingStep.fluid().voidFraction(), resumed);
    if (temperature)
    {
        flow.setAcceleration(temperature->buoyancy());
    }
    couplingStep.start(flow.U(), flow.phi(), flow.p());
    flow.updateAlphaPhi(couplingStep.fluid().voidFraction());
    output.start();

    while (runTime.loop(couplingStep.lengthWithin(runTime.timeLeft())))
    {
        if (mesh.moves())
        {
            const PhaseTimers::Scope timing = couplingStep.timers().time("mesh");
            const QuietOnTerminal quiet(output);
            mesh.move();
            couplingStep.meshMoved();
            flow.meshMoved();
            if (temperature)
            {
                temperature->meshMoved();
            }
        }
        ParticlesInFluid particles = couplingStep.advanceParticles(runTime.timeLeft());
        if (mesh.moves())
        {
            demProgram.checkMovedWalls(flow.U());
        }
        const SolvedStep solved = [&] {
            const QuietOnTerminal quiet(output);
            Info << "Time = " << runTime.timeName() << nl;
            return flow.solve(particles);
        }();
        if (temperature)
        {
            const QuietOnTerminal quiet(output);
            const PhaseTimers::Scope timing = couplingStep.timers().time("heat");
            temperature->solve(particles, flow.alphaPhi(), models.viscousStress.turbulence());
        }
        couplingStep.fluidToParticles(
            solved, flow.U(), flow.phi(), flow.p(), [&](RankTotals& totals) { output.addTo(totals); });
        if (output.afterCouplingStep())
        {
            couplingStep.restartInPlace(flow.U(), flow.p());
        }
    }
}

void runDemOnly(RunTime& runTime, CouplingStep& couplingStep, RunOutput& output)
{
    output.start();
    while (runTime.loop(couplingStep.lengthWithin(runTime.timeLeft())))
    {
        couplingStep.advance([&](RankTotals& totals) { output.addTo(totals); });
        if (output.afterCouplingStep())
        {
            couplingStep.restartInPlace();
        }
    }
}

} // namespace

int main(int argc, char* argv[])
{
    openClosedStandardStreams();
    argList::addNote("Particles in a fluid: PIMPLE coupled with LIGGGHTS as constant/couplingProperties states");
    // OpenFOAM's own -dry-run replaces the mesh by a column of cells; this option checks the case as it is.
    argList::addBoolOption("dryRun", "Case check: start the case, solve one coupling step, write nothing");
    argList::addBoolOption("listModels", "List every model that a case may name, with one line on each");
    // This option works before OpenFOAM's banner and in any folder.
    if (std::find(argv, argv + argc, std::string_view("-listModels")) != argv + argc)
    {
        listModels();
        return 0;
    }
#include "setRootCase.H"
    const bool dryRun = args.found("dryRun");
    std::optional<MpiSession> mpi;
    try
    {
        mpi.emplace();
    }
    catch (const std::exception& error)
    {
        FatalErrorInFunction << error.what() << exit(FatalError);
    }
    chDir(args.globalPath());
    std::unique_ptr<CaseLock> lock;
    word start;
    if (dryRun)
    {
        start = Checkpoints::startInPlaceOfUnusable(args);
    }
    else
    {
        lock = std::make_unique<CaseLock>(args.globalPath());
        Checkpoints::setAsideUnusable(args);
    }

    RunTime runTime = start.empty() ? RunTime(args) : RunTime(args, start);
    refuseRenamedFunctionObjects(runTime);
    FluidMesh fluidMesh(args, runTime);
    fvMesh& mesh = *fluidMesh;

    const CouplingSettings settings(runTime);
    requireParticlesWithinMesh(settings.demDict().subOrEmptyDict("variables"), mesh.bounds());
    const Fluid input = settings.hasFluid() ? readFluid(runTime, mesh.bounds(), settings) : Fluid{};
    const FluidProperties& fluid = input.properties;
    fluidMesh.requireCaseForMotion(settings, fluid);
    if (settings.hasFluid())
    {
        refuseUnsupported(mesh);
        checkSchemes(mesh, "U");
        if (input.energy)
        {
            checkSchemes(mesh, "T");
        }
        checkScalarTransport(mesh);
    }
    else
    {
        warnOfFluidSources(runTime);
    }
    PhaseTimers timers;
    const auto models = settings.hasFluid() ? std::make_unique<FluidModels>(mesh, settings, fluid, timers) : nullptr;
    try
    {
        autoPtr<DemProgram> demProgram = DemProgram::New(settings, dryRun);
        const Checkpoints checkpoints(runTime, RunInputs(mesh, fluidMesh.moves(), demProgram->inputs()), !dryRun);
        if (checkpoints.resumed())
        {
            runTime.resume(checkpoints.beginning());
        }
        DemEngine& engine = demProgram->start(checkpoints, mesh, fluidMesh.moves(), models ? &fluid : nullptr);
        std::optional<FluidTemperature> temperature;
        if (input.energy)
        {
            temperature.emplace(mesh, *input.energy, fluid, engine);
        }
        CouplingStep couplingStep(mesh, settings, fluid, engine, models.get(), timers, checkpoints.resumed());
        demProgram->warnOfUnreadInput();
        RunOutput output(
            runTime, mesh, settings, fluid, engine, models.get(), input.energy, couplingStep, checkpoints, dryRun);

        if (models)
        {
            runWithFluid(runTime, fluidMesh, *demProgram, fluid, settings.modelType(), *models,
                temperature ? &*temperature : nullptr, couplingStep, output, checkpoints.resumed());
        }
        else
        {
            runDemOnly(runTime, couplingStep, output);
        }

        output.finish();
        // Later steps of a case take this file as the state at the end of the run, so a stopped run must not write it.
        if (!dryRun && !output.stopped() && !settings.finalRestart().empty())
        {
            writeFinalParticles(engine, settings.finalRestart().c_str());
        }
    }
    catch (const DemEngineError& error)
    {
        FatalErrorInFunction << error.what() << nl << nl
                             << "file: " << settings.demDict().get<fileName>("script").c_str() << exit(FatalError);
    }
    catch (const std::exception& error)
    {
        FatalErrorInFunction << error.what() << exit(FatalError);
    }

    Info << "End\n" << endl;
    return 0;
}
