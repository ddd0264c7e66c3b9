#pragma once

#include "couplingState.h"
#include "distribution/smoothingModel.h"
#include "forces/forceModel.h"
#include "couplingStep/couplingSettings.h"

namespace clepsydra
{

/// Subtracts the particle's self-induced velocity from the sampled fluid velocity, with the entry
/// `selfInducedVelocityCorrection Oseen;`. The self-induced velocity is the one that the particle's own force gives to
/// the fluid in the cells from which it is sampled; see closures/selfInducedVelocity.h.
class SelfInducedVelocityCorrection
{
public:
    /// FatalIOError where the correction is incompatible with other entries of couplingProperties.
    SelfInducedVelocityCorrection(
        const CouplingSettings& settings, const FluidProperties& fluid, const SmoothingModel& smoothing);

    bool isActive() const
    {
        return active_;
    }

    /// Velocity that a unit force of the particle gives to the fluid at its own position [m/(N s)]; see
    /// FluidAtParticle::selfMobility.
    /// \param resistance  drag coefficient per volume of all particles, this one included [kg/(m3 s)]
    /// \param cellSize  width of the cells around the particle [m]
    double selfMobility(const CouplingState& state, const Vector3d& position, double radius,
        const Vector3d& particleVelocity, double resistance, double cellSize) const;

private:
    const Foam::dictionary& dict_;
    const FluidProperties fluid_;
    const bool active_;
    const double smoothingBandwidth_;
};

} // namespace clepsydra
