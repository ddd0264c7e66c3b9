#include "forces/beadForces.h"

#include "HashSet.H"
#include "wordList.H"

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace clepsydra
{

namespace
{

constexpr Eigen::Index beadsAtATime = 64;

/// Asks for what every force needs of the states of beads `first` to `end`: the engine's contacts have pushed it out of
/// the near caches.
void prefetch(const BeadsView& beads, Eigen::Index first, Eigen::Index end)
{
    constexpr std::size_t cacheLine = 64;
    for (Eigen::Index bead = first; bead < end; ++bead)
    {
        const char* const state = reinterpret_cast<const char*>(beads.state + bead);
        for (std::size_t byte = 0; byte <= offsetof(CouplingState, fluid.velocityInCells); byte += cacheLine)
        {
            __builtin_prefetch(state + byte, 1);
        }
    }
}

/// Beads `first` to `first + count`, with all the pairs.
BeadsView segmentOf(const BeadsView& beads, Eigen::Index first, Eigen::Index count)
{
    const auto values = [&](const auto& all) { return std::decay_t<decltype(all)>(all.data() + first, count); };
    const auto vectors = [&](const ConstVectors& all) { return ConstVectors(all.data() + 3 * first, 3, count); };
    return {values(beads.id), vectors(beads.position), vectors(beads.velocity), vectors(beads.angularVelocity),
        values(beads.radius), values(beads.mass), beads.state + first, vectors(beads.otherForce), beads.pairs,
        beads.memory + first * beads.memorySize, beads.memorySize, beads.memoryAges, values(beads.held)};
}

} // namespace

BeadForces::BeadForces(
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
                << "Entry 'forceModels' lists '" << name << "' and entry 'modelType' is B; allowed: without it, for in "
                << "model B the fluid keeps the whole pressure gradient and viscous stress, and the beads' part of "
                << "them is in their drag, which is divided by the void fraction" << Foam::exit(Foam::FatalIOError);
        }
        if (memoryTaken && models_.last().needs().memory > 0)
        {
            FatalIOErrorInFunction(couplingProperties) << "Entry 'forceModels' lists a second force with a memory, '"
                                                       << name << "'; allowed: one" << Foam::exit(Foam::FatalIOError);
        }
    }
    pairs_ = needs().pairReach > 0;
}

ForceNeeds BeadForces::needs() const
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

void BeadForces::evaluate(const BeadsView& beads, double timeStep, Vectors force)
{
    const PhaseTimers::Scope timing = timers_.time("forces");
    // Pairs may be of any two beads, everything else is done for a few at a time: their states stay in the cache.
    const Eigen::Index most = pairs_ ? beads.size() : beadsAtATime;
    for (Eigen::Index first = 0; first < beads.size(); first += most)
    {
        const Eigen::Index count = std::min(most, beads.size() - first);
        prefetch(beads, first + count, std::min(first + 2 * count, beads.size()));
        evaluatePart(segmentOf(beads, first, count), timeStep, Vectors(force.data() + 3 * first, 3, count));
    }
}

void BeadForces::evaluatePart(const BeadsView& beads, double timeStep, Vectors force)
{
    sum_.setZero(beads.size());
    sum_.timeStep = timeStep;
    removeSelfDisturbance(beads);
    for (const ForceModel& model : models_)
    {
        model.add(beads, sum_);
    }
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        CouplingState& state = beads.state[bead];
        const double presence = state.fluid.presence;
        const double ofModel = modelType_ == ModelType::B ? presence / state.fluid.voidFraction : presence;
        const double coefficient = ofModel * sum_.implicitCoefficient[bead];
        const double addedMass = ofModel * sum_.addedMass[bead];
        Vector3d handedOver =
            coefficient * (state.fluid.velocity - beads.velocity.col(bead)) + ofModel * sum_.source.col(bead);
        const Vector3d notHandedOver = presence * sum_.shared.col(bead) + sum_.mutual.col(bead);
        if (addedMass > 0)
        {
            state.given.addedMassTime += timeStep * addedMass;
            // The bead's acceleration solves m dv/dt = all other forces + m_a (DU/Dt - dv/dt): stable at any m_a/m.
            const Vector3d others = beads.otherForce.col(bead) + handedOver + notHandedOver;
            const Vector3d free = (others + addedMass * state.fluid.acceleration) / (beads.mass[bead] + addedMass);
            const Vector3d acceleration = beads.held[bead] ? Vector3d(Vector3d::Zero()) : free;
            handedOver += addedMass * (state.fluid.acceleration - acceleration);
        }
        force.col(bead) = handedOver + notHandedOver;
        if (state.fluid.selfMobility > 0)
        {
            state.drag = coefficient * (state.fluid.velocity - beads.velocity.col(bead));
        }
        state.given.impulse += timeStep * handedOver;
        state.given.implicitCoefficientTime += timeStep * coefficient;
    }
}

void BeadForces::removeSelfDisturbance(const BeadsView& beads)
{
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        FluidAtBead& fluid = beads.state[bead].fluid;
        if (fluid.selfMobility > 0)
        {
            // The fluid has the opposite force. The one of the step before: it changes little from step to step. Only the drag,
            // for the disturbance is a steady one; added mass and history force answer a change of the fluid's velocity
            // with so large a force that each step would change it more.
            fluid.velocity = fluid.velocityInCells + fluid.selfMobility * beads.state[bead].drag;
        }
    }
}

} // namespace clepsydra
