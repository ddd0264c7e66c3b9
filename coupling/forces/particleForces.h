#pragma once

#include "engine/demEngine.h"
#include "forces/forceModel.h"
#include "forces/modelType.h"
#include "phaseTimers.h"

#include "PtrList.H"
#include "fileName.H"

namespace clepsydra
{

/// All forces of the fluid on the particles, as listed in `forceModels (...)`. They are evaluated at every DEM step
/// from the particle's present velocity and the frozen fluid. The impulses that the fluid must receive in return are
/// summed in CouplingState::received.
class ParticleForces final : public FluidForces
{
public:
    /// FatalIOError for an unknown force, for one that is incompatible with `modelType` or `coarseGraining`, and for two
    /// of one family.
    ParticleForces(const Foam::dictionary& couplingProperties, ModelType modelType, const FluidProperties& fluid,
        PhaseTimers& timers);

    /// FatalError where the DEM step is longer than twice the time in which drag brings a particle that the forces move to
    /// the fluid's velocity, because its velocity would then oscillate and grow from step to step.
    void evaluate(const ParticlesView& particles, double timeStep, Vectors force) override;

    /// Checks that `forceModels` has a model, or the word that leaves it out, for each term that the equations of
    /// `modelType` ask for: drag and buoyancy, in model A also pressure gradient and viscous stress. FatalIOError that
    /// names what is missing and what is allowed.
    void requireAllTerms(const Foam::dictionary& couplingProperties) const;

    /// Quantities that at least one of the forces needs.
    ForceNeeds needs() const;

    /// Whether one of the forces is a torque, whose impulse is summed in CouplingState::angularImpulse.
    bool haveTorque() const
    {
        return torque_;
    }

    /// Sum over this rank's particles of the impulse that the pressure gradient has given them since the last call
    /// [N s]; model A only.
    Vector3d takePressureImpulse();

    const Foam::PtrList<ForceModel>& models() const
    {
        return models_;
    }

    /// Names of models(), in the same order.
    const Foam::wordList& names() const
    {
        return names_;
    }

    /// Diameter of the particles of an engine divided by that of the real ones, see ForceModel::scalesToParcels().
    double coarseGraining() const
    {
        return coarseGraining_;
    }

private:
    /// FatalIOError where a wall is in the drag and in another force, so that it is counted twice.
    void checkWalls(const Foam::dictionary& couplingProperties) const;
    /// FatalIOError where the last model must not stand beside those before it, or in this `modelType`.
    void checkLastModel(const Foam::dictionary& couplingProperties) const;
    /// Adds the fluid's torques of sum_ to those of the other forces, and to CouplingState::angularImpulse.
    void addTorques(const ParticlesView& particles, double timeStep) const;
    void evaluatePart(const ParticlesView& particles, double timeStep, Vectors force);
    /// One real particle of each parcel, at the parcel's place. Valid until the next call.
    ParticlesView realParticles(const ParticlesView& parcels);
    [[noreturn]] void reportStiffDrag(
        const ParticlesView& particles, Eigen::Index particle, double relaxationTime, double timeStep) const;
    /// Sums up what the models add to particles or parcels.
    void addModels(const ParticlesView& particles);
    /// Sets the velocity that the forces use to the sampled one less the particle's self-induced velocity.
    static void removeSelfInducedVelocity(const ParticlesView& particles);

    PhaseTimers& timers_;
    const ModelType modelType_;
    const double coarseGraining_;
    const Foam::fileName script_;
    bool pairs_ = false;
    bool torque_ = false;
    Foam::wordList names_;
    Foam::PtrList<ForceModel> models_;
    ForceSum sum_;
    /// See realParticles().
    Eigen::ArrayXd realRadius_;
    Eigen::ArrayXd realMass_;
    Vector3d pressureImpulse_ = Vector3d::Zero();
};

} // namespace clepsydra
