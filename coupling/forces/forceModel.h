#pragma once

#include "couplingState.h"
#include "forces/fluidProperties.h"
#include "forces/forceFamily.h"
#include "forces/wallPlanes.h"
#include "runTimeSelection.h"

namespace clepsydra
{

/// Quantities that a force needs beyond those that are always available.
struct ForceNeeds
{
    /// grad p.
    bool pressureGradient = false;
    /// DU/Dt.
    bool acceleration = false;
    /// curl U.
    bool vorticity = false;
    /// div(tau).
    bool viscousStress = false;
    /// Sauter mean diameter of the particles around each particle.
    bool sauterMeanDiameter = false;
    /// ParticlesView::torque and ForceSum::torqueCoefficient.
    bool torque = false;
    /// Gap up to which ParticlesView::pairs is needed, divided by the sum of the two radii; 0 for none.
    double pairReach = 0;
    /// Number of values per particle in ParticlesView::memory, stored from step to step; 0 for none. Only one force of
    /// a run may use it.
    int memory = 0;
};

/// Sum of all forces of one DEM step on the particles of one rank. Parts are separated by whether they are implicit and
/// by where their reaction on the fluid is. The force on particle i with the acceleration dv_i/dt is
///
///     implicitCoefficient[i] (U_fluid - v_i) + source.col(i)
///     + addedMass[i] (DU/Dt - dv_i/dt)    reaction: a source of the fluid
///     + pressure.col(i)                   reaction: already in the fluid's equation
///     + shared.col(i)                     reaction: on the tank
///     + mutual.col(i)                     reaction: on another particle or a wall
///
/// ParticleForces multiplies all but `mutual` by FluidAtParticle::submergedFraction. A model multiplies `mutual` itself, by
/// one factor for both partners, so that the forces stay equal and opposite.
///
/// The torque on it is torqueCoefficient[i] (curl(U)/2 - omega_i); its reaction is a couple in the fluid.
///
/// In model B the first two lines are divided by the void fraction; ParticleForces does this, the force models do not.
struct ForceSum
{
    /// Sp [kg/s]. Its reaction is a source of the fluid.
    Eigen::ArrayXd implicitCoefficient;
    /// Su [N]. Its reaction is a source of the fluid.
    Eigen::Matrix3Xd source;
    /// Su [N]. Its reaction is already in the fluid's equation: model A's -V_p grad p. The conservation check compares
    /// both.
    Eigen::Matrix3Xd pressure;
    /// Su [N]. Its reaction acts on the tank: the hydrostatic part of p.
    Eigen::Matrix3Xd shared;
    /// Su between two particles, or a particle and a wall [N]. Its reaction acts on the other one.
    Eigen::Matrix3Xd mutual;
    /// m_a [kg], implicit in the particle's inertia. Its reaction is a source of the fluid.
    Eigen::ArrayXd addedMass;
    /// C_t [N m s]; empty unless a force has ForceNeeds::torque. Its reaction is a couple in the fluid.
    Eigen::ArrayXd torqueCoefficient;
    /// DEM step over which the forces act [s].
    double timeStep = 0;

    void setZero(Eigen::Index particleCount);

    /// Multiplies all forces whose reaction is not on another particle or a wall. \pre no torque, no mutual force
    void multiplyBy(double factor);
};

/// One force of the fluid on the particles. It is selected by name in `forceModels (...)` of couplingProperties, with
/// coefficients in `<name>Props`. A model adds its force on all particles of the rank at once. Values that it stores
/// between calls are in ParticlesView::memory, because particles change ranks. A model declares its family, most simply
/// by the base class ForceOf.
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

    virtual ForceFamily family() const = 0;

    /// The term in the equation of motion of a particle, with its sign, as the report at the start of the log prints it.
    virtual Foam::string term() const
    {
        return textOf(family()).term;
    }

    /// True for an entry of forceModels that leaves the term of its family out.
    virtual bool isLeftOut() const
    {
        return false;
    }

    virtual ForceNeeds needs() const
    {
        return {};
    }

    /// True for a force that is separate from the drag in model A and contained in the drag in model B.
    virtual bool onlyInModelA() const
    {
        return false;
    }

    /// Plane walls whose resistance the force contains at gaps above a fifth of a radius. Two forces with the same wall
    /// would count it twice.
    virtual std::vector<WallPlane> resistingWalls() const
    {
        return {};
    }

    /// Whether the force on a parcel (`coarseGraining` other than 1) is that on one of its particles times their
    /// number. For parcels add() receives the radius and the mass of one real particle, with the position, the velocity
    /// and the fluid of the parcel, and ParticleForces multiplies what it adds. A model for which this is false is
    /// refused by name. It is false for forces that depend on distances between particles, on rotation or on walls:
    /// these are not the same for the particles of a parcel, and a parcel has the moment of inertia of its own size.
    virtual bool scalesToParcels() const
    {
        return false;
    }

    /// One line with the coefficients for the report at the start of the log.
    virtual Foam::string description() const = 0;
};

/// Base of the models of one family.
template<ForceFamily Family>
class ForceOf : public ForceModel
{
public:
    static constexpr ForceFamily declaredFamily = Family;

    ForceFamily family() const final
    {
        return Family;
    }
};

/// Registers a law of closures/ as a force model under the law's own name.
template<template<class> class Model, class Law>
struct RegisterLaw : ForceModel::adddictionaryConstructorToTable<Model<Law>>
{
    RegisterLaw()
        : ForceModel::adddictionaryConstructorToTable<Model<Law>>(Law::name),
          line(Model<Law>::declaredFamily, {{Law::name, Law::line}})
    {}

    const ForceLines line;
};

} // namespace clepsydra
