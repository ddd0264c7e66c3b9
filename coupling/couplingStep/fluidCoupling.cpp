#include "couplingStep/fluidCoupling.h"

#include "couplingStep/couplingField.h"
#include "couplingStep/sampledFields.h"
#include "vectors.h"

#include "fvc.H"
#include "fvcCurl.H"
#include "fvcGrad.H"

#include <mpi.h>

#include <cmath>
#include <cstdlib>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Rows of what the particles add to the cells: their volume, their reaction (first for SemiImplicitSource, then for
/// VoidFractionRate) and, where the self-induced velocity is removed, their resistance.
enum DensityRow : Eigen::Index
{
    solidVolume = 0,
    momentum = 1,
    motion = momentum + SemiImplicitSource::rowCount,
    resistanceTime = motion + VoidFractionRate::rowCount
};

/// Rows of the state that is stored for each particle from coupling step to coupling step: the impulse P of
/// SemiImplicitSource [N s], and the quantities from which the self-induced velocity is computed.
enum CheckpointRow : Eigen::Index
{
    semiImplicitImpulse = 0,
    drag = 3,
    selfMobility = 6
};

static_assert(reactionSize == SemiImplicitSource::rowCount + VoidFractionRate::rowCount);

MPI_Comm duplicateWorld()
{
    MPI_Comm own;
    MPI_Comm_dup(MPI_COMM_WORLD, &own);
    return own;
}

} // namespace

FluidCoupling::FluidCoupling(const fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
    const ForceNeeds& needs, DemEngine& engine, Distribution& distribution, ConservationCheck& conservation,
    PhaseTimers& timers)
    : mesh_(mesh),
      settings_(settings),
      fluid_(fluid),
      needs_(needs),
      engine_(engine),
      conservation_(conservation),
      timers_(timers),
      distribution_(distribution),
      exchange_(duplicateWorld(), distribution_.cells().box(), distribution_.voidFractionModel().commonReach()),
      selfInducedVelocityCorrection_(settings, fluid, distribution.smoothingModel()),
      voidFraction_(couplingField<scalar>("voidFraction", mesh, dimless, 1)),
      pressureFactor_(
          temporaryField<volScalarField>("pressureFactor", mesh, dimless, 1, zeroGradientFvPatchScalarField::typeName)),
      voidFractionRate_(mesh, settings),
      semiImplicitSource_(mesh, fluid.density),
      viscousStress_(mesh, fluid),
      solidFraction_(1 - voidFraction_.primitiveField())
{
    if (needs_.acceleration)
    {
        acceleration_.reset(
            new volVectorField(couplingField<vector>("fluidAcceleration", mesh, dimAcceleration, vector::zero)));
    }
    if (selfInducedVelocityCorrection_.isActive())
    {
        resistance_.reset(
            new volScalarField(couplingField<scalar>("resistanceOfParticles", mesh, dimDensity / dimTime, 0)));
    }
    voidFraction_.oldTime();
}

Eigen::Map<Eigen::Matrix<double, FluidCoupling::memory, Eigen::Dynamic>, 0, Eigen::OuterStride<>>
FluidCoupling::checkpointedState(const ParticlesView& particles)
{
    return {particles.memory ? particles.memory + particles.memorySize - memory : nullptr, memory, particles.size(),
        Eigen::OuterStride<>(particles.memorySize)};
}

vector FluidCoupling::semiImplicitMomentum() const
{
    const Vector3d ofParticles =
        checkpointedState(engine_.particles()).middleRows<3>(semiImplicitImpulse).rowwise().sum();
    return returnReduce(toFoam(ofParticles), sumOp<vector>())
           + gSum(vectorField(fluid_.density * mesh_.V().field() * semiImplicitSource_.pendingMomentum()));
}

