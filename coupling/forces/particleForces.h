#pragma once

#include "engine/demEngine.h"
#include "forces/forceModel.h"
#include "forces/modelType.h"
#include "phaseTimers.h"

#include "PtrList.H"

namespace clepsydra
{

/// All forces of the fluid on the particles, as listed in `forceModels (...)`. They are evaluated at every DEM step
/// from the particle's present velocity and the frozen fluid. The impulses that the fluid must receive in return are
/// summed in CouplingState::received.
class ParticleForces final : public FluidForces
{
public:
    /// FatalIOError for an unknown force and for one that is incompatible with `modelType`.
    ParticleForces(const Foam::dictionary& couplingProperties, ModelType modelType, const FluidProperties& fluid,
        PhaseTimers& timers);

    void evaluate(const ParticlesView& particles, double timeStep, Vectors force) override;

    /// Quantities that at least one of the forces needs.
    ForceNeeds needs() const;

    const Foam::PtrList<ForceModel>& models() const
    {
        return models_;
    }

private:
    void evaluatePart(const ParticlesView& particles, double timeStep, Vectors force);
    /// Sets the velocity that the forces use to the sampled one less the particle's self-induced velocity.
    static void removeSelfInducedVelocity(const ParticlesView& particles);

    PhaseTimers& timers_;
    const ModelType modelType_;
    bool pairs_ = false;
    Foam::PtrList<ForceModel> models_;
    ForceSum sum_;
};

} // namespace clepsydra
