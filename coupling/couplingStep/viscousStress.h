#pragma once

#include "forces/fluidProperties.h"

#include "fvMatricesFwd.H"
#include "surfaceFields.H"
#include "volFields.H"

#include <memory>

namespace clepsydra
{

/// The fluid's kinematic viscosity [m2/s] as a field of the given name and registration.
std::unique_ptr<Foam::volScalarField> kinematicViscosity(
    const Foam::IOobject& object, const Foam::fvMesh& mesh, const FluidProperties& fluid);

/// A turbulence model of OpenFOAM for the fluid between the particles. Its equations have the void fraction, as those of
/// OpenFOAM's DPMFoam have. The models themselves are in a library that the solver loads.
class FluidTurbulence
{
public:
    virtual ~FluidTurbulence() = default;
    FluidTurbulence(const FluidTurbulence&) = delete;
    FluidTurbulence& operator=(const FluidTurbulence&) = delete;

    /// Solves the model's equations over the step over which U has been solved for, and updates the eddy viscosity.
    /// \param alphaPhi  flux of fluid through the faces as a volume per time [m3/s]
    virtual void correct(const Foam::surfaceScalarField& alphaPhi) = 0;

    /// Kinematic eddy viscosity [m2/s]; the reference remains valid.
    virtual const Foam::volScalarField& eddyViscosity() const = 0;

    /// Kinetic energy of the turbulence per mass [m2/s2].
    virtual Foam::tmp<Foam::volScalarField> k() const = 0;

    /// Its dissipation [m2/s3].
    virtual Foam::tmp<Foam::volScalarField> dissipation() const = 0;

protected:
    FluidTurbulence() = default;
};

/// Divergence of the viscous stress of a Newtonian fluid, divided by its density: tau/rho = nu (grad U + grad U^T - 2/3
/// div U I) [m/s2]. Between particles div U is not zero, because the particles' volume moves; therefore the term with
/// the transpose is not zero either. With a turbulence model nu is the sum of the fluid's and of the eddy viscosity.
class ViscousStress
{
public:
    ViscousStress(const Foam::fvMesh& mesh, const FluidProperties& fluid);

    /// Adds the Reynolds stress of a turbulence model, which must exist as long as the stress is used.
    void add(const FluidTurbulence& turbulence)
    {
        turbulence_ = &turbulence;
    }

    /// Null in laminar flow.
    const FluidTurbulence* turbulence() const
    {
        return turbulence_;
    }

    /// Explicit form, which the particles' forces use.
    Foam::tmp<Foam::volVectorField> divergence(const Foam::volVectorField& U) const;

    /// Implicit form, for the fluid's momentum equation.
    Foam::tmp<Foam::fvVectorMatrix> implicitDivergence(Foam::volVectorField& U) const;

private:
    Foam::tmp<Foam::volScalarField> effectiveViscosity() const;

    const Foam::dimensionedScalar uniform_;
    std::unique_ptr<Foam::volScalarField> stratified_; // null where the viscosity is uniform
    const FluidTurbulence* turbulence_ = nullptr;
};

} // namespace clepsydra