void FluidCoupling::start(bool resumed)
{
    anticipate(settings_.couplingTimeStep(), settings_.couplingTimeStep());
    findCells();
    const Eigen::MatrixXd densities = densitiesOfParticles(solidVolume + 1);
    if (resumed)
    {
        // The solid fraction is that before clipping, whereas the void fraction that was read is clipped.
        columns(solidFraction_) = densities.row(solidVolume);
        restoreSelfInducedVelocity();
        return;
    }
    updateVoidFraction(densities);
    // No equation has been solved yet in which drag transferred part of the pressure's impulse from the particles.
    updatePressureFactor(Eigen::RowVectorXd::Zero(mesh_.nCells()));
    voidFractionRate_.start(voidFraction_);
}

void FluidCoupling::storeSelfInducedVelocity()
{
    const ParticlesView particles = engine_.particles();
    for (Eigen::Index particle = 0; resistance_ && particle < particles.size(); ++particle)
    {
        checkpointedState(particles).col(particle).segment<3>(drag) = particles.state[particle].drag;
        checkpointedState(particles)(selfMobility, particle) = particles.state[particle].fluid.selfMobility;
    }
}

void FluidCoupling::restoreSelfInducedVelocity()
{
    const ParticlesView particles = engine_.particles();
    for (Eigen::Index particle = 0; resistance_ && particle < particles.size(); ++particle)
    {
        particles.state[particle].drag = checkpointedState(particles).col(particle).segment<3>(drag);
        particles.state[particle].fluid.selfMobility = checkpointedState(particles)(selfMobility, particle);
    }
}

void FluidCoupling::subtractFirstDrag(volVectorField& U, double couplingTimeStep)
{
    const ParticlesView particles = engine_.particles();
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        particles.state[particle].received.impulse.setZero();
    }
    anticipate(engine_.timeStep(), couplingTimeStep);
    findCells();
    semiImplicitSource_.update(
        densitiesOfParticles(motion).middleRows<SemiImplicitSource::rowCount>(momentum), couplingTimeStep);
    semiImplicitSource_.subtractFirstDrag(U, voidFraction_);
}

void FluidCoupling::particlesToFluid(double couplingTimeStep, double next)
{
    const PhaseTimers::Scope timing = timers_.time("distribute");
    anticipate(couplingTimeStep, next);
    findCells();
    Eigen::MatrixXd densities = densitiesOfParticles(resistance_ ? resistanceTime + 1 : resistanceTime);
    // Motion of the particles over the next coupling step, divided by the length of the step that is solved.
    densities.middleRows<VoidFractionRate::rowCount>(motion) *= next / couplingTimeStep;
    updateVoidFraction(densities);
    updatePressureFactor(densities.row(motion));
    voidFractionRate_.update(voidFraction_, densities.middleRows<VoidFractionRate::rowCount>(motion), couplingTimeStep);
    semiImplicitSource_.update(densities.middleRows<SemiImplicitSource::rowCount>(momentum), couplingTimeStep);
    if (resistance_)
    {
        columns(resistance_->primitiveFieldRef()) = densities.row(resistanceTime) / couplingTimeStep;
    }
}

void FluidCoupling::anticipate(double lastTimeStep, double nextTimeStep)
{
    const ParticlesView particles = engine_.particles();
    anticipatedTime_ = nextTimeStep;
    anticipated_.assign(static_cast<std::size_t>(particles.size()), AnticipatedMotion());
    if (!settings_.implicitCoupling())
    {
        return;
    }
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const CouplingState& state = particles.state[particle];
        // A particle that has left gets no semi-implicit drag, because it is removed before it could receive it.
        if (state.fluid.submergedFraction > 0)
        {
            anticipated_[static_cast<std::size_t>(particle)] =
                anticipatedMotion(state.received, particles.velocity.col(particle) - state.velocityBefore,
                    particles.mass[particle], lastTimeStep, nextTimeStep);
        }
    }
}

