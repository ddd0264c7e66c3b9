#include "couplingStep/couplingStep.h"

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
      fluidDensity_(fluid.density),
      timers_(timers),
      conservation_(settings.dict(), mesh.time()),
      insertionAndRemoval_(settings.dict(), mesh, settings.couplingTimeStep()),
      forces_(models ? &models->forces : nullptr)
{
    if (models && models->forces.needs().pairReach > 0)
    {
        engine_.requestPairs(models->forces.needs().pairReach);
    }
    if (models)
    {
        engine_.requestMemory(models->forces.needs().memory + FluidCoupling::memory);
    }
    engine_.requestState(numbersOf(CouplingState::ofNewParticle()));
    engine_.initialise(models ? &models->forces : nullptr);
    conservation_.countParticles(engine_.particles());
    if (models)
    {
        fluid_ = std::make_unique<FluidCoupling>(
            mesh, settings, fluid, models->forces.needs(), engine, models->distribution, conservation_, timers_);
    }
    conservation_.setInitialSolidVolume(insertionAndRemoval_.start(engine_.particles(), !resumed, findOutsideMesh()));
    if (models)
    {
        fluid_->start(resumed);
        lengthOfChange_ = lengthOfChange(models->distribution.smoothingModel().bandwidth(), smallestCellWidth(mesh));
    }
}

void CouplingStep::start(Foam::volVectorField& U, const Foam::volScalarField& p)
{
    if (resumed_)
    {
        fluid_->fluidToParticles(U, p);
    }
    else
    {
        evaluateFluidForces(U, p);
        fluid_->subtractFirstDrag(U, couplingTimeStep_);
        evaluateFluidForces(U, p);
        fluid_->assignSemiImplicitDrag(U, p);
    }
    resetReceivedImpulse();
    conservation_.setInitialMomentum(fluid_->semiImplicitMomentum());
}

void CouplingStep::evaluateFluidForces(const Foam::volVectorField& U, const Foam::volScalarField& p)
{
    resetReceivedImpulse();
    fluid_->fluidToParticles(U, p);
    engine_.evaluateFluidForces();
}

void CouplingStep::advance(const Foam::volVectorField& U, const Foam::volScalarField& p,
    const Foam::surfaceScalarField& phi, double timeLeft, const std::function<SolvedFluid()>& solveFluid)
{
    couplingTimeStep_ = length_.seconds();
    advanceParticles();
    checkPressureForce();
    if (length_.isAdjustable())
    {
        length_.choose(limits(phi), timeLeft);
    }
    fluid_->particlesToFluid(couplingTimeStep_, length_.seconds());
    const ExchangedMomentum received = resetReceivedImpulse();
    const SolvedFluid solved = solveFluid();
    fluid_->updateAcceleration(U, couplingTimeStep_);
    fluid_->fluidToParticles(U, p);
    fluid_->assignSemiImplicitDrag(U, p);
    conservation_.recordMomentum(received,
        -fluidDensity_ * couplingTimeStep_ * returnReduce(solved.sourceOfParticles, Foam::sumOp<Foam::vector>()),
        fluid_->semiImplicitMomentum());
    conservation_.recordContinuity(couplingTimeStep_ * solved.continuityError());
    conservation_.recordFilteredVolume(fluid_->filteredVolume());
    if (removeParticlesThatLeft())
    {
        resetReceivedImpulse();
    }
}

void CouplingStep::advance()
{
    advanceParticles();
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
    fluid_->start(true);
    fluid_->fluidToParticles(U, p);
    resetReceivedImpulse();
}

void CouplingStep::checkPressureForce()
{
    // In model B grad p does not act on the particles, and the fluid's equation holds no reaction to it.
    if (settings_.modelType() == ModelType::A)
    {
        fluid_->checkPressureForce(
            returnReduce(toFoam(Vector3d(forces_->takePressureImpulse() / demTime_)), Foam::sumOp<Foam::vector>()));
    }
}

ExchangedMomentum CouplingStep::resetReceivedImpulse()
{
    if (forces_)
    {
        forces_->takePressureImpulse();
    }
    const ParticlesView particles = engine_.particles();
    Vector3d sum = Vector3d::Zero();
    double sumOfMagnitudes = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        CouplingState& state = particles.state[particle];
        sum += state.received.impulse;
        sumOfMagnitudes += state.received.impulse.norm();
        state.received = ReceivedImpulse();
        state.angularImpulse.setZero();
        state.velocityBefore = particles.velocity.col(particle);
    }
    return {
        returnReduce(toFoam(sum), Foam::sumOp<Foam::vector>()), returnReduce(sumOfMagnitudes, Foam::sumOp<double>())};
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

void CouplingStep::advanceParticles()
{
    const PhaseTimers::Scope timing = timers_.time("DEM");
    demTime_ = length_.steps() * engine_.timeStep();
    engine_.advance(length_.steps());
    const ParticlesView particles = engine_.particles();
    const int highestBefore = conservation_.countParticles(particles);
    insertionAndRemoval_.advance(particles, highestBefore, couplingTimeStep_, findOutsideMesh());
    conservation_.recordNetInsertion(insertionAndRemoval_.netVolume());
    conservation_.recordOutsideMesh(insertionAndRemoval_.outsideMesh(), insertionAndRemoval_.leftMesh());
}

FindOutsideMesh CouplingStep::findOutsideMesh()
{
    return fluid_ && settings_.particlesOutsideMesh() ? [this] { return fluid_->particlesOutsideMesh(); }
                                                      : FindOutsideMesh();
}

bool CouplingStep::removeParticlesThatLeft()
{
    const Foam::label removed = insertionAndRemoval_.removeDeparted(engine_);
    if (removed == 0)
    {
        return false;
    }
    engine_.prepare();
    conservation_.countAfterRemoval(engine_.particles(), removed);
    return true;
}

} // namespace clepsydra
