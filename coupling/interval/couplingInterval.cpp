#include "interval/couplingInterval.h"

namespace clepsydra
{

CouplingInterval::CouplingInterval(const Foam::fvMesh& mesh, const CouplingSettings& settings,
    const FluidProperties& fluid, DemEngine& engine)
:
    engine_(engine),
    stepsPerInterval_(settings.stepsPerInterval(engine.timeStep())),
    interval_(settings.couplingInterval()),
    forces_(settings.hasFluid() ? std::make_unique<BeadForces>(settings.dict(), fluid, timers_) : nullptr),
    ledger_(settings.dict(), mesh.time()),
    observedBeads_(mesh, engine)
{
    engine_.initialise(forces_.get());
    ledger_.countBeads(engine_.beads());
    if (settings.hasFluid())
    {
        fluid_ = std::make_unique<FluidCoupling>(mesh, settings, fluid, engine, ledger_, timers_);
        fluid_->start();
    }
}

void CouplingInterval::start(const Foam::volVectorField& U, const Foam::volScalarField& p)
{
    fluid_->fluidToBeads(U, p);
}

void CouplingInterval::advance(
    const Foam::volVectorField& U, const Foam::volScalarField& p, const std::function<void()>& solveFluid)
{
    advanceBeads();
    fluid_->beadsToFluid(interval_);
    solveFluid();
    fluid_->carryMomentum(U, interval_);
    fluid_->fluidToBeads(U, p);
}

void CouplingInterval::advance()
{
    advanceBeads();
}

void CouplingInterval::advanceBeads()
{
    const PhaseTimers::Scope timing = timers_.time("DEM");
    engine_.advance(stepsPerInterval_);
    ledger_.countBeads(engine_.beads());
}

} // namespace clepsydra
