#include "engine/liggghts/liggghtsEngine.h"

#include "engine/liggghts/fluidForceFix.h"
#include "engine/liggghts/fasterParts.h"
#include "engine/liggghts/insertionCheck.h"
#include "engine/liggghts/lastForces.h"
#include "engine/liggghts/liggghtsParticles.h"
#include "engine/liggghts/liggghtsProgram.h"
#include "engine/liggghts/meshWalls.h"
#include "engine/liggghts/outputFiles.h"
#include "engine/liggghts/particleChecks.h"
#include "engine/liggghts/removal.h"
#include "engine/liggghts/restartFiles.h"
#include "engine/liggghts/scriptRun.h"
#include "engine/liggghts/subdomains.h"

#include <atom.h>
#include <lammps.h>
#include <universe.h>
#include <update.h>

#include <optional>
#include <sstream>

namespace clepsydra
{

/// In the order in which they are made.
struct LiggghtsEngine::Parts
{
    explicit Parts(const LiggghtsSetup& setup)
        : resumed(!setup.resumeFrom.empty()),
          outputFiles(setup.logFile, setup.outputs, resumed),
          program(setup.logFile, setup.communicator, setup.onWarning),
          commands((registerHertzPairStyle(), replaceNeighbourSearch(program), replaceMeshWallContacts(program),
              allowUnequalSubdomains(program), runScript(program, outputFiles, setup)))
    {
        for (const GroupChange& change : setup.groupChanges)
        {
            groupChangers.emplace_back(*program, change);
        }
    }

