#include "couplingStep/fluidCoupling.h"

#include "couplingStep/couplingField.h"
#include "couplingStep/sampledFields.h"
#include "ranks.h"
#include "vectors.h"

#include "fvc.H"
#include "fvcCurl.H"
#include "fvcGrad.H"
#include "gaussGrad.H"

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

/// Text that names the nearest patch where the mesh ends, and says whether the position is beyond it. Collective.
string nearestPatch(const fvMesh& mesh, const point& position)
{
    scalar nearest = GREAT;
    string text;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        forAll (patch, face)
        {
            if (patch.coupled())
            {
                break;
            }
            const pointHit found = patch[face].nearestPoint(position, mesh.points());
            if (found.distance() < nearest)
            {
                nearest = found.distance();
                const bool beyond = ((position - found.rawPoint()) & patch.faceAreas()[face]) > 0;
                text = (beyond ? ", and is " + Foam::name(nearest) + " m beyond patch '" + patch.name()
                                     + "', which it has crossed"
                               : ", and the nearest patch is '" + patch.name() + '\'');
            }
        }
    }
    return firstOfRanks(nearest == returnReduce(nearest, minOp<scalar>()) ? text : string());
}

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
      torqueReaction_(needs.torque ? std::make_unique<TorqueReaction>(mesh, fluid.density) : nullptr),
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

ExchangedMomentum FluidCoupling::semiImplicitMomentum() const
{
    const ParticlesView particles = engine_.particles();
    const auto ofParticles = checkpointedState(particles).middleRows<3>(semiImplicitImpulse);
    const vectorField inCells(fluid_.density * mesh_.V().field() * semiImplicitSource_.pendingMomentum());
    double magnitudes = sum(mag(inCells));
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const double drag = anticipated_[static_cast<std::size_t>(particle)].drag;
        const FluidAtParticle& fluid = particles.state[particle].fluid;
        magnitudes += ofParticles.col(particle).norm()
                      + drag * (fluid.velocityInCells.norm() + particles.velocity.col(particle).norm());
    }
    const Vector3d sumOfParticles = ofParticles.rowwise().sum();
    return {returnReduce(toFoam(sumOfParticles), sumOp<vector>()) + gSum(inCells),
        returnReduce(magnitudes, sumOp<scalar>())};
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
    if (torqueReaction_)
    {
        torqueReaction_->update(engine_.particles(), exchange_, distribution_, couplingTimeStep);
    }
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

template<class Communicate>
auto FluidCoupling::exchanged(const Communicate& communicate)
{
    const PhaseTimers::Scope timing = timers_.time("exchange");
    return communicate();
}

Eigen::MatrixXd FluidCoupling::locate(const Reactions& reactions)
{
    exchanged([&] { exchange_.send(engine_.particles(), reactions); });
    const Eigen::MatrixXd sharesHere = [&] {
        const PhaseTimers::Scope timing = timers_.time("locate");
        return distribution_.findCells(exchange_.ghosts());
    }();
    return exchanged([&] { return exchange_.sumAtOwners(sharesHere); });
}

std::vector<bool> FluidCoupling::particlesOutsideMesh()
{
    const Eigen::Index count = engine_.particles().size();
    const Eigen::MatrixXd shareSums = locate(Reactions::Zero(reactionSize, count));
    std::vector<bool> outside;
    for (Eigen::Index particle = 0; particle < count; ++particle)
    {
        outside.push_back(!(shareSums(0, particle) > 0));
    }
    return outside;
}

