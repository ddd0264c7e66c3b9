#include "couplingStep/voidFractionRate.h"

#include "couplingStep/couplingField.h"
#include "vectors.h"

#include "Pstream.H"
#include "fvcDiv.H"
#include "surfaceInterpolate.H"

#include <cmath>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// The anticipated motion takes no particle through the boundary of the mesh.
template<class Type>
void closeBoundary(GeometricField<Type, fvsPatchField, surfaceMesh>& field)
{
    for (fvsPatchField<Type>& patch : field.boundaryFieldRef())
    {
        if (!patch.coupled())
        {
            patch == pTraits<Type>::zero;
        }
    }
}

} // namespace

VoidFractionRate::VoidFractionRate(const fvMesh& mesh, const CouplingSettings& settings)
    : used_(settings.ddtVoidFraction()),
      smoothingTime_(settings.ddtSmoothingTime()),
      meshVolume_(gSum(mesh.V().field())),
      integral_(couplingField<scalar>("voidFractionInContinuity", mesh, dimless, 1)),
      explicitRate_(temporaryField<volScalarField>("explicitRate", mesh, dimless / dimTime)),
      velocityResponse_(temporaryField<surfaceScalarField>("velocityResponse", mesh, dimless)),
      pressureResponse_(temporaryField<surfaceScalarField>("pressureResponse", mesh, dimTime)),
      rate_(couplingField<scalar>("ddtVoidFraction", mesh, dimless / dimTime, 0))
{
    integral_.oldTime();
}

void VoidFractionRate::start(const volScalarField& voidFraction)
{
    integral_ == voidFraction;
}

void VoidFractionRate::meshMoved()
{
    const fvMesh& mesh = integral_.mesh();
    const scalarField& before = mesh.V0().field();
    const scalarField& now = mesh.V().field();
    meshVolume_ = gSum(now);
    scalarField& integral = integral_.primitiveFieldRef();
    integral = 1 - (1 - integral) * before / now;
    expansion_ = (1 - before / now) / mesh.time().deltaTValue();
}

void VoidFractionRate::update(const volScalarField& voidFraction, const Eigen::Ref<const Eigen::MatrixXd>& densities,
    const Eigen::Ref<const Eigen::RowVectorXd>& anticipated, double couplingTimeStep, RankTotals& totals)
{
    couplingTimeStep_ = couplingTimeStep;
    spread_ = 0;
    unspread_ = 0;
    if (!used_)
    {
        return;
    }
    const fvMesh& mesh = voidFraction.mesh();
    const double approach = smoothingTime_ > 0 ? -std::expm1(-couplingTimeStep / smoothingTime_) : 1;
    passed_ = approach;
    const auto inCells = [&](const Eigen::Ref<const Eigen::RowVectorXd>& density, const dimensionSet& dimensions) {
        auto field = temporaryField<volScalarField>("ofParticles", mesh, dimensions);
        columns(field.primitiveFieldRef()) = approach * density;
        field.correctBoundaryConditions();
        return field;
    };
    velocityResponse_ = fvc::interpolate(inCells(densities.row(0), dimless));
    pressureResponse_ = fvc::interpolate(inCells(densities.row(1), dimTime));
    auto particleFlux = temporaryField<volVectorField>("particleFlux", mesh, dimVelocity);
    columns(particleFlux.primitiveFieldRef()) = approach * densities.bottomRows<3>();
    particleFlux.correctBoundaryConditions();
    surfaceScalarField flux(fvc::interpolate(particleFlux) & mesh.Sf());
    if (mesh.moving())
    {
        // That of the implicit part is relative to the mesh with the flux of U.
        flux -= fvc::interpolate(inCells(anticipated - densities.row(0), dimless)) * mesh.phi();
    }
    closeBoundary(velocityResponse_);
    closeBoundary(pressureResponse_);
    closeBoundary(flux);
    explicitRate_ = fvc::div(flux);
    explicitRate_.primitiveFieldRef() +=
        approach / couplingTimeStep * (voidFraction.primitiveField() - integral_.primitiveField());
    if (!expansion_.empty())
    {
        explicitRate_.primitiveFieldRef() += expansion_;
    }
    totals.add({{explicitRateHere()}, {}}, [this](const RankNumbers& all) { unspread_ = all.sums[0]; });
}

double VoidFractionRate::explicitRateHere() const
{
    return sum(explicitRate_.primitiveField() * rate_.mesh().V().field());
}

double VoidFractionRate::spreadImbalance(double outflow)
{
    // Needed at once, by the equation of the pressure.
    return spread(RankTotals::of({{explicitRateHere() + outflow}, {}}).sums[0]);
}

double VoidFractionRate::spreadImbalance()
{
    // What rounding leaves of an imbalance that has been spread is no reason for a reduction.
    return spread(Pstream::parRun() ? unspread_ : explicitRateHere());
}

double VoidFractionRate::spread(double imbalance)
{
    const double perVolume = imbalance / meshVolume_;
    explicitRate_.primitiveFieldRef() -= perVolume;
    spread_ += perVolume;
    unspread_ = 0;
    return perVolume;
}

void VoidFractionRate::close(const surfaceScalarField& flux)
{
    rate_ = explicitRate_ + fvc::div(flux);
    // The imbalance that was distributed does not remain as an error to be corrected.
    integral_.primitiveFieldRef() += couplingTimeStep_ * (rate_.primitiveField() + spread_);
    if (!expansion_.empty())
    {
        integral_.primitiveFieldRef() -= couplingTimeStep_ * expansion_;
    }
}

double VoidFractionRate::filteredVolume() const
{
    scalarField ofParticles(rate_.primitiveField() + spread_);
    if (!expansion_.empty())
    {
        ofParticles -= expansion_;
    }
    const scalarField passed(couplingTimeStep_ * mag(ofParticles));
    return (1 / passed_ - 1) * sum(passed * rate_.mesh().V().field());
}

} // namespace clepsydra
