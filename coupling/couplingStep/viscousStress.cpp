#include "couplingStep/viscousStress.h"

#include "vectors.h"

#include "fvcDiv.H"
#include "fvcGrad.H"
#include "fvcLaplacian.H"
#include "fvmLaplacian.H"

namespace clepsydra
{

using namespace Foam;

namespace
{

template<class Viscosity>
tmp<volVectorField> ofTranspose(const Viscosity& nu, const volVectorField& U)
{
    return fvc::div(nu * dev2(T(fvc::grad(U))));
}

/// Names of the schemes, as those of OpenFOAM's single-phase solvers.
const word laminarScheme("laplacian(nu,U)");
const word turbulentScheme("laplacian(nuEff,U)");

template<class Viscosity>
tmp<volVectorField> explicitly(const Viscosity& nu, const volVectorField& U, const word& scheme)
{
    return fvc::laplacian(nu, U, scheme) + ofTranspose(nu, U);
}

template<class Viscosity>
tmp<fvVectorMatrix> implicitly(const Viscosity& nu, volVectorField& U, const word& scheme)
{
    return fvm::laplacian(nu, U, scheme) + ofTranspose(nu, U);
}

void setViscosity(scalarField& nu, const vectorField& places, const FluidProperties& fluid)
{
    forAll (nu, i)
    {
        nu[i] = fluid.viscosityAt(toEigen(places[i])) / fluid.density;
    }
}

} // namespace

std::unique_ptr<volScalarField> kinematicViscosity(
    const IOobject& object, const fvMesh& mesh, const FluidProperties& fluid)
{
    auto nu = std::make_unique<volScalarField>(
        object, mesh, dimensionedScalar("nu", dimViscosity, fluid.dynamicViscosity / fluid.density));
    setViscosity(nu->primitiveFieldRef(), mesh.C().primitiveField(), fluid);
    nu->correctBoundaryConditions();
    forAll (mesh.boundary(), patch)
    {
        if (!mesh.boundary()[patch].coupled())
        {
            setViscosity(nu->boundaryFieldRef()[patch], mesh.boundary()[patch].Cf(), fluid);
        }
    }
    return nu;
}

ViscousStress::ViscousStress(const fvMesh& mesh, const FluidProperties& fluid)
    : uniform_("nu", dimViscosity, fluid.dynamicViscosity / fluid.density)
{
    if (fluid.stratification.isThere())
    {
        const IOobject unregistered("nu", mesh.time().constant(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, false);
        stratified_ = kinematicViscosity(unregistered, mesh, fluid);
    }
}

tmp<volScalarField> ViscousStress::effectiveViscosity() const
{
    const volScalarField& eddyViscosity = turbulence_->eddyViscosity();
    return tmp<volScalarField>::New("nuEff", stratified_ ? eddyViscosity + *stratified_ : eddyViscosity + uniform_);
}

tmp<volVectorField> ViscousStress::divergence(const volVectorField& U) const
{
    if (turbulence_)
    {
        return explicitly(effectiveViscosity()(), U, turbulentScheme);
    }
    return stratified_ ? explicitly(*stratified_, U, laminarScheme) : explicitly(uniform_, U, laminarScheme);
}

tmp<fvVectorMatrix> ViscousStress::implicitDivergence(volVectorField& U) const
{
    if (turbulence_)
    {
        return implicitly(effectiveViscosity()(), U, turbulentScheme);
    }
    return stratified_ ? implicitly(*stratified_, U, laminarScheme) : implicitly(uniform_, U, laminarScheme);
}

} // namespace clepsydra