Reactions FluidCoupling::reactions() const
{
    const ParticlesView particles = engine_.particles();
    const auto ofParticle = checkpointedState(particles);
    Reactions all(reactionSize, particles.size());
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const AnticipatedMotion& motion = anticipated_[static_cast<std::size_t>(particle)];
        const Vector3d velocity = particles.velocity.col(particle);
        // Explicit coupling anticipates no motion: without the response to the pressure it would be worse than none.
        const double volume = settings_.implicitCoupling() ? volumeInFluid(particles, particle) : 0;
        const double pressureForce = pressureActsOnParticles() ? fluid_.density * volume : 0;
        all.col(particle) << particles.state[particle].received.impulse
                                 - ofParticle.col(particle).segment<3>(semiImplicitImpulse) - motion.drag * velocity,
            motion.drag, volume * motion.velocityResponse, volume * motion.pressureResponse * pressureForce,
            volume * (1 - motion.velocityResponse) * velocity;
    }
    return all;
}

void FluidCoupling::assignSemiImplicitDrag(const volVectorField& U, const volScalarField& p)
{
    if (!settings_.implicitCoupling())
    {
        return;
    }
    const PhaseTimers::Scope timing = timers_.time("distribute");
    const ParticlesView particles = engine_.particles();
    Eigen::Matrix3Xd fromFluid(3, particles.size());
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const AnticipatedMotion& motion = anticipated_[static_cast<std::size_t>(particle)];
        const FluidAtParticle& fluid = particles.state[particle].fluid;
        const double pressureVolume = pressureActsOnParticles() ? volumeInFluid(particles, particle) : 0;
        fromFluid.col(particle) =
            motion.drag * fluid.velocityInCells
            + anticipatedTime_ * motion.velocityResponse * pressureVolume * fluid.pressureGradient;
        checkpointedState(particles).col(particle).segment<3>(semiImplicitImpulse) =
            fromFluid.col(particle) - motion.drag * particles.velocity.col(particle);
    }
    semiImplicitSource_.defer(U, sourceOfPressure(p), distribution_.densities(exchange_.toGhosts(fromFluid)));
}

tmp<volVectorField> FluidCoupling::sourceOfPressure(const volScalarField& p) const
{
    const dimensionedScalar active("active", dimless, pressureActsOnParticles() ? 1 : 0);
    return active * (voidFraction_ - pressureFactor_) * fvc::grad(p);
}

void FluidCoupling::findCells()
{
    const ParticlesView particles = engine_.particles();
    const auto exchanged = [&](auto&& communicate) {
        const PhaseTimers::Scope timing = timers_.time("exchange");
        return communicate();
    };
    exchanged([&] { exchange_.send(particles, reactions()); });
    const Eigen::MatrixXd sharesHere = [&] {
        const PhaseTimers::Scope timing = timers_.time("locate");
        return distribution_.findCells(exchange_.ghosts());
    }();
    const Eigen::MatrixXd shareSums = exchanged([&] { return exchange_.sumAtOwners(sharesHere); });
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        if (!(shareSums(0, particle) > 0))
        {
            reportParticleOutsideMesh(particles, particle);
        }
    }
    distribution_.normalise(exchanged([&] { return exchange_.toGhosts(shareSums); }));
    const PhaseTimers::Scope timing = timers_.time("smooth");
    distribution_.smoothNearParticles();
}

void FluidCoupling::smooth(Eigen::MatrixXd& densities)
{
    const PhaseTimers::Scope timing = timers_.time("smooth");
    distribution_.smooth(densities);
}

Eigen::MatrixXd FluidCoupling::densitiesOfParticles(Eigen::Index rowCount)
{
    const std::vector<GhostParticle>& ghosts = exchange_.ghosts();
    Eigen::MatrixXd amounts(resistanceTime + 1, static_cast<Eigen::Index>(ghosts.size()));
    for (Eigen::Index i = 0; i < amounts.cols(); ++i)
    {
        const GhostParticle& particle = ghosts[static_cast<std::size_t>(i)];
        amounts.col(i) << particle.volume, particle.reaction, particle.implicitCoefficientTime;
    }
    Eigen::MatrixXd densities = distribution_.densities(amounts.topRows(rowCount));
    if (rowCount > momentum)
    {
        semiImplicitSource_.addDeferred(densities.middleRows<SemiImplicitSource::rowCount>(momentum));
    }
    smooth(densities);
    return densities;
}

