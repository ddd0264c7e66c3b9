#include "forces/beadForces.h"

#include "wordList.H"

namespace clepsydra
{

BeadForces::BeadForces(const Foam::dictionary& couplingProperties, const FluidProperties& fluid, PhaseTimers& timers)
:
    timers_(timers)
{
    for (const Foam::word& name : couplingProperties.get<Foam::wordList>("forceModels"))
    {
        models_.append(ForceModel::New(name, couplingProperties, fluid).ptr());
    }
}

void BeadForces::evaluate(const BeadsView& beads, double timeStep, Vectors force)
{
    const PhaseTimers::Scope timing = timers_.time("forces");
    sum_.setZero(beads.size());
    for (const ForceModel& model : models_)
    {
        model.add(beads, sum_);
    }
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        CouplingState& state = beads.state[bead];
        const double coefficient = sum_.implicitCoefficient[bead];
        const Vector3d handedOver =
            coefficient*(state.fluid.velocity - beads.velocity.col(bead)) + sum_.source.col(bead);
        force.col(bead) = handedOver + sum_.shared.col(bead);
        state.given.impulse += timeStep*handedOver;
        state.given.sharedImpulse += timeStep*sum_.shared.col(bead);
        state.given.implicitCoefficientTime += timeStep*coefficient;
    }
}

} // namespace clepsydra
