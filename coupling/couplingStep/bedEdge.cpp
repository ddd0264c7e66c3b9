#include "couplingStep/bedEdge.h"

#include "vectors.h"

#include "gaussGrad.H"

#include <cmath>

namespace clepsydra
{

using namespace Foam;

std::optional<double> partNearClearFluid(
    const volScalarField& voidFraction, const LocatedParticles& particles, double bandwidth)
{
    // Below this solid fraction few particles are within a bandwidth of each other, and its gradient is chance.
    constexpr double dense = 0.15;
    constexpr label fewestOfBed = 50;
    // At the edge of a bed the smoothed solid fraction is proportional to 1 + erf(z/b) at the depth z. This is its
    // gradient times b, over its value, at the depth b.
    static const double atDepthOfBandwidth = 2 / std::sqrt(M_PI) * std::exp(-1.0) / (1 + std::erf(1.0));

    const tmp<volVectorField> gradient =
        fv::gaussGrad<scalar>(voidFraction.mesh()).calcGrad(voidFraction, "gradOfVoidFraction");
    Eigen::MatrixXd inCells(4, voidFraction.size());
    inCells << columns(voidFraction.primitiveField()), columns(gradient().primitiveField());
    const Eigen::MatrixXd atParticles = particles.sample(inCells);
    label ofBed = 0;
    label nearEdge = 0;
    for (const auto& sampled : atParticles.colwise())
    {
        const double solid = 1 - sampled[0];
        ofBed += solid > dense;
        nearEdge += solid > dense && bandwidth * sampled.tail<3>().norm() > atDepthOfBandwidth * solid;
    }
    reduce(ofBed, sumOp<label>());
    reduce(nearEdge, sumOp<label>());
    if (ofBed < fewestOfBed)
    {
        return std::nullopt;
    }
    return static_cast<double>(nearEdge) / ofBed;
}

} // namespace clepsydra
