#pragma once

#include "fvcDiv.H"
#include "fvcGrad.H"
#include "fvcLaplacian.H"
#include "fvmLaplacian.H"
#include "volFields.H"

namespace clepsydra
{

/// Divergence of a Newtonian fluid's viscous stress per density, tau/rho = nu (grad U + grad U^T - 2/3 div U I) [m/s2].
/// Between beads div U is not zero, since their volume moves; so neither is the part with the transpose.
inline Foam::tmp<Foam::volVectorField> divergenceOfTransposedStress(
    const Foam::dimensionedScalar& nu, const Foam::volVectorField& U)
{
    return Foam::fvc::div(nu * Foam::dev2(Foam::T(Foam::fvc::grad(U))));
}

/// As the beads have it.
inline Foam::tmp<Foam::volVectorField> divergenceOfViscousStress(
    const Foam::dimensionedScalar& nu, const Foam::volVectorField& U)
{
    return Foam::fvc::laplacian(nu, U, "laplacian(nu,U)") + divergenceOfTransposedStress(nu, U);
}

/// As the fluid's equation has it.
inline Foam::tmp<Foam::fvVectorMatrix> implicitDivergenceOfViscousStress(
    const Foam::dimensionedScalar& nu, Foam::volVectorField& U)
{
    return Foam::fvm::laplacian(nu, U, "laplacian(nu,U)") + divergenceOfTransposedStress(nu, U);
}

} // namespace clepsydra
