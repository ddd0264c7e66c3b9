#pragma once

#include "couplingStep/particleMapping.h"

#include <optional>

namespace clepsydra
{

/// Part of the particles in dense regions that are within a smoothing bandwidth of clear fluid, where the smoothed void
/// fraction is one between those of the bed and of the fluid beyond it [-]; empty without a bed. Collective.
std::optional<double> partNearClearFluid(
    const Foam::volScalarField& voidFraction, const LocatedParticles& particles, double bandwidth);

} // namespace clepsydra
