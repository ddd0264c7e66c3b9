#include "couplingStep/fluidCoupling.h"

#include "couplingStep/bedEdge.h"
#include "couplingStep/checkpointedState.h"
#include "vectors.h"

namespace clepsydra
{

using namespace Foam;

FluidCoupling::FluidCoupling(const fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
    const ForceNeeds& needs, DemEngine& engine, Distribution& distribution, const ViscousStress& viscousStress,
    MeanPressureGradient& meanPressureGradient, ConservationCheck& conservation, PhaseTimers& timers)
    : mesh_(mesh),
      settings_(settings),
      fluid_(fluid),
      engine_(engine),
      conservation_(conservation),
      timers_(timers),
      meanPressureGradient_(meanPressureGradient),
      mapping_(mesh, settings.dict(), distribution, timers),
      sampling_(mesh, settings, fluid, needs, distribution.smoothingModel(), viscousStress),
      dragTimes_(settings, fluid.density),
      rows_(sampling_.removesSelfInducedVelocity()),
      fields_{ClippedVoidFraction(mesh, settings.minimumVoidFraction(), conservation),
          PressureOnParticles(
              mesh, settings.modelType(), needs.pressureGradient, fluid.density, meanPressureGradient, conservation),
          VoidFractionRate(mesh, settings), SemiImplicitSource(mesh, fluid.density),
          needs.torque ? std::make_unique<TorqueReaction>(mesh, fluid.density) : nullptr}
{}

AnticipatedParticles FluidCoupling::start(bool resumed)
{
    const ParticlesView particles = engine_.particles();
    RankTotals totals;
    meanPressureGradient_.addTo(particles, totals);
    totals.reduce();
    Eigen::MatrixXd volumes(ContributionRows::solidVolume.end(), particles.size());
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        volumes(0, particle) = volumeInFluid(particles, particle);
    }
    AnticipatedParticles located{mapping_.locate(particles, volumes),
        std::vector<AnticipatedMotion>(static_cast<std::size_t>(particles.size())), settings_.couplingTimeStep()};
    const Eigen::MatrixXd solidFraction = densities(located, ContributionRows::solidVolume.end());
    if (resumed)
    {
        fields_.voidFraction.restore(solidFraction.row(0));
        updateSizes(located);
        sampling_.restore(particles);
        return located;
    }
    fields_.voidFraction.update(solidFraction.row(0), particles, located, totals);
    totals.reduce();
    updateSizes(located);
    // No equation has been solved yet in which drag transferred part of the pressure's impulse from the particles.
    fields_.pressure.updateFactor(voidFraction(), Eigen::RowVectorXd::Zero(mesh_.nCells()));
    fields_.rate.start(voidFraction());
    return located;
}

AnticipatedParticles FluidCoupling::subtractFirstDrag(DemResult oneStep, volVectorField& U, double couplingTimeStep)
{
    for (ReceivedImpulse& received : oneStep.received)
    {
        received.impulse.setZero();
    }
    AnticipatedParticles located = locate(oneStep, couplingTimeStep);
    const Eigen::MatrixXd density = densities(located, ContributionRows::momentum.end());
    fields_.momentum.update(ContributionRows::momentum.of(density), couplingTimeStep);
    fields_.momentum.subtractFirstDrag(U, voidFraction());
    return located;
}

void FluidCoupling::meshMoved()
{
    mapping_.meshMoved();
    fields_.rate.meshMoved();
    fields_.momentum.meshMoved();
    sampling_.meshMoved();
    conservation_.meshMoved();
}

