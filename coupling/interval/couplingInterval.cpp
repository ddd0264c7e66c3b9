#include "interval/couplingInterval.h"

#include "vectors.h"

#include <algorithm>

namespace clepsydra
{

CouplingInterval::CouplingInterval(const Foam::fvMesh& mesh, const CouplingSettings& settings,
    const FluidProperties& fluid, DemEngine& engine, FluidModels* models, PhaseTimers& timers, bool resumed)
    : engine_(engine),
      stepsPerInterval_(settings.stepsPerInterval(engine.timeStep())),
      interval_(settings.couplingInterval()),
      fluidDensity_(fluid.density),
      timers_(timers),
      ledger_(settings.dict(), mesh.time()),
      observedBeads_(mesh, engine)
{
    if (models && models->forces.needs().pairReach > 0)
    {
        engine_.seePairs(models->forces.needs().pairReach);
    }
    if (models && models->forces.needs().memory > 0)
    {
        engine_.keepMemory(models->forces.needs().memory);
    }
    engine_.initialise(models ? &models->forces : nullptr);
    ledger_.countBeads(engine_.beads());
    if (models)
    {
        fluid_ = std::make_unique<FluidCoupling>(
            mesh, settings, fluid, models->forces.needs(), engine, models->distribution, ledger_, timers_);
        fluid_->start(resumed);
    }
}

void CouplingInterval::start(const Foam::volVectorField& U, const Foam::volScalarField& p)
{
    fluid_->fluidToBeads(U, p);
    // The first half of the first DEM step uses the forces at its beginning: with the fluid, not without.
    engine_.prepare();
    forgetGiven();
}

void CouplingInterval::advance(
    const Foam::volVectorField& U, const Foam::volScalarField& p, const std::function<SolvedFluid()>& solveFluid)
{
    advanceBeads();
    fluid_->beadsToFluid(interval_);
    const Foam::vector given = forgetGiven();
    const SolvedFluid solved = solveFluid();
    fluid_->carryMomentum(U, interval_);
    ledger_.bookMomentum(given,
        -fluidDensity_ * interval_ * returnReduce(solved.sourceOfBeads, Foam::sumOp<Foam::vector>()),
        fluid_->momentumOutstanding());
    ledger_.bookContinuity(interval_ * solved.continuityError());
    fluid_->updateAcceleration(U, interval_);
    fluid_->fluidToBeads(U, p);
}

void CouplingInterval::advance()
{
    advanceBeads();
}

void CouplingInterval::restartInPlace()
{
    engine_.prepare();
}

void CouplingInterval::restartInPlace(const Foam::volVectorField& U, const Foam::volScalarField& p)
{
    const BeadsView beads = engine_.beads();
    std::fill_n(beads.state, beads.size(), CouplingState());
    engine_.prepare();
    fluid_->start(true);
    start(U, p);
}

Foam::vector CouplingInterval::forgetGiven()
{
    const BeadsView beads = engine_.beads();
    Vector3d sum = Vector3d::Zero();
    std::for_each(beads.state, beads.state + beads.size(), [&](CouplingState& state) {
        sum += state.given.impulse;
        state.given = GivenToFluid();
    });
    return returnReduce(toFoam(sum), Foam::sumOp<Foam::vector>());
}

void CouplingInterval::advanceBeads()
{
    const PhaseTimers::Scope timing = timers_.time("DEM");
    engine_.advance(stepsPerInterval_);
    ledger_.countBeads(engine_.beads());
}

} // namespace clepsydra
