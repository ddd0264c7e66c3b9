#pragma once

#include "couplingState.h"
#include "distribution/smoothingModel.h"
#include "forces/forceModel.h"
#include "couplingStep/couplingSettings.h"

namespace clepsydra
{

/// What a particle itself stirs up in the cells that it then samples: `selfInducedVelocityCorrection Oseen;`.
class SelfInducedVelocityCorrection
{
public:
    /// FatalIOError where the other choices of couplingProperties do not go with it.
    SelfInducedVelocityCorrection(
        const CouplingSettings& settings, const FluidProperties& fluid, const SmoothingModel& smoothing);

    bool isActive() const
    {
        return active_;
    }

    /// See FluidAtParticle::selfMobility.
    /// \param resistance  of all particles, this one included [kg/(m3 s)]
    /// \param cellSize  [m]
    double selfMobility(const CouplingState& state, const Vector3d& position, double radius,
        const Vector3d& particleVelocity, double resistance, double cellSize) const;

private:
    const Foam::dictionary& dict_;
    const FluidProperties fluid_;
    const bool active_;
    const double smoothingBandwidth_;
};

} // namespace clepsydra