ParticlesInFluid FluidCoupling::particlesToFluid(const DemResult& result, double next, const RankTotals& ofDem)
{
    const PhaseTimers::Scope timing = timers_.time("distribute");
    const ParticlesView particles = engine_.particles();
    std::vector<AnticipatedMotion> motions = anticipate(result, next);
    const Eigen::MatrixXd added = contributions(result, motions);
    RankTotals ofParticles = ofDem;
    dragTimes_.addTo(particles, result, ofParticles);
    meanPressureGradient_.addTo(particles, ofParticles);
    AnticipatedParticles located{mapping_.lastLocated(), std::move(motions), next};
    Eigen::MatrixXd density;
    // Which ranks receive particles and which cells are smoothed is assumed to be as in the last coupling step. The
    // reduction of all checks confirms it; where it is not so, it has made new plans, and particles are distributed again.
    bool asPlanned = false;
    while (!asPlanned)
    {
        RankTotals totals = ofParticles;
        mapping_.locateAsPlanned(particles, added, totals);
        density = densities(located, rows_.count);
        fields_.voidFraction.update(ContributionRows::solidVolume.of(density), particles, located, totals);
        // Motion of the particles over the next coupling step, divided by the length of the step that is solved.
        ContributionRows::motion.of(density) *= next / result.timeStep;
        const double anticipated = settings_.implicitCoupling() ? next / result.timeStep : 0;
        fields_.rate.update(voidFraction(), ContributionRows::motion.of(density),
            anticipated * ContributionRows::solidVolume.of(density), result.timeStep, totals);
        asPlanned = totals.reduce();
    }
    updateSizes(located);
    fields_.pressure.updateFactor(voidFraction(), ContributionRows::velocityResponse.of(density));
    fields_.momentum.update(ContributionRows::momentum.of(density), result.timeStep);
    if (fields_.torque)
    {
        fields_.torque->update(located, result.angularImpulses, result.timeStep);
    }
    if (rows_.resistance)
    {
        sampling_.setResistance(rows_.resistance->of(density), result.timeStep);
    }
    return {std::move(located), fields_, conservation_, result.receivedMomentum(), fluid_.density, result.timeStep};
}

std::vector<AnticipatedMotion> FluidCoupling::anticipate(const DemResult& result, double next) const
{
    const ParticlesView particles = engine_.particles();
    std::vector<AnticipatedMotion> motions(static_cast<std::size_t>(particles.size()));
    if (!settings_.implicitCoupling())
    {
        return motions;
    }
    for (std::size_t i = 0; i < motions.size(); ++i)
    {
        const auto particle = static_cast<Eigen::Index>(i);
        // A particle that has left gets no semi-implicit drag, because it is removed before it could receive it.
        if (particles.state[particle].fluid.submergedFraction > 0)
        {
            motions[i] = anticipatedMotion(result.received[i], result.changeOfVelocity.col(particle),
                particles.mass[particle], result.timeStep, next);
            anticipateAddedMass(particles, particle, result.received[i].addedMassTime / result.timeStep, motions[i]);
            motions[i].addedMass *= next / result.timeStep;
        }
    }
    return motions;
}

void FluidCoupling::anticipateAddedMass(
    const ParticlesView& particles, Eigen::Index particle, double addedMass, AnticipatedMotion& motion) const
{
    const FluidAtParticle& fluid = particles.state[particle].fluid;
    const double solid = 1 - fluid.voidFraction;
    if (addedMass > 0 && solid > 0)
    {
        motion.addedMass = implicitAddedMass(
            addedMass, fluid_.density * volumeInFluid(particles, particle) * fluid.voidFraction / solid);
        motion.fluidVelocity = fluid.velocityInCells;
    }
}

Eigen::MatrixXd FluidCoupling::contributions(
    const DemResult& result, const std::vector<AnticipatedMotion>& anticipated) const
{
    const ParticlesView particles = engine_.particles();
    const auto given = checkpointedState::of(particles);
    Eigen::MatrixXd all(rows_.count, particles.size());
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const ReceivedImpulse& received = result.received[static_cast<std::size_t>(particle)];
        const AnticipatedMotion& motion = anticipated[static_cast<std::size_t>(particle)];
        const Vector3d velocity = particles.velocity.col(particle);
        // Explicit coupling anticipates no motion: without the response to the pressure it would be worse than none.
        const double volume = settings_.implicitCoupling() ? volumeInFluid(particles, particle) : 0;
        const double pressureForce = fields_.pressure.acts() ? fluid_.density * volume : 0;
        ContributionRows::solidVolume.of(all)(0, particle) = volumeInFluid(particles, particle);
        ContributionRows::momentum.of(all).col(particle)
            << received.impulse - checkpointedState::semiImplicitImpulse.of(given).col(particle)
                   - motion.drag * velocity - motion.addedMass * motion.fluidVelocity,
            motion.drag + motion.addedMass;
        ContributionRows::motion.of(all).col(particle) << volume * motion.velocityResponse,
            volume * motion.pressureResponse * pressureForce, volume * (1 - motion.velocityResponse) * velocity;
        if (rows_.resistance)
        {
            rows_.resistance->of(all)(0, particle) = received.implicitCoefficientTime;
        }
    }
    return all;
}

AnticipatedParticles FluidCoupling::locate(const DemResult& result, double next)
{
    std::vector<AnticipatedMotion> motions = anticipate(result, next);
    const LocatedParticles located = mapping_.locate(engine_.particles(), contributions(result, motions));
    return {located, std::move(motions), next};
}

