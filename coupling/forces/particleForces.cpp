#include "forces/particleForces.h"

#include "HashSet.H"
#include "wordList.H"

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace clepsydra
{

namespace
{

constexpr Eigen::Index particlesAtATime = 64;

/// Prefetches the part of the states of particles `first` to `end` that every force needs; the evaluation of contacts
/// has displaced it from the caches.
void prefetch(const ParticlesView& particles, Eigen::Index first, Eigen::Index end)
{
    constexpr std::size_t cacheLine = 64;
    for (Eigen::Index particle = first; particle < end; ++particle)
    {
        const char* const state = reinterpret_cast<const char*>(particles.state + particle);
        for (std::size_t byte = 0; byte <= offsetof(CouplingState, fluid.velocityInCells); byte += cacheLine)
        {
            __builtin_prefetch(state + byte, 1);
        }
    }
}

/// View of the particles `first` to `first + count`, with all pairs.
ParticlesView segmentOf(const ParticlesView& particles, Eigen::Index first, Eigen::Index count)
{
    const auto values = [&](const auto& all) { return std::decay_t<decltype(all)>(all.data() + first, count); };
    const auto vectors = [&](const ConstVectors& all) { return ConstVectors(all.data() + 3 * first, 3, count); };
    return {values(particles.id), vectors(particles.position), vectors(particles.velocity),
        vectors(particles.angularVelocity), values(particles.radius), values(particles.mass), particles.state + first,
        vectors(particles.otherForce), particles.pairs, particles.memory + first * particles.memorySize,
        particles.memorySize, particles.advancesMemory, values(particles.fixed)};
}

} // namespace

ParticleForces::ParticleForces(
    const Foam::dictionary& couplingProperties, ModelType modelType, const FluidProperties& fluid, PhaseTimers& timers)
    : timers_(timers),
      modelType_(modelType)
{
    Foam::wordHashSet names;
    for (const Foam::word& name : couplingProperties.get<Foam::wordList>("forceModels"))
    {
        if (!names.insert(name))
        {
            FatalIOErrorInFunction(couplingProperties)
                << "Entry 'forceModels' lists '" << name << "' twice; allowed: each force once"
                << Foam::exit(Foam::FatalIOError);
        }
        const bool memoryTaken = needs().memory > 0;
        models_.append(ForceModel::New(name, couplingProperties, fluid).ptr());
        if (modelType_ == ModelType::B && models_.last().onlyInModelA())
        {
            FatalIOErrorInFunction(couplingProperties)
                << "Entry 'forceModels' lists '" << name
                << "' and entry 'modelType' is B; allowed: without it, because in "
                << "model B the fluid has the whole pressure gradient and viscous stress, and the particles' part of "
                << "them is in their drag, which is divided by the void fraction" << Foam::exit(Foam::FatalIOError);
        }
        if (memoryTaken && models_.last().needs().memory > 0)
        {
            FatalIOErrorInFunction(couplingProperties)
                << "Entry 'forceModels' lists a second force that stores values per particle, '" << name
                << "'; allowed: one such force" << Foam::exit(Foam::FatalIOError);
        }
    }
    pairs_ = needs().pairReach > 0;
}

ForceNeeds ParticleForces::needs() const
{
    ForceNeeds needs;
    for (const ForceModel& model : models_)
    {
        needs.acceleration = needs.acceleration || model.needs().acceleration;
        needs.vorticity = needs.vorticity || model.needs().vorticity;
        needs.viscousStress = needs.viscousStress || model.needs().viscousStress;
        needs.pairReach = std::max(needs.pairReach, model.needs().pairReach);
        needs.memory = std::max(needs.memory, model.needs().memory);
    }
    return needs;
}

void ParticleForces::evaluate(const ParticlesView& particles, double timeStep, Vectors force)
{
    const PhaseTimers::Scope timing = timers_.time("forces");
    // Pairs may consist of any two particles; everything else is evaluated for a few particles at a time, so that their
    // states stay in the cache.
    const Eigen::Index most = pairs_ ? particles.size() : particlesAtATime;
    for (Eigen::Index first = 0; first < particles.size(); first += most)
    {
        const Eigen::Index count = std::min(most, particles.size() - first);
        prefetch(particles, first + count, std::min(first + 2 * count, particles.size()));
        evaluatePart(segmentOf(particles, first, count), timeStep, Vectors(force.data() + 3 * first, 3, count));
    }
}

void ParticleForces::evaluatePart(const ParticlesView& particles, double timeStep, Vectors force)
{
    sum_.setZero(particles.size());
    sum_.timeStep = timeStep;
    removeSelfInducedVelocity(particles);
    for (const ForceModel& model : models_)
    {
        model.add(particles, sum_);
    }
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        CouplingState& state = particles.state[particle];
        const double submergedFraction = state.fluid.submergedFraction;
        const double ofModel =
            modelType_ == ModelType::B ? submergedFraction / state.fluid.voidFraction : submergedFraction;
        const double coefficient = ofModel * sum_.implicitCoefficient[particle];
        const double addedMass = ofModel * sum_.addedMass[particle];
        Vector3d withReaction = coefficient * (state.fluid.velocity - particles.velocity.col(particle))
                                + ofModel * sum_.source.col(particle);
        const Vector3d withoutReaction = submergedFraction * sum_.shared.col(particle) + sum_.mutual.col(particle);
        if (addedMass > 0)
        {
            state.received.addedMassTime += timeStep * addedMass;
            // The particle's acceleration solves m dv/dt = all other forces + m_a (DU/Dt - dv/dt), which is stable for
            // any m_a/m.
            const Vector3d others = particles.otherForce.col(particle) + withReaction + withoutReaction;
            const Vector3d free =
                (others + addedMass * state.fluid.acceleration) / (particles.mass[particle] + addedMass);
            const Vector3d acceleration = particles.fixed[particle] ? Vector3d(Vector3d::Zero()) : free;
            withReaction += addedMass * (state.fluid.acceleration - acceleration);
        }
        force.col(particle) = withReaction + withoutReaction;
        if (state.fluid.selfMobility > 0)
        {
            state.drag = coefficient * (state.fluid.velocity - particles.velocity.col(particle));
        }
        state.received.impulse += timeStep * withReaction;
        state.received.implicitCoefficientTime += timeStep * coefficient;
    }
}

void ParticleForces::removeSelfInducedVelocity(const ParticlesView& particles)
{
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        FluidAtParticle& fluid = particles.state[particle].fluid;
        if (fluid.selfMobility > 0)
        {
            // The reaction of the particle's drag acts on the fluid. The drag of the last DEM step is used, because it
            // changes little from step to step. Only the drag is used, because the self-induced velocity is that of a
            // steady force: added mass and history force respond to a change of the fluid's velocity with so large a
            // force that each step would increase the change.
            fluid.velocity = fluid.velocityInCells + fluid.selfMobility * particles.state[particle].drag;
        }
    }
}

} // namespace clepsydra
