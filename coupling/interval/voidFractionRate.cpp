#include "interval/voidFractionRate.h"

#include "interval/couplingField.h"

#include <cmath>

namespace clepsydra
{

using namespace Foam;

VoidFractionRate::VoidFractionRate(const fvMesh& mesh, const CouplingSettings& settings)
    : used_(settings.ddtVoidFraction()),
      smoothingTime_(settings.ddtSmoothingTime()),
      smoothed_(couplingField<scalar>("voidFractionInContinuity", mesh, dimless, 1)),
      rate_(couplingField<scalar>("ddtVoidFraction", mesh, dimless / dimTime, 0))
{}

void VoidFractionRate::start(const volScalarField& voidFraction)
{
    smoothed_ == voidFraction;
}

void VoidFractionRate::update(const volScalarField& voidFraction, double interval)
{
    if (!used_)
    {
        return;
    }
    const double approach = smoothingTime_ > 0 ? -std::expm1(-interval / smoothingTime_) : 1;
    const scalarField change(approach * (voidFraction.primitiveField() - smoothed_.primitiveField()));
    smoothed_.primitiveFieldRef() += change;
    rate_.primitiveFieldRef() = change / interval;
}

double VoidFractionRate::spreadImbalance(double outflow)
{
    const scalarField& cellVolumes = rate_.mesh().V().field();
    const double imbalance =
        returnReduce(sum(rate_.primitiveField() * cellVolumes) + outflow, sumOp<scalar>()) / gSum(cellVolumes);
    rate_.primitiveFieldRef() -= imbalance;
    return imbalance;
}

} // namespace clepsydra
