#pragma once

#include "couplingStep/particlesInFluid.h"

#include "fvMatrices.H"

namespace clepsydra::tests
{

/// Records the solution of a momentum equation that has no equation of continuity beside it. \pre d(eps)/dt is zero,
/// because the case has `useDDTvoidfraction off`
inline SolvedStep recordWithoutContinuity(ParticlesInFluid& particles, const Foam::fvVectorMatrix& source,
    const Foam::volVectorField& U, const Foam::volScalarField& p)
{
    using namespace Foam;
    const auto zero = [&](const dimensionSet& dimensions) {
        return surfaceScalarField(
            IOobject("zero", U.time().timeName(), U.mesh()), U.mesh(), dimensionedScalar("zero", dimensions, 0));
    };
    const surfaceScalarField noFlux(zero(dimVolume / dimTime));
    particles.setFlux(noFlux, zero(dimVolume / sqr(dimTime)));
    return particles.record(source, U, p, noFlux);
}

} // namespace clepsydra::tests
