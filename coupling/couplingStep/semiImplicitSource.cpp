#include "couplingStep/semiImplicitSource.h"

#include "couplingStep/couplingField.h"
#include "vectors.h"

#include "fvmSup.H"

namespace clepsydra
{

using namespace Foam;

SemiImplicitSource::SemiImplicitSource(const fvMesh& mesh, double fluidDensity)
    : fluidDensity_(fluidDensity),
      coefficient_(temporaryField<volScalarField>("anticipatedDrag", mesh, dimless / dimTime)),
      particleSource_(couplingField<vector>("particleSource", mesh, dimAcceleration, vector::zero)),
      given_(couplingField<vector>("semiImplicitMomentum", mesh, dimVelocity, vector::zero)),
      deferred_(couplingField<vector>("deferredMomentum", mesh, dimVelocity, vector::zero))
{}

void SemiImplicitSource::addDeferred(Eigen::Ref<Eigen::MatrixXd> densities) const
{
    densities.topRows<3>() += fluidDensity_ * columns(deferred_.primitiveField());
}

void SemiImplicitSource::update(const Eigen::Ref<const Eigen::MatrixXd>& densities, double couplingTimeStep)
{
    couplingTimeStep_ = couplingTimeStep;
    const double perMassAndTime = 1 / (fluidDensity_ * couplingTimeStep);
    columns(particleSource_.primitiveFieldRef()) = -perMassAndTime * densities.topRows<3>();
    columns(coefficient_.primitiveFieldRef()) = perMassAndTime * densities.row(3);
    particleSource_.correctBoundaryConditions();
}

tmp<fvVectorMatrix> SemiImplicitSource::source(volVectorField& U) const
{
    const dimensionedScalar timeStep("couplingTimeStep", dimTime, couplingTimeStep_);
    return particleSource_ + given_ / timeStep - fvm::Sp(coefficient_, U);
}

void SemiImplicitSource::defer(
    const volVectorField& U, const volVectorField& sourceOfPressure, const Eigen::Ref<const Eigen::MatrixXd>& densities)
{
    given_.primitiveFieldRef() =
        couplingTimeStep_ * (coefficient_.primitiveField() * U.primitiveField() - sourceOfPressure.primitiveField());
    given_.correctBoundaryConditions();
    columns(deferred_.primitiveFieldRef()) = densities / fluidDensity_;
}

void SemiImplicitSource::meshMoved()
{
    const fvMesh& mesh = given_.mesh();
    const scalarField ratio(mesh.V0().field() / mesh.V().field());
    given_.primitiveFieldRef() *= ratio;
    given_.correctBoundaryConditions();
    deferred_.primitiveFieldRef() *= ratio;
}

void SemiImplicitSource::subtractFirstDrag(volVectorField& U, const volScalarField& voidFraction) const
{
    const scalarField& fluid = voidFraction.primitiveField();
    U.primitiveFieldRef() = (fluid * U.primitiveField() + couplingTimeStep_ * particleSource_.primitiveField())
                            / (fluid + couplingTimeStep_ * coefficient_.primitiveField());
    U.correctBoundaryConditions();
}

} // namespace clepsydra