    const bool resumed;
    OutputFiles outputFiles;
    LiggghtsProgram program;
    const std::vector<ScriptCommand> commands;
    std::vector<GroupChanger> groupChangers;
    LiggghtsParticles particles{program};
    InsertionCheck insertionCheck{particles};
    // From initialise() on; without a fluid there is no fix.
    std::optional<LastForces> lastForces;
    std::optional<FluidForceFix> fluidForceFix;
};

LiggghtsEngine::LiggghtsEngine(const LiggghtsSetup& setup)
    : parts_(std::make_unique<Parts>(setup))
{}

LiggghtsEngine::~LiggghtsEngine() = default;

ScriptFacts LiggghtsEngine::scriptFacts() const
{
    return factsOf(parts_->program, parts_->commands);
}

std::vector<ScriptCommand> LiggghtsEngine::unreadProperties() const
{
    return clepsydra::unreadProperties(parts_->program, parts_->commands);
}

void LiggghtsEngine::requestPairs(double reach, std::size_t ofState)
{
    parts_->particles.requestPairs(reach, ofState);
}

void LiggghtsEngine::requestState(const std::vector<double>& ofNewParticle)
{
    parts_->particles.requestState(ofNewParticle);
}

void LiggghtsEngine::requestMemory(int numbers)
{
    parts_->particles.requestMemory(numbers);
}

void LiggghtsEngine::requestTemperatures(const HeatOfParticles& heat)
{
    parts_->particles.requestTemperatures(heat);
}

TemperaturesView LiggghtsEngine::temperatures()
{
    return parts_->particles.temperatures();
}

void LiggghtsEngine::initialise(FluidForces* forces)
{
    LiggghtsProgram& program = parts_->program;
    parts_->particles.addProperties(parts_->resumed);
    parts_->lastForces.emplace(program, parts_->resumed);
    for (const GroupChanger& changer : parts_->groupChangers)
    {
        if (const std::string command = changer.propertyCommand(); !command.empty())
        {
            program.execute(command, "group changes");
        }
    }
    if (forces)
    {
        parts_->fluidForceFix.emplace(program, parts_->particles, parts_->insertionCheck, *forces);
    }
    requireNoNegativeFriction(*program);
    // ParticleCensus finds and reports lost particles with their ids; LIGGGHTS would end the process.
    program.execute("thermo_modify lost ignore flush yes", "initialise");
    requireParticlesInBox(*program);
    allowNoParticles(program);
    prepare();
    // LIGGGHTS writes again, in a resumed run, what it had written at the step of the checkpoint.
    parts_->outputFiles.cutToCheckpoint();
    parts_->insertionCheck.atStart(program, !parts_->resumed);
}

void LiggghtsEngine::prepare()
{
    parts_->program.execute("run 0 post no", "preparing");
    requireFiniteForces(*parts_->program);
    parts_->lastForces->restore();
}

void LiggghtsEngine::evaluateFluidForces()
{
    parts_->lastForces->forget();
    parts_->fluidForceFix->evaluateWhilePreparing(true);
    prepare();
    parts_->fluidForceFix->evaluateWhilePreparing(false);
    parts_->lastForces->store();
}

void LiggghtsEngine::advance(int steps)
{
    runSteps(steps);
    parts_->lastForces->store();
    for (GroupChanger& changer : parts_->groupChangers)
    {
        changer.apply(steps * timeStep());
    }
}

void LiggghtsEngine::runSteps(int steps)
{
    LiggghtsProgram& program = parts_->program;
    const int before = program->atom->nlocal;
    const double timeStepBefore = timeStep();
    try
    {
        program.execute("run " + std::to_string(steps) + " pre no post no", "DEM steps of a coupling step");
        requireFiniteForces(*program);
        if (!parts_->fluidForceFix)
        {
            parts_->insertionCheck.afterStep(program);
        }
        parts_->outputFiles.requireWritten();
    }
    catch (const DemEngineError& error)
    {
        // LIGGGHTS' own message would be about atom types. Where some particles are left it continues, and
        // ParticleCensus names the missing ones.
        if (before > 0 && program->atom->nlocal == 0)
        {
            throw DemEngineError(
                "No particle is left of the " + std::to_string(before)
                + " that were on a rank: " + lastParticleText(*program)
                + ". If its speed is that of free fall, a wall is missing; if it is much larger, a time "
                  "step is too long; allowed: a wall in the DEM script "
                  "wherever the fluid has one, and a DEM step and a coupling step that are short "
                  "enough");
        }
        throw;
    }
    if (timeStep() != timeStepBefore)
    {
        std::ostringstream message;
        message << "The script changes the DEM step during the run, from " << timeStepBefore << " s to " << timeStep()
                << " s; allowed: a DEM step that remains the same, because a coupling step is a number of DEM steps";
        throw DemEngineError(message.str());
    }
}

void LiggghtsEngine::remove(const std::vector<int>& ids)
{
    parts_->insertionCheck.setCount(removeParticles(parts_->program, ids));
    allowNoParticles(parts_->program);
}

ParticlesView LiggghtsEngine::particles()
{
    return parts_->particles.view();
}

double LiggghtsEngine::timeStep() const
{
    return parts_->program->update->dt;
}

Vector3d LiggghtsEngine::gravity() const
{
    return gravityOf(parts_->program);
}

PeriodicBox LiggghtsEngine::periodicBox() const
{
    return periodicBoxOf(parts_->program);
}

Vector3d LiggghtsEngine::unwrappedPosition(Eigen::Index particle)
{
    return parts_->particles.unwrappedPosition(particle);
}

std::vector<WallTriangle> LiggghtsEngine::movingWalls() const
{
    return trianglesOfMovingMeshes(parts_->program);
}

std::vector<ContactMaterial> LiggghtsEngine::contactMaterials() const
{
    return contactMaterialsOf(parts_->program);
}

std::vector<std::filesystem::path> LiggghtsEngine::writeCheckpoint(const std::filesystem::path& name)
{
    return writeRestart(parts_->program, name);
}

std::vector<EngineOutput> LiggghtsEngine::outputs()
{
    return parts_->outputFiles.outputs();
}

std::string LiggghtsEngine::version() const
{
    return std::string("LIGGGHTS ") + parts_->program->universe->version;
}

} // namespace clepsydra
