#include "couplingStep/couplingStep.h"

#include "couplingStep/checkpointedState.h"
#include "distribution/lengthOfChange.h"
#include "vectors.h"

#include "fvc.H"

#include <algorithm>

namespace clepsydra
{

CouplingStep::CouplingStep(const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
    DemEngine& engine, FluidModels* models, PhaseTimers& timers, bool resumed)
    : settings_(settings),
      engine_(engine),
      length_(settings, mesh.time(), engine.timeStep(), resumed),
      couplingTimeStep_(length_.seconds()),
      resumed_(resumed),
      timers_(timers),
      conservation_(settings.dict(), mesh.time()),
      insertionAndRemoval_(settings.dict(), mesh, settings.couplingTimeStep(), engine.periodicBox()),
      forces_(models ? &models->forces : nullptr)
{
    if (models && models->forces.needs().pairReach > 0)
    {
        engine_.requestPairs(models->forces.needs().pairReach);
    }
    if (models)
    {
        engine_.requestMemory(
            models->forces.needs().memory + TurbulentDispersion::memory(settings.dict()) + checkpointedState::size);
    }
    engine_.requestState(numbersOf(CouplingState::ofNewParticle()));
    engine_.initialise(models ? &models->forces : nullptr);
    conservation_.countParticles(engine_.particles());
    if (models)
    {
        fluid_ = std::make_unique<FluidCoupling>(mesh, settings, fluid, models->forces.needs(), engine,
            models->distribution, models->viscousStress, models->meanPressureGradient, conservation_, timers_);
    }
    conservation_.setInitialSolidVolume(insertionAndRemoval_.start(engine_.particles(), !resumed, findOutsideMesh()));
    if (models)
    {
        lengthOfChange_ = lengthOfChange(models->distribution.smoothingModel().bandwidth(), smallestCellWidth(mesh));
    }
}

void CouplingStep::start(Foam::volVectorField& U, const Foam::volScalarField& p)
{
    AnticipatedParticles first = fluid_->start(resumed_);
    takeDemResult(0);
    fluid_->sample(first, U, p);
    if (!resumed_)
    {
        // The first half of the first DEM step (velocity Verlet) already uses these forces.
        engine_.evaluateFluidForces();
        first = fluid_->subtractFirstDrag(takeDemResult(engine_.timeStep()), U, couplingTimeStep_);
        fluid_->fluidToParticles(first, U, p);
        engine_.evaluateFluidForces();
        takeDemResult(0);
    }
    conservation_.setInitialMomentum(fluid_->semiImplicitMomentum(first));
}

ParticlesInFluid CouplingStep::advanceParticles(const Foam::surfaceScalarField& phi, double timeLeft)
{
    couplingTimeStep_ = length_.seconds();
    const double demTime = length_.steps() * engine_.timeStep();
    advanceDem();
    const DemResult result = takeDemResult(couplingTimeStep_);
    fluid_->checkPressureForce(result.pressureImpulse / demTime);
    if (length_.isAdjustable())
    {
        length_.choose(limits(phi), timeLeft);
    }
    return fluid_->particlesToFluid(result, length_.seconds());
}

void CouplingStep::fluidToParticles(
    const SolvedStep& solved, const Foam::volVectorField& U, const Foam::volScalarField& p)
{
    fluid_->endStep(U, couplingTimeStep_);
    fluid_->fluidToParticles(solved.particles(), U, p);
    solved.checkConservation(fluid_->semiImplicitMomentum(solved.particles()));
    removeParticlesThatLeft();
}

void CouplingStep::advance()
{
    advanceDem();
    removeParticlesThatLeft();
}

void CouplingStep::restartInPlace()
{
    engine_.prepare();
}

void CouplingStep::restartInPlace(const Foam::volVectorField& U, const Foam::volScalarField& p)
{
    const ParticlesView particles = engine_.particles();
    std::fill_n(particles.state, particles.size(), CouplingState());
    engine_.prepare();
    insertionAndRemoval_.start(engine_.particles(), false, findOutsideMesh());
    fluid_->sample(fluid_->start(true), U, p);
    takeDemResult(0);
}

DemResult CouplingStep::takeDemResult(double timeStep)
{
    return clepsydra::takeDemResult(engine_.particles(), *forces_, timeStep);
}

std::vector<CouplingStepLimit> CouplingStep::limits(const Foam::surfaceScalarField& phi) const
{
    const double courant = settings_.adjustableCouplingTimeStep()->largestCourantNumber;
    const double throughCells =
        0.5 * Foam::gMax(Foam::fvc::surfaceSum(Foam::mag(phi))().primitiveField() / phi.mesh().V().field());
    const ParticlesView particles = engine_.particles();
    const double fastestHere = particles.size() > 0 ? particles.velocity.colwise().norm().maxCoeff() : 0;
    const double fastest = returnReduce(fastestHere, Foam::maxOp<double>());
    return {{"Courant number of the fluid", courant / std::max(throughCells, Foam::VSMALL)},
        {"Courant number of the particles", courant * lengthOfChange_ / std::max(fastest, Foam::VSMALL)}};
}

void CouplingStep::advanceDem()
{
    const PhaseTimers::Scope timing = timers_.time("DEM");
    engine_.advance(length_.steps());
    const ParticlesView particles = engine_.particles();
    const int highestBefore = conservation_.countParticles(particles);
    insertionAndRemoval_.advance(particles, highestBefore, couplingTimeStep_, findOutsideMesh());
    conservation_.recordNetInsertion(insertionAndRemoval_.netVolume());
    conservation_.recordOutsideMesh(insertionAndRemoval_.outsideMesh(), insertionAndRemoval_.leftMesh());
}

FindOutsideMesh CouplingStep::findOutsideMesh()
{
    if (!fluid_ || !settings_.particlesOutsideMesh())
    {
        return nullptr;
    }
    return [this] { return fluid_->mapping().areOutsideMesh(engine_.particles()); };
}

void CouplingStep::removeParticlesThatLeft()
{
    const Foam::label removed = insertionAndRemoval_.removeDeparted(engine_);
    if (removed == 0)
    {
        return;
    }
    engine_.prepare();
    conservation_.countAfterRemoval(engine_.particles(), removed);
}

} // namespace clepsydra
