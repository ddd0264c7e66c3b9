#include "forces/beadForces.h"

#include "wordList.H"

#include <algorithm>

namespace clepsydra
{

BeadForces::BeadForces(const Foam::dictionary& couplingProperties, const FluidProperties& fluid, PhaseTimers& timers)
    : timers_(timers),
      modelType_(readModelType(couplingProperties))
{
    for (const Foam::word& name : couplingProperties.get<Foam::wordList>("forceModels"))
    {
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
}

ForceNeeds BeadForces::needs() const
{
    ForceNeeds needs;
    for (const ForceModel& model : models_)
    {
        needs.acceleration = needs.acceleration || model.needs().acceleration;
        needs.vorticity = needs.vorticity || model.needs().vorticity;
        needs.pairReach = std::max(needs.pairReach, model.needs().pairReach);
        needs.memory = std::max(needs.memory, model.needs().memory);
    }
    return needs;
}

void BeadForces::evaluate(const BeadsView& beads, double timeStep, Vectors force)
{
    const PhaseTimers::Scope timing = timers_.time("forces");
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
        const double ofModel = modelType_ == ModelType::B ? 1 / state.fluid.voidFraction : 1;
        const double coefficient = ofModel * sum_.implicitCoefficient[bead];
        const double addedMass = ofModel * sum_.addedMass[bead];
        Vector3d handedOver =
            coefficient * (state.fluid.velocity - beads.velocity.col(bead)) + ofModel * sum_.source.col(bead);
        const Vector3d notHandedOver = sum_.shared.col(bead) + sum_.mutual.col(bead);
        if (addedMass > 0)
        {
            // The bead's acceleration solves m dv/dt = all other forces + m_a (DU/Dt - dv/dt): stable at any m_a/m.
            const Vector3d others = beads.otherForce.col(bead) + handedOver + notHandedOver;
            const Vector3d acceleration =
                (others + addedMass * state.fluid.acceleration) / (beads.mass[bead] + addedMass);
            handedOver += addedMass * (state.fluid.acceleration - acceleration);
        }
        force.col(bead) = handedOver + notHandedOver;
        state.handedOver = handedOver;
        state.given.impulse += timeStep * handedOver;
        state.given.sharedImpulse += timeStep * sum_.shared.col(bead);
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
            // The fluid has the opposite force. The one of the step before: it changes little from step to step.
            fluid.velocity = fluid.velocityInCells + fluid.selfMobility * beads.state[bead].handedOver;
        }
    }
}

} // namespace clepsydra
