#include "couplingStep/selfInducedVelocityCorrection.h"

#include "closures/selfInducedVelocity.h"

#include "mathematicalConstants.H"

#include <cmath>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Peak of a diffusion from one cell on a lattice of cells: exp(-x) I_0(x)/h with x = b2/(2 h2), per axis [1/m]. It
/// tends to the peak 1/(sqrt(pi) b) of the Gaussian for small cells.
double latticePeak(double bandwidthSqr, double cellSize)
{
    const double x = bandwidthSqr / (2 * sqr(cellSize));
    return x > 100 ? 1 / std::sqrt(constant::mathematical::pi * bandwidthSqr)
                   : std::exp(-x) * std::cyl_bessel_i(0, x) / cellSize;
}

/// A force in one cell acts on that cell like a Gaussian with this b2/h2: the Gaussian's 1/(2 pi^1.5 b) equals
/// 0.2527/h, the Green's function of the simple cubic lattice at its origin (Watson's integral).
constexpr double latticeBandwidthSqr = 0.126;

const ModelLines selfInducedVelocityCorrections(
    "selfInducedVelocityCorrection", {{"off", "forces use the sampled velocity as it is (the default)"},
                                         {"Oseen", "the self-induced velocity is subtracted from the sampled one"}});

bool readSelfInducedVelocityCorrection(const CouplingSettings& settings)
{
    const dictionary& dict = settings.dict();
    const word entry = "selfInducedVelocityCorrection";
    if (!dict.found(entry) || selectedModel(dict, entry, selfInducedVelocityCorrections.names()) == "off")
    {
        return false;
    }
    if (!settings.implicitCoupling())
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is Oseen, which needs the drag coefficients of "
                                     << "the neighbours; allowed: momCoupleModels (implicitCouple), which provides them"
                                     << exit(FatalIOError);
    }
    if (settings.coarseGraining() != 1)
    {
        // The velocity that n particles induce together may exceed their slip: then there is no velocity without it.
        FatalIOErrorInFunction(dict)
            << "Entry '" << entry << "' is Oseen, and 'coarseGraining' is " << settings.coarseGraining()
            << "; allowed: coarseGraining 1, because what a parcel induces at its own place is "
            << "that of all its particles" << exit(FatalIOError);
    }
    if (dict.get<word>("smoothingModel") == "off")
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is Oseen, but smoothingModel is off; allowed: with "
                                     << "smoothing over more than a particle's diameter" << exit(FatalIOError);
    }
    return true;
}

} // namespace

SelfInducedVelocityCorrection::SelfInducedVelocityCorrection(
    const CouplingSettings& settings, const FluidProperties& fluid, const SmoothingModel& smoothing)
    : dict_(settings.dict()),
      fluid_(fluid),
      active_(readSelfInducedVelocityCorrection(settings)),
      smoothingBandwidth_(smoothing.bandwidth())
{}

double SelfInducedVelocityCorrection::selfMobility(const CouplingState& state, const Vector3d& position, double radius,
    const Vector3d& particleVelocity, double resistance, double cellSize) const
{
    // The particle's sphere and the smoothing spread the force, and the sphere samples the velocity. Variances add up:
    // b2/2 of the Gaussian and d2/20 of a sphere along each axis.
    if (smoothingBandwidth_ <= 2 * radius)
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'selfInducedVelocityCorrection' is Oseen, but the bandwidth of the smoothing is "
            << smoothingBandwidth_ << " m; allowed: above the "
            << "diameter of every particle, and there is one of " << 2 * radius << " m" << exit(FatalIOError);
    }
    const double bandwidthSqr = sqr(smoothingBandwidth_) + sqr(2 * radius) / 5;
    // Closures of beds refer to means over the bed, the self-induced velocity included. It is therefore subtracted in
    // proportion to the particle's own part of the solid around it: fully for an isolated particle, hardly in a bed.
    const double ownSolid = sphereVolume(radius) * pow3(latticePeak(bandwidthSqr, cellSize));
    const double isolated = std::min(1.0, ownSolid / std::max(1 - state.fluid.voidFraction, VSMALL));
    const double slip = (state.fluid.velocityInCells + state.fluid.selfMobility * state.drag - particleVelocity).norm();
    const double bandwidth = std::sqrt(bandwidthSqr + latticeBandwidthSqr * sqr(cellSize));
    return isolated
           * closures::velocityPerForce(
               {bandwidth, fluid_.density, fluid_.viscosityAt(position), slip, (1 - isolated) * resistance});
}

} // namespace clepsydra
