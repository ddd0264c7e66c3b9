#pragma once

#include "engine/demEngine.h"
#include "forces/forceModel.h"
#include "forces/modelType.h"
#include "phaseTimers.h"

#include "PtrList.H"

namespace clepsydra
{

/// All forces of the fluid on the particles, as listed in `forceModels (...)`, evaluated at every DEM step from the particle's
/// own velocity and the frozen fluid; keeps the account of what the fluid must receive.
class ParticleForces final : public FluidForces
{
public:
    /// FatalIOError for an unknown force and for one that does not go with `modelType`.
    ParticleForces(const Foam::dictionary& couplingProperties, ModelType modelType, const FluidProperties& fluid,
        PhaseTimers& timers);

    void evaluate(const ParticlesView& particles, double timeStep, Vectors force) override;

    /// What any of the forces needs.
    ForceNeeds needs() const;

    const Foam::PtrList<ForceModel>& models() const
    {
        return models_;
    }

private:
    void evaluatePart(const ParticlesView& particles, double timeStep, Vectors force);
    /// Sets the velocity that the forces see to the one that the fluid would have without the particle.
    static void removeSelfInducedVelocity(const ParticlesView& particles);

    PhaseTimers& timers_;
    const ModelType modelType_;
    bool pairs_ = false;
    Foam::PtrList<ForceModel> models_;
    ForceSum sum_;
};

} // namespace clepsydra
