#pragma once

#include "couplingState.h"
#include "forces/fluidProperties.h"
#include "runTimeSelection.h"

namespace clepsydra
{

/// What a force needs beyond what is always there.
struct ForceNeeds
{
    /// DU/Dt
    bool acceleration = false;
    /// curl U
    bool vorticity = false;
    /// div(tau)
    bool viscousStress = false;
    /// ParticlesView::pairs up to this gap, in units of the sum of the two radii; 0: none.
    double pairReach = 0;
    /// ParticlesView::memory: numbers per particle kept from step to step; 0: none. One force of a run may ask for it.
    int memory = 0;
};

/// The forces of one DEM step on the particles of one rank, split by what is implicit and by whose reaction the fluid
/// must be handed. Force on particle i, dv_i/dt being its acceleration:
///
///     implicitCoefficient[i] (U_fluid - v_i) + source.col(i) + addedMass[i] (DU/Dt - dv_i/dt)    handed to the fluid
///     + shared.col(i)                                                                            in its equation
///     + mutual.col(i)                                                                            not the fluid's
///
/// In model B what is handed over is the same divided by the void fraction (ParticleForces does that, no force model does).
struct ForceSum
{
    /// Sp [kg/s]. Reaction: handed to the fluid.
    Eigen::ArrayXd implicitCoefficient;
    /// Su [N]. Reaction: handed to the fluid.
    Eigen::Matrix3Xd source;
    /// Su [N]. Reaction: already in the fluid's equation (model A's eps grad p; the hydrostatic part of p).
    Eigen::Matrix3Xd shared;
    /// Su [N] between two particles, or a particle and a wall: the other one has the reaction.
    Eigen::Matrix3Xd mutual;
    /// m_a [kg], implicit in the particle's inertia. Reaction: handed to the fluid.
    Eigen::ArrayXd addedMass;
    /// Over which they act [s].
    double timeStep = 0;

    void setZero(Eigen::Index particleCount);
};

/// One force of the fluid on particles, selected by name in `forceModels (...)` of couplingProperties, coefficients in
/// `<name>Props`. A model adds its part for all particles of the rank at once; what it keeps between calls is in
/// ParticlesView::memory, for particles change ranks.
class ForceModel
{
public:
    TypeName("forceModel");

    declareRunTimeSelectionTable(Foam::autoPtr, ForceModel, dictionary,
        (const Foam::dictionary& coefficients, const FluidProperties& fluid), (coefficients, fluid))

        static Foam::autoPtr<ForceModel> New(
            const Foam::word& name, const Foam::dictionary& couplingProperties, const FluidProperties& fluid);

    virtual ~ForceModel() = default;

    virtual void add(const ParticlesView& particles, ForceSum& sum) const = 0;

    virtual ForceNeeds needs() const
    {
        return {};
    }

    /// True for what model A has beside the drag and model B has in it.
    virtual bool onlyInModelA() const
    {
        return false;
    }

    /// One line for the start of the log, with the coefficients.
    virtual Foam::string description() const = 0;
};

/// Makes a law of closures/ known under its own name, as a force model.
template<template<class> class Model, class Law>
struct RegisterLaw : ForceModel::adddictionaryConstructorToTable<Model<Law>>
{
    RegisterLaw()
        : ForceModel::adddictionaryConstructorToTable<Model<Law>>(Law::name),
          line("forceModels", {{Law::name, Law::line}})
    {}

    const ModelLines line;
};

} // namespace clepsydra
