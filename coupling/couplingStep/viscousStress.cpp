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

template<class Viscosity>
tmp<volVectorField> explicitly(const Viscosity& nu, const volVectorField& U)
{
    return fvc::laplacian(nu, U, "laplacian(nu,U)") + ofTranspose(nu, U);
}

template<class Viscosity>
tmp<fvVectorMatrix> implicitly(const Viscosity& nu, volVectorField& U)
{
    return fvm::laplacian(nu, U, "laplacian(nu,U)") + ofTranspose(nu, U);
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

tmp<volVectorField> ViscousStress::divergence(const volVectorField& U) const
{
    return stratified_ ? explicitly(*stratified_, U) : explicitly(uniform_, U);
}

tmp<fvVectorMatrix> ViscousStress::implicitDivergence(volVectorField& U) const
{
    return stratified_ ? implicitly(*stratified_, U) : implicitly(uniform_, U);
}

} // namespace clepsydra
