#include "couplingStep/particlesInFluid.h"

#include "fvMatrices.H"
#include "fvcDiv.H"
#include "surfaceInterpolate.H"

#include <utility>

namespace clepsydra
{

using namespace Foam;

ParticlesInFluid::ParticlesInFluid(AnticipatedParticles anticipated, ParticleFields& fields,
    ConservationCheck& conservation, const ExchangedMomentum& received, double fluidDensity, double couplingTimeStep)
    : AnticipatedParticles(std::move(anticipated)),
      fields_(fields),
      conservation_(conservation),
      received_(received),
      fluidDensity_(fluidDensity),
      couplingTimeStep_(couplingTimeStep),
      voidFractionf_(fvc::interpolate(voidFraction())),
      movingf_(voidFractionf_ + fields_.rate.velocityResponse())
{}

void ParticlesInFluid::addMeanPressureGradient(surfaceScalarField& phiHbyA, const surfaceScalarField& rAUf) const
{
    if (const MeanPressureGradient& mean = fields_.pressure.mean(); mean.isActive())
    {
        phiHbyA -= rAUf * mean.throughFaces();
    }
}

void ParticlesInFluid::spreadImbalance(double outflow)
{
    conservation_.recordImbalance(couplingTimeStep_ * fields_.rate.spreadImbalance(outflow));
}

void ParticlesInFluid::spreadImbalance()
{
    conservation_.recordImbalance(couplingTimeStep_ * fields_.rate.spreadImbalance());
}

tmp<surfaceScalarField> ParticlesInFluid::pressureCoefficient(const surfaceScalarField& rAUf) const
{
    return movingf_ * rAUf + fields_.rate.pressureResponse();
}

tmp<volScalarField> ParticlesInFluid::explicitContinuity(const surfaceScalarField& phiHbyA) const
{
    const MeanPressureGradient& mean = fields_.pressure.mean();
    return fields_.rate.withoutImplicit()
           + (mean.isActive() ? fvc::div(movingf_ * phiHbyA - fields_.rate.pressureResponse() * mean.throughFaces())
                              : fvc::div(movingf_ * phiHbyA));
}

void ParticlesInFluid::setFlux(const surfaceScalarField& phi, const surfaceScalarField& gradient)
{
    anticipatedFlux_ = fields_.rate.velocityResponse() * phi - fields_.rate.pressureResponse() * gradient;
    if (const MeanPressureGradient& mean = fields_.pressure.mean(); mean.isActive())
    {
        anticipatedFlux_.ref() -= fields_.rate.pressureResponse() * mean.throughFaces();
    }
}

SolvedStep ParticlesInFluid::record(
    const fvVectorMatrix& source, const volVectorField& U, const volScalarField& p, const surfaceScalarField& alphaPhi)
{
    fields_.rate.close(anticipatedFlux_());
    return {*this, sum(U.mesh().V().field() * ((source & U) + sourceOfPressure(p))().primitiveField()),
        fields_.rate() + fvc::div(alphaPhi)};
}

void SolvedStep::checkConservation(const ExchangedMomentum& semiImplicit, RankTotals& totals) const
{
    ConservationCheck& conservation = particles_.conservation_;
    if (particles_.heat_)
    {
        conservation.addHeat(*particles_.heat_, totals);
    }
    const double timeStep = particles_.couplingTimeStep_;
    const double impulsePerSource = -particles_.fluidDensity_ * timeStep;
    RankNumbers ofRank;
    particles_.received_.appendTo(ofRank);
    semiImplicit.appendTo(ofRank);
    ofRank.addVector(sourceOfParticles_);
    totals.add(ofRank, [&conservation, impulsePerSource](const RankNumbers& all) {
        conservation.recordMomentum(ExchangedMomentum::in(all, 0),
            impulsePerSource * all.vectorAt<vector>(2 * ExchangedMomentum::size),
            ExchangedMomentum::in(all, ExchangedMomentum::size));
    });
    conservation.addContinuity(timeStep * continuityError_(), totals);
    totals.add({{particles_.fields_.rate.filteredVolume()}, {}},
        [&conservation](const RankNumbers& all) { conservation.recordFilteredVolume(all.sums[0]); });
}

} // namespace clepsydra
