#include "couplingStep/pressureOnParticles.h"

#include "couplingState.h"
#include "couplingStep/couplingField.h"
#include "vectors.h"

namespace clepsydra
{

using namespace Foam;

PressureOnParticles::PressureOnParticles(const fvMesh& mesh, ModelType modelType, bool isForce, double fluidDensity,
    const MeanPressureGradient& mean, ConservationCheck& conservation)
    : modelType_(modelType),
      acts_(modelType == ModelType::A && isForce),
      fluidDensity_(fluidDensity),
      mean_(mean),
      conservation_(conservation),
      factor_(
          temporaryField<volScalarField>("pressureFactor", mesh, dimless, 1, zeroGradientFvPatchScalarField::typeName))
{}

void PressureOnParticles::updateFactor(const volScalarField& voidFraction, const ConstRow& velocityResponse)
{
    factor_ = voidFraction;
    if (modelType_ == ModelType::B)
    {
        factor_.primitiveFieldRef() = 1;
    }
    else if (acts_)
    {
        columns(factor_.primitiveFieldRef()) += velocityResponse;
    }
    factor_.correctBoundaryConditions();
}

tmp<volVectorField> PressureOnParticles::source(const volScalarField& voidFraction, const volScalarField& p) const
{
    const dimensionedScalar active("active", dimless, acts_ ? 1 : 0);
    return active * (voidFraction - factor_) * mean_.gradient(p);
}

Eigen::MatrixXd PressureOnParticles::gradient(const volScalarField& p, const scalarField& solidFraction)
{
    const tmp<volVectorField> gradient = mean_.gradient(p);
    const vectorField& inCells = gradient().primitiveField();
    forceInFluid_ = -sum(fluidDensity_ * inCells * solidFraction * p.mesh().V().field());
    return modelType_ == ModelType::A ? Eigen::MatrixXd(fluidDensity_ * columns(inCells))
                                      : Eigen::MatrixXd::Zero(3, inCells.size());
}

void PressureOnParticles::sampledAt(const ParticlesView& particles)
{
    sumOfMagnitudes_ = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        sumOfMagnitudes_ +=
            volumeInFluid(particles, particle) * particles.state[particle].fluid.pressureGradient.norm();
    }
}

void PressureOnParticles::check(const Vector3d& onParticles, RankTotals& totals) const
{
    // In model B grad p does not act on the particles, and the fluid's equation holds no reaction to it.
    if (modelType_ != ModelType::A)
    {
        return;
    }
    RankNumbers ofRank;
    ofRank.addVector(onParticles);
    ofRank.addVector(forceInFluid_);
    ofRank.sums.push_back(sumOfMagnitudes_);
    totals.add(ofRank, [this](const RankNumbers& all) {
        conservation_.recordPressureForce(all.vectorAt<vector>(0), all.vectorAt<vector>(3), all.sums[6], !acts_);
    });
}

} // namespace clepsydra
