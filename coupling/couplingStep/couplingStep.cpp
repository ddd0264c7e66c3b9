#include "couplingStep/couplingStep.h"

#include "couplingStep/checkpointedState.h"
#include "distribution/lengthOfChange.h"
#include "vectors.h"

#include <algorithm>

namespace clepsydra
{

CouplingStep::CouplingStep(const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
    DemEngine& engine, FluidModels* models, PhaseTimers& timers, bool resumed)
    : mesh_(mesh),
      settings_(settings),
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
        engine_.requestPairs(models->forces.needs().pairReach, submergedFractionInState);
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

void CouplingStep::start(Foam::volVectorField& U, const Foam::surfaceScalarField& phi, const Foam::volScalarField& p)
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
    RankNumbers semiImplicit;
    fluid_->semiImplicitMomentum(first).appendTo(semiImplicit);
    RankTotals totals;
    totals.add(semiImplicit,
        [this](const RankNumbers& all) { conservation_.setInitialMomentum(ExchangedMomentum::in(all, 0)); });
    courantNumber_.addTo(phi, couplingTimeStep_, totals);
    totals.reduce();
}

void CouplingStep::meshMoved()
{
    fluid_->meshMoved();
    insertionAndRemoval_.meshMoved(mesh_);
    if (settings_.adjustableCouplingTimeStep())
    {
        lengthOfChange_ =
            lengthOfChange(fluid_->mapping().distribution().smoothingModel().bandwidth(), smallestCellWidth(mesh_));
    }
}

ParticlesInFluid CouplingStep::advanceParticles(double timeLeft)
{
    couplingTimeStep_ = length_.seconds();
    const double demTime = length_.steps() * engine_.timeStep();
    RankTotals totals;
    advanceDem(totals);
    const DemResult result = takeDemResult(couplingTimeStep_);
    fluid_->checkPressureForce(result.pressureImpulse / demTime, totals);
    if (length_.isAdjustable())
    {
        length_.choose(limits(), timeLeft);
    }
    return fluid_->particlesToFluid(result, length_.seconds(), totals);
}

void CouplingStep::fluidToParticles(const SolvedStep& solved, const Foam::volVectorField& U,
    const Foam::surfaceScalarField& phi, const Foam::volScalarField& p, const AddToTotals& addMore)
{
    fluid_->endStep(U, couplingTimeStep_);
    fluid_->fluidToParticles(solved.particles(), U, p);
    RankTotals totals;
    solved.checkConservation(fluid_->semiImplicitMomentum(solved.particles()), totals);
    courantNumber_.addTo(phi, couplingTimeStep_, totals);
    if (addMore)
    {
        addMore(totals);
    }
    totals.reduce();
    removeParticlesThatLeft();
}

void CouplingStep::advance(const AddToTotals& addMore)
{
    RankTotals totals;
    advanceDem(totals);
    if (addMore)
    {
        addMore(totals);
    }
    totals.reduce();
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

std::vector<CouplingStepLimit> CouplingStep::limits() const
{
    const double courant = settings_.adjustableCouplingTimeStep()->largestCourantNumber;
    const ParticlesView particles = engine_.particles();
    const double fastest = particles.size() > 0 ? particles.velocity.colwise().norm().maxCoeff() : 0;
    // The drag of the next coupling step is distributed to the cells with its length.
    const double fastestOfAll = RankTotals::of({{}, {fastest}}).maxima[0];
    return {{"Courant number of the fluid", courant / std::max(courantNumber_.largestPerTime(), Foam::VSMALL)},
        {"Courant number of the particles", courant * lengthOfChange_ / std::max(fastestOfAll, Foam::VSMALL)}};
}

void CouplingStep::advanceDem(RankTotals& totals)
{
    const PhaseTimers::Scope timing = timers_.time("DEM");
    engine_.advance(length_.steps());
    const ParticlesView particles = engine_.particles();
    const int highestBefore = conservation_.countParticles(particles, totals);
    insertionAndRemoval_.advance(particles, highestBefore, couplingTimeStep_, findOutsideMesh(), totals);
    totals.add({}, [this](const RankNumbers&) {
        conservation_.recordNetInsertion(insertionAndRemoval_.netVolume());
        conservation_.recordOutsideMesh(insertionAndRemoval_.outsideMesh(), insertionAndRemoval_.leftMesh());
    });
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
