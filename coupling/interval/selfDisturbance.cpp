#include "interval/selfDisturbance.h"

#include "closures/gaussianDisturbance.h"

#include "mathematicalConstants.H"

#include <cmath>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Diffusion on a lattice of cells from one cell, at that cell: exp(-x) I_0(x)/h with x = b2/(2 h2), which is the peak
/// 1/(sqrt(pi) b) of the Gaussian where cells are small [1/m].
double latticePeak(double bandwidthSqr, double cellSize)
{
    const double x = bandwidthSqr / (2 * sqr(cellSize));
    return x > 100 ? 1 / std::sqrt(constant::mathematical::pi * bandwidthSqr)
                   : std::exp(-x) * std::cyl_bessel_i(0, x) / cellSize;
}

/// A force in one cell acts on that cell like a Gaussian of this b2/h2: 1/(2 pi^1.5 b) of the Gaussian equals the
/// simple cubic lattice's Green's function at its origin, 0.2527/h (Watson's integral).
constexpr double latticeBandwidthSqr = 0.126;

const ModelLines selfDisturbances(
    "selfDisturbance", {{"off", "a bead feels what it stirs up itself"},
                           {"Oseen", "what a lone bead stirs up at its own place is taken out of what it feels"}});

bool readSelfDisturbance(const CouplingSettings& settings)
{
    const dictionary& dict = settings.dict();
    const word entry = "selfDisturbance";
    if (!dict.found(entry) || selectedModel(dict, entry, selfDisturbances.names()) == "off")
    {
        return false;
    }
    if (!settings.implicitCoupling())
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is Oseen; allowed: with momCoupleModels "
                                     << "(implicitCouple), whose coefficient says how dense the neighbours are"
                                     << exit(FatalIOError);
    }
    if (dict.get<word>("smoothingModel") == "off")
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is Oseen, and smoothingModel is off; allowed: with "
                                     << "smoothing over more than a bead's diameter" << exit(FatalIOError);
    }
    return true;
}

} // namespace

SelfDisturbance::SelfDisturbance(
    const CouplingSettings& settings, const FluidProperties& fluid, const SmoothingModel& smoothing)
    : dict_(settings.dict()),
      fluid_(fluid),
      removed_(readSelfDisturbance(settings)),
      smoothingLength_(smoothing.bandwidth())
{}

double SelfDisturbance::mobility(const CouplingState& state, const Vector3d& position, double radius,
    const Vector3d& beadVelocity, double resistance, double cellSize) const
{
    // The force is spread by the bead's sphere and the smoothing, the velocity is sampled through the sphere. Variances
    // add up: b2/2 of the Gaussian, d2/20 of a sphere along each axis.
    if (smoothingLength_ <= 2 * radius)
    {
        FatalIOErrorInFunction(dict_) << "Entry 'selfDisturbance' is Oseen, and smoothingLength is " << smoothingLength_
                                      << " m; allowed: above the "
                                      << "diameter of every bead, and there is one of " << 2 * radius << " m"
                                      << exit(FatalIOError);
    }
    const double bandwidthSqr = sqr(smoothingLength_) + sqr(2 * radius) / 5;
    // Closures of beds speak of means over the bed, the bead's own disturbance included. So it is taken away only as far
    // as the solid at the bead is its own: all of it from a lone bead, next to nothing in a bed.
    const double ownSolid = sphereVolume(radius) * pow3(latticePeak(bandwidthSqr, cellSize));
    const double lone = std::min(1.0, ownSolid / std::max(1 - state.fluid.voidFraction, VSMALL));
    const double slip = (state.fluid.velocityInCells + state.fluid.selfMobility * state.drag - beadVelocity).norm();
    const double bandwidth = std::sqrt(bandwidthSqr + latticeBandwidthSqr * sqr(cellSize));
    return lone
           * closures::velocityPerForce(
               {bandwidth, fluid_.density, fluid_.viscosityAt(position), slip, (1 - lone) * resistance});
}

} // namespace clepsydra