void FluidCoupling::updateVoidFraction(const Eigen::MatrixXd& densities)
{
    const ParticlesView particles = engine_.particles();
    columns(solidFraction_) = densities.row(solidVolume);
    double particleVolume = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        particleVolume += volumeInFluid(particles, particle);
    }
    const scalarField& cellVolumes = mesh_.V().field();
    const double cellVolume = gSum(scalarField(solidFraction_ * cellVolumes));

    scalarField& voidFraction = voidFraction_.primitiveFieldRef();
    voidFraction = 1 - solidFraction_;
    double clipped = 0;
    label worstCell = -1;
    const double minimum = settings_.minimumVoidFraction();
    forAll (voidFraction, cell)
    {
        if (voidFraction[cell] < minimum)
        {
            worstCell = worstCell < 0 || solidFraction_[cell] > solidFraction_[worstCell] ? cell : worstCell;
            clipped += (minimum - voidFraction[cell]) * cellVolumes[cell];
            voidFraction[cell] = minimum;
        }
    }
    voidFraction_.correctBoundaryConditions();
    conservation_.recordSolidVolume(returnReduce(particleVolume, sumOp<scalar>()), cellVolume,
        returnReduce(clipped, sumOp<scalar>()), worstCell < 0 ? string("none here") : describeCell(worstCell));
}

void FluidCoupling::updatePressureFactor(const Eigen::Ref<const Eigen::RowVectorXd>& velocityResponse)
{
    pressureFactor_ = voidFraction_;
    if (settings_.modelType() == ModelType::B)
    {
        pressureFactor_.primitiveFieldRef() = 1;
    }
    else if (pressureActsOnParticles())
    {
        columns(pressureFactor_.primitiveFieldRef()) += velocityResponse;
    }
    pressureFactor_.correctBoundaryConditions();
}

void FluidCoupling::updateAcceleration(const volVectorField& U, double couplingTimeStep)
{
    if (needs_.acceleration)
    {
        const tmp<volTensorField> gradient = fvc::grad(U);
        acceleration_->primitiveFieldRef() = (U.primitiveField() - U.oldTime().primitiveField()) / couplingTimeStep
                                             + (U.primitiveField() & gradient().primitiveField());
        acceleration_->correctBoundaryConditions();
    }
}

