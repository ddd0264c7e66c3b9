#pragma once

#include "couplingStep/couplingSettings.h"
#include "couplingStep/energy.h"
#include "forces/particleForces.h"

#include <optional>
#include <string>
#include <vector>

namespace clepsydra
{

/// The equations that a run solves, term by term, for the report at the start of the log; one line each.
/// \param forces  null for DEM only
/// \param energy  empty where the case has no temperatures
std::vector<std::string> equations(const CouplingSettings& settings, const FluidProperties& fluid,
    const ParticleForces* forces, const std::optional<Energy>& energy = std::nullopt);

} // namespace clepsydra
