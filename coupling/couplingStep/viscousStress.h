#pragma once

#include "forces/fluidProperties.h"

#include "fvMatricesFwd.H"
#include "volFields.H"

#include <memory>

namespace clepsydra
{

/// The fluid's kinematic viscosity [m2/s] as a field of the given name and registration.
std::unique_ptr<Foam::volScalarField> kinematicViscosity(
    const Foam::IOobject& object, const Foam::fvMesh& mesh, const FluidProperties& fluid);

/// Divergence of the viscous stress of a Newtonian fluid, divided by its density: tau/rho = nu (grad U + grad U^T - 2/3
/// div U I) [m/s2]. Between particles div U is not zero, because the particles' volume moves; therefore the term with
/// the transpose is not zero either.
class ViscousStress
{
public:
    ViscousStress(const Foam::fvMesh& mesh, const FluidProperties& fluid);

    /// Explicit form, which the particles' forces use.
    Foam::tmp<Foam::volVectorField> divergence(const Foam::volVectorField& U) const;

    /// Implicit form, for the fluid's momentum equation.
    Foam::tmp<Foam::fvVectorMatrix> implicitDivergence(Foam::volVectorField& U) const;

private:
    const Foam::dimensionedScalar uniform_;
    std::unique_ptr<Foam::volScalarField> stratified_; // null where the viscosity is uniform
};

} // namespace clepsydra