void FluidCoupling::findCells()
{
    const Eigen::MatrixXd shareSums = locate(reactions());
    requireWithinMesh(shareSums);
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
    ClippedVolume clipped;
    label worstCell = -1;
    const double minimum = settings_.minimumVoidFraction();
    forAll (voidFraction, cell)
    {
        if (voidFraction[cell] < minimum)
        {
            worstCell = worstCell < 0 || solidFraction_[cell] > solidFraction_[worstCell] ? cell : worstCell;
            clipped.sum += (minimum - voidFraction[cell]) * cellVolumes[cell];
            voidFraction[cell] = minimum;
        }
    }
    voidFraction_.correctBoundaryConditions();
    const double worstHere = worstCell < 0 ? 0 : 1 - (1 - minimum) / solidFraction_[worstCell];
    clipped.sum = returnReduce(clipped.sum, sumOp<scalar>());
    if (clipped.sum > 0)
    {
        clipped.largestPart = returnReduce(worstHere, maxOp<scalar>());
        if (worstCell >= 0 && worstHere == clipped.largestPart)
        {
            clipped.worstCell = describeCell(worstCell);
        }
    }
    conservation_.recordSolidVolume(returnReduce(particleVolume, sumOp<scalar>()), cellVolume, clipped);
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
    const auto isInMesh = [&](Eigen::Index particle) { return !isOutsideMesh(particles.state[particle]); };
    sampled.store(exchange_.sumAtOwners(distribution_.sample(sampled.inCells())), isInMesh);
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        if (!isInMesh(particle))
        {
            particles.state[particle].fluid = FluidAtParticle();
            particles.state[particle].fluid.submergedFraction = 0;
        }
    }
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
    const vector& centre = mesh_.cellCentres()[cell];
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

std::optional<double> FluidCoupling::partNearClearFluid() const
{
    // Below this solid fraction few particles are within a bandwidth of each other, and its gradient is chance.
    constexpr double dense = 0.15;
    constexpr label fewestOfBed = 50;
    // At the edge of a bed the smoothed solid fraction is proportional to 1 + erf(z/b) at the depth z. This is its
    // gradient times b, over its value, at the depth b.
    static const double atDepthOfBandwidth = 2 / std::sqrt(M_PI) * std::exp(-1.0) / (1 + std::erf(1.0));

    const tmp<volVectorField> gradient = fv::gaussGrad<scalar>(mesh_).calcGrad(voidFraction_, "gradOfVoidFraction");
    Eigen::MatrixXd inCells(4, mesh_.nCells());
    inCells << columns(voidFraction_.primitiveField()), columns(gradient().primitiveField());
    const Eigen::MatrixXd atParticles = exchange_.sumAtOwners(distribution_.sample(inCells));
    const double bandwidth = distribution_.smoothingModel().bandwidth();
    label ofBed = 0;
    label nearEdge = 0;
    for (const auto& sampled : atParticles.colwise())
    {
        const double solid = 1 - sampled[0];
        ofBed += solid > dense;
        nearEdge += solid > dense && bandwidth * sampled.tail<3>().norm() > atDepthOfBandwidth * solid;
    }
    reduce(ofBed, sumOp<label>());
    reduce(nearEdge, sumOp<label>());
    if (ofBed < fewestOfBed)
    {
        return std::nullopt;
    }
    return static_cast<double>(nearEdge) / ofBed;
}

void FluidCoupling::requireWithinMesh(const Eigen::MatrixXd& shareSums) const
{
    const ParticlesView particles = engine_.particles();
    label count = 0;
    label lowestId = labelMax;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        if (!(shareSums(0, particle) > 0) && !isOutsideMesh(particles.state[particle]))
        {
            ++count;
            lowestId = min(lowestId, label(particles.id[particle]));
        }
    }
    reduce(count, sumOp<label>());
    if (count > 0)
    {
        reportOutsideMesh(count, returnReduce(lowestId, minOp<label>()));
    }
}

void FluidCoupling::reportOutsideMesh(label count, label id) const
{
    const ParticlesView particles = engine_.particles();
    vector position = vector::zero;
    vector velocity = vector::zero;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        if (particles.id[particle] == id)
        {
            position = toFoam(particles.position.col(particle));
            velocity = toFoam(particles.velocity.col(particle));
        }
    }
    reduce(position, sumOp<vector>());
    reduce(velocity, sumOp<vector>());
    const wordList outlets = settings_.dict().getOrDefault<wordList>("particleOutlets", wordList());
    FatalErrorInFunction << "Particle " << id << " at " << position << " m lies in no cell of the mesh, which spans "
                         << boundBox(mesh_.points(), true) << " m. It moves at " << mag(velocity) << " m/s, "
                         << velocity << nearestPatch(mesh_, position).c_str() << "; " << count
                         << " particles in all lie in no cell; allowed: particles within the mesh. Where particles may "
                         << "leave, list the patch in particleOutlets, which is now " << flatOutput(outlets)
                         << "; where they may be in parts of the DEM box without mesh and without fluid, set "
                         << "allowParticlesOutsideMesh yes; otherwise a wall of the DEM script is missing there"
                         << exit(FatalError);
    std::abort();
}

} // namespace clepsydra