Eigen::MatrixXd FluidCoupling::densities(const LocatedParticles& particles, Eigen::Index rowCount) const
{
    Eigen::MatrixXd densities = particles.densities(rowCount);
    if (rowCount >= ContributionRows::momentum.end())
    {
        fields_.momentum.addDeferred(ContributionRows::momentum.of(densities));
    }
    particles.smooth(densities);
    return densities;
}

void FluidCoupling::updateSizes(const LocatedParticles& located)
{
    if (!sampling_.needsSauterMeanDiameter())
    {
        return;
    }
    const ParticlesView particles = engine_.particles();
    Eigen::MatrixXd amounts(1, particles.size());
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const double diameter = 2 * particles.radius[particle] / settings_.coarseGraining();
        amounts(0, particle) = volumeInFluid(particles, particle) / diameter;
    }
    Eigen::MatrixXd volumePerDiameter = located.densitiesOf(amounts);
    located.smooth(volumePerDiameter);
    sampling_.setSizes(columns(fields_.voidFraction.solidFraction()), volumePerDiameter.row(0));
}

void FluidCoupling::sample(const AnticipatedParticles& particles, const volVectorField& U, const volScalarField& p)
{
    const PhaseTimers::Scope timing = timers_.time("distribute");
    const ParticlesView view = engine_.particles();
    sampling_.store(view);
    Eigen::MatrixXd pressureGradient = fields_.pressure.gradient(p, fields_.voidFraction.solidFraction());
    if (settings_.modelType() == ModelType::A)
    {
        particles.smooth(pressureGradient);
    }
    sampling_.sample(particles, U, voidFraction(), pressureGradient).storeIn(view);
    fields_.pressure.sampledAt(view);
}

void FluidCoupling::fluidToParticles(
    const AnticipatedParticles& particles, const volVectorField& U, const volScalarField& p)
{
    sample(particles, U, p);
    if (settings_.implicitCoupling())
    {
        assignSemiImplicitDrag(particles, U, p);
    }
}

void FluidCoupling::assignSemiImplicitDrag(
    const AnticipatedParticles& anticipated, const volVectorField& U, const volScalarField& p)
{
    const PhaseTimers::Scope timing = timers_.time("distribute");
    const ParticlesView particles = engine_.particles();
    auto given = checkpointedState::of(particles);
    Eigen::Matrix3Xd fromFluid(3, particles.size());
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const AnticipatedMotion& motion = anticipated.motions[static_cast<std::size_t>(particle)];
        const FluidAtParticle& fluid = particles.state[particle].fluid;
        const double pressureVolume = fields_.pressure.acts() ? volumeInFluid(particles, particle) : 0;
        fromFluid.col(particle) =
            (motion.drag + motion.addedMass) * fluid.velocityInCells
            + anticipated.timeStep * motion.velocityResponse * pressureVolume * fluid.pressureGradient;
        checkpointedState::semiImplicitImpulse.of(given).col(particle) =
            fromFluid.col(particle) - motion.drag * particles.velocity.col(particle)
            - motion.addedMass * motion.fluidVelocity;
    }
    fields_.momentum.defer(U, fields_.pressure.source(voidFraction(), p), anticipated.densitiesOf(fromFluid));
}

ExchangedMomentum FluidCoupling::semiImplicitMomentum(const AnticipatedParticles& anticipated) const
{
    const ParticlesView particles = engine_.particles();
    const auto ofParticles = checkpointedState::semiImplicitImpulse.of(checkpointedState::of(particles));
    const vectorField inCells(fluid_.density * mesh_.V().field() * fields_.momentum.pendingMomentum());
    double magnitudes = sum(mag(inCells));
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const AnticipatedMotion& motion = anticipated.motions[static_cast<std::size_t>(particle)];
        const FluidAtParticle& fluid = particles.state[particle].fluid;
        magnitudes += ofParticles.col(particle).norm()
                      + motion.drag * (fluid.velocityInCells.norm() + particles.velocity.col(particle).norm())
                      + motion.addedMass * (fluid.velocityInCells.norm() + motion.fluidVelocity.norm());
    }
    const Vector3d sumOfParticles = ofParticles.rowwise().sum();
    return {toFoam(sumOfParticles) + sum(inCells), magnitudes};
}

std::optional<double> FluidCoupling::partNearClearFluid() const
{
    return clepsydra::partNearClearFluid(
        voidFraction(), mapping_.lastLocated(), mapping_.distribution().smoothingModel().bandwidth());
}

} // namespace clepsydra
