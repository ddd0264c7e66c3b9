#include "interval/couplingInterval.h"

#include "distribution/lengthOfChange.h"
#include "vectors.h"

#include "fvc.H"

#include <algorithm>

namespace clepsydra
{

CouplingInterval::CouplingInterval(const Foam::fvMesh& mesh, const CouplingSettings& settings,
    const FluidProperties& fluid, DemEngine& engine, FluidModels* models, PhaseTimers& timers, bool resumed)
    : settings_(settings),
      engine_(engine),
      length_(settings, mesh.time(), engine.timeStep(), resumed),
      interval_(length_.seconds()),
      resumed_(resumed),
      fluidDensity_(fluid.density),
      timers_(timers),
      ledger_(settings.dict(), mesh.time()),
      traffic_(settings.dict(), mesh, settings.couplingInterval())
{
    if (models && models->forces.needs().pairReach > 0)
    {
        engine_.seePairs(models->forces.needs().pairReach);
    }
    if (models)
    {
        engine_.keepMemory(models->forces.needs().memory + FluidCoupling::memory);
    }
    engine_.keepState(numbersOf(CouplingState::ofNewBead()));
    engine_.initialise(models ? &models->forces : nullptr);
    ledger_.countBeads(engine_.beads());
    ledger_.openSolidVolume(traffic_.start(engine_.beads(), !resumed));
    if (models)
    {
        fluid_ = std::make_unique<FluidCoupling>(
            mesh, settings, fluid, models->forces.needs(), engine, models->distribution, ledger_, timers_);
        fluid_->start(resumed);
        lengthOfChange_ = lengthOfChange(models->distribution.smoothingModel().bandwidth(), smallestCellWidth(mesh));
    }
}

void CouplingInterval::start(Foam::volVectorField& U, const Foam::volScalarField& p)
{
    if (resumed_)
    {
        fluid_->fluidToBeads(U, p);
    }
    else
    {
        feelFluid(U, p);
        fluid_->takeFirstDragFrom(U, interval_);
        feelFluid(U, p);
        fluid_->giveInAdvance(U, p);
    }
    forgetGiven();
    ledger_.openMomentum(fluid_->momentumGivenInAdvance());
}

void CouplingInterval::feelFluid(const Foam::volVectorField& U, const Foam::volScalarField& p)
{
    forgetGiven();
    fluid_->fluidToBeads(U, p);
    engine_.feelFluid();
}

void CouplingInterval::advance(const Foam::volVectorField& U, const Foam::volScalarField& p,
    const Foam::surfaceScalarField& phi, double timeLeft, const std::function<SolvedFluid()>& solveFluid)
{
    interval_ = length_.seconds();
    advanceBeads();
    if (length_.isAdjustable())
    {
        length_.choose(limits(phi), timeLeft);
    }
    fluid_->beadsToFluid(interval_, length_.seconds());
    const ReceivedMomentum received = forgetGiven();
    const SolvedFluid solved = solveFluid();
    fluid_->updateAcceleration(U, interval_);
    fluid_->fluidToBeads(U, p);
    fluid_->giveInAdvance(U, p);
    ledger_.bookMomentum(received,
        -fluidDensity_ * interval_ * returnReduce(solved.sourceOfBeads, Foam::sumOp<Foam::vector>()),
        fluid_->momentumGivenInAdvance());
    ledger_.bookContinuity(interval_ * solved.continuityError());
    if (removeBeadsThatLeft())
    {
        forgetGiven();
    }
}

void CouplingInterval::advance()
{
    advanceBeads();
    removeBeadsThatLeft();
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
    traffic_.start(engine_.beads(), false);
    fluid_->start(true);
    fluid_->fluidToBeads(U, p);
    forgetGiven();
}

ReceivedMomentum CouplingInterval::forgetGiven()
{
    const BeadsView beads = engine_.beads();
    Vector3d sum = Vector3d::Zero();
    double turnover = 0;
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        CouplingState& state = beads.state[bead];
        sum += state.given.impulse;
        turnover += state.given.impulse.norm();
        state.given = GivenToFluid();
        state.velocityBefore = beads.velocity.col(bead);
    }
    return {returnReduce(toFoam(sum), Foam::sumOp<Foam::vector>()), returnReduce(turnover, Foam::sumOp<double>())};
}

std::vector<IntervalLimit> CouplingInterval::limits(const Foam::surfaceScalarField& phi) const
{
    const double courant = settings_.adjustableInterval()->largestCourantNumber;
    const double throughCells =
        0.5 * Foam::gMax(Foam::fvc::surfaceSum(Foam::mag(phi))().primitiveField() / phi.mesh().V().field());
    const BeadsView beads = engine_.beads();
    const double fastestHere = beads.size() > 0 ? beads.velocity.colwise().norm().maxCoeff() : 0;
    const double fastest = returnReduce(fastestHere, Foam::maxOp<double>());
    return {{"Courant number of the fluid", courant / std::max(throughCells, Foam::VSMALL)},
        {"Courant number of the beads", courant * lengthOfChange_ / std::max(fastest, Foam::VSMALL)}};
}

void CouplingInterval::advanceBeads()
{
    const PhaseTimers::Scope timing = timers_.time("DEM");
    engine_.advance(length_.steps());
    const BeadsView beads = engine_.beads();
    const int highestBefore = ledger_.countBeads(beads);
    traffic_.advance(beads, highestBefore, interval_);
    ledger_.bookTraffic(traffic_.netVolume());
}

bool CouplingInterval::removeBeadsThatLeft()
{
    const Foam::label removed = traffic_.removeGone(engine_);
    if (removed == 0)
    {
        return false;
    }
    engine_.prepare();
    ledger_.countAfterRemoval(engine_.beads(), removed);
    return true;
}

} // namespace clepsydra
