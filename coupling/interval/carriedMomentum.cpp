#include "interval/carriedMomentum.h"

#include "interval/couplingField.h"
#include "vectors.h"

#include "fvmSup.H"

namespace clepsydra
{

using namespace Foam;

CarriedMomentum::CarriedMomentum(const fvMesh& mesh, double fluidDensity)
    : fluidDensity_(fluidDensity),
      coefficient_(fieldOfInterval<volScalarField>("anticipatedDrag", mesh, dimless / dimTime)),
      beadSource_(couplingField<vector>("beadSource", mesh, dimAcceleration, vector::zero)),
      given_(couplingField<vector>("unassignedMomentum", mesh, dimVelocity, vector::zero)),
      promised_(couplingField<vector>("promisedMomentum", mesh, dimVelocity, vector::zero))
{}

void CarriedMomentum::addPromised(Eigen::Ref<Eigen::MatrixXd> densities) const
{
    densities.topRows<3>() += fluidDensity_ * columns(promised_.primitiveField());
}

void CarriedMomentum::update(const Eigen::Ref<const Eigen::MatrixXd>& densities, double interval)
{
    interval_ = interval;
    const double perMassAndTime = 1 / (fluidDensity_ * interval);
    columns(beadSource_.primitiveFieldRef()) = -perMassAndTime * densities.topRows<3>();
    columns(coefficient_.primitiveFieldRef()) = perMassAndTime * densities.row(3);
    beadSource_.correctBoundaryConditions();
}

tmp<fvVectorMatrix> CarriedMomentum::source(volVectorField& U) const
{
    const dimensionedScalar interval("interval", dimTime, interval_);
    return beadSource_ + given_ / interval - fvm::Sp(coefficient_, U);
}

void CarriedMomentum::carry(
    const volVectorField& U, const volVectorField& sourceOfPressure, const Eigen::Ref<const Eigen::MatrixXd>& densities)
{
    given_.primitiveFieldRef() =
        interval_ * (coefficient_.primitiveField() * U.primitiveField() - sourceOfPressure.primitiveField());
    given_.correctBoundaryConditions();
    columns(promised_.primitiveFieldRef()) = densities / fluidDensity_;
}

void CarriedMomentum::takeFrom(volVectorField& U, const volScalarField& voidFraction) const
{
    const scalarField& fluid = voidFraction.primitiveField();
    U.primitiveFieldRef() = (fluid * U.primitiveField() + interval_ * beadSource_.primitiveField())
                            / (fluid + interval_ * coefficient_.primitiveField());
    U.correctBoundaryConditions();
}

} // namespace clepsydra
