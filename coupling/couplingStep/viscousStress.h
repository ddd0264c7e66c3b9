#pragma once

#include "forces/fluidProperties.h"

#include "fvMatricesFwd.H"
#include "volFields.H"

#include <memory>

namespace clepsydra
{

/// Divergence of a Newtonian fluid's viscous stress per density, tau/rho = nu (grad U + grad U^T - 2/3 div U I) [m/s2].
/// Between particles div U is not zero, since their volume moves; so neither is the part with the transpose.
class ViscousStress
{
public:
    ViscousStress(const Foam::fvMesh& mesh, const FluidProperties& fluid);

    /// As the particles have it.
    Foam::tmp<Foam::volVectorField> divergence(const Foam::volVectorField& U) const;

    /// As the fluid's equation has it.
    Foam::tmp<Foam::fvVectorMatrix> implicitDivergence(Foam::volVectorField& U) const;

private:
    const Foam::dimensionedScalar uniform_;
    std::unique_ptr<Foam::volScalarField> stratified_; // none: uniform
};

} // namespace clepsydra
