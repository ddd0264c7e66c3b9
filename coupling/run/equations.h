#pragma once

#include "couplingStep/couplingSettings.h"
#include "forces/particleForces.h"

#include <string>
#include <vector>

namespace clepsydra
{

/// The equations that a run solves, term by term, for the report at the start of the log; one line each.
/// \param forces  null for DEM only
std::vector<std::string> equations(
    const CouplingSettings& settings, const FluidProperties& fluid, const ParticleForces* forces);

} // namespace clepsydra