void FluidCoupling::fluidToParticles(const volVectorField& U, const volScalarField& p)
{
    const PhaseTimers::Scope timing = timers_.time("distribute");
    storeSelfInducedVelocity();
    const ParticlesView particles = engine_.particles();
    const tmp<volVectorField> gradient = fvc::grad(p);

    Eigen::MatrixXd pascalPerMetre = fluid_.density * columns(gradient().primitiveField());
    pressureForceInFluid_ =
        -gSum(vectorField(fluid_.density * gradient().primitiveField() * solidFraction_ * mesh_.V().field()));
    if (settings_.modelType() == ModelType::A)
    {
        smooth(pascalPerMetre);
    }
    else
    {
        pascalPerMetre.setZero();
    }

    SampledFields sampled;
    const auto sampleVector = [&](const auto& inCells, Vector3d FluidAtParticle::*atParticle) {
        sampled.add(inCells, [particles, atParticle](Eigen::Index particle, const double* value) {
            particles.state[particle].fluid.*atParticle = Eigen::Map<const Vector3d>(value);
        });
    };
    sampled.add(columns(voidFraction_.primitiveField()), [particles](Eigen::Index particle, const double* value) {
        FluidAtParticle& fluid = particles.state[particle].fluid;
        fluid.voidFraction = *value;
        fluid.logVoidFraction = std::log(*value);
    });
    sampled.add(columns(U.primitiveField()), [particles](Eigen::Index particle, const double* value) {
        FluidAtParticle& fluid = particles.state[particle].fluid;
        fluid.velocity = Eigen::Map<const Vector3d>(value);
        fluid.velocityInCells = fluid.velocity;
    });
    sampleVector(pascalPerMetre, &FluidAtParticle::pressureGradient);
    if (needs_.viscousStress)
    {
        sampleVector(fluid_.density * columns(viscousStress_.divergence(U)().primitiveField()),
            &FluidAtParticle::viscousStressDivergence);
    }
    if (needs_.acceleration)
    {
        sampleVector(columns(acceleration_->primitiveField()), &FluidAtParticle::acceleration);
    }
    if (needs_.vorticity)
    {
        sampleVector(columns(fvc::curl(U)().primitiveField()), &FluidAtParticle::vorticity);
    }
    if (resistance_)
    {
        Eigen::Matrix2Xd surroundings(2, mesh_.nCells());
        surroundings << columns(resistance_->primitiveField()),
            columns(mesh_.V().field()).array().pow(1.0 / 3.0).matrix();
        sampled.add(surroundings, [&, particles](Eigen::Index particle, const double* value) {
            particles.state[particle].fluid.selfMobility =
                selfInducedVelocityCorrection_.selfMobility(particles.state[particle], particles.position.col(particle),
                    particles.radius[particle], particles.velocity.col(particle), value[0], value[1]);
        });
    }
    sampled.store(exchange_.sumAtOwners(distribution_.sample(sampled.inCells())));
    magnitudeOfPressureForces_ = magnitudeOfPressureForces();
}

double FluidCoupling::magnitudeOfPressureForces()
{
    const ParticlesView particles = engine_.particles();
    scalar sum = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        sum += volumeInFluid(particles, particle) * particles.state[particle].fluid.pressureGradient.norm();
    }
    return returnReduce(sum, sumOp<scalar>());
}

void FluidCoupling::checkPressureForce(const vector& onParticles)
{
    conservation_.recordPressureForce(
        onParticles, pressureForceInFluid_, magnitudeOfPressureForces_, !pressureActsOnParticles());
}

bool FluidCoupling::pressureActsOnParticles() const
{
    return settings_.modelType() == ModelType::A && needs_.pressureGradient;
}

string FluidCoupling::describeCell(label cell) const
{
    const vector& centre = mesh_.C()[cell];
    const GhostParticle* nearest = nullptr;
    double nearestDistance = GREAT;
    for (const GhostParticle& particle : exchange_.ghosts())
    {
        const double distance = mag(toFoam(particle.position) - centre);
        if (distance < nearestDistance)
        {
            nearest = &particle;
            nearestDistance = distance;
        }
    }
    return "cell " + Foam::name(cell) + " at " + Foam::name(centre) + " m, void fraction "
           + Foam::name(1 - solidFraction_[cell])
           + (nearest ? ", nearest particle " + Foam::name(label(nearest->id)) : string());
}

void FluidCoupling::reportParticleOutsideMesh(const ParticlesView& particles, Eigen::Index particle) const
{
    const vector position = toFoam(particles.position.col(particle));
    const label nearest = mesh_.nCells() > 0 ? mesh_.findNearestCell(position) : -1;
    FatalErrorInFunction << "Particle " << particles.id[particle] << " at " << position
                         << " m lies in no cell of the mesh; the nearest one, cell " << nearest << " of rank "
                         << Pstream::myProcNo() << ", is at " << (nearest < 0 ? vector::zero : mesh_.C()[nearest])
                         << " m; allowed: particles within the mesh, which on this rank spans " << mesh_.bounds()
                         << exit(FatalError);
    std::abort();
}

} // namespace clepsydra
