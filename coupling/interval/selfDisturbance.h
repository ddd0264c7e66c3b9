#pragma once

#include "couplingState.h"
#include "distribution/smoothingModel.h"
#include "forces/forceModel.h"
#include "interval/couplingSettings.h"

namespace clepsydra
{

/// What a bead itself stirs up in the cells that it then samples: `selfDisturbance Oseen;`.
class SelfDisturbance
{
public:
    /// FatalIOError where the other choices of couplingProperties do not go with it.
    SelfDisturbance(const CouplingSettings& settings, const FluidProperties& fluid, const SmoothingModel& smoothing);

    bool isRemoved() const
    {
        return removed_;
    }

    /// See FluidAtBead::selfMobility.
    /// \param resistance  of all beads, this one included [kg/(m3 s)]
    /// \param cellSize  [m]
    double mobility(const CouplingState& state, const Vector3d& position, double radius, const Vector3d& beadVelocity,
        double resistance, double cellSize) const;

private:
    const Foam::dictionary& dict_;
    const FluidProperties fluid_;
    const bool removed_;
    const double smoothingLength_;
};

} // namespace clepsydra
