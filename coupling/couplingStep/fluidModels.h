#pragma once

#include "distribution/distribution.h"
#include "forces/particleForces.h"
#include "couplingStep/couplingSettings.h"
#include "phaseTimers.h"

namespace clepsydra
{

/// The models that couplingProperties selects, with their coefficients. Made before the engine starts and anything is
/// written, so that a mistake in a dictionary leaves the case as it was.
struct FluidModels
{
    FluidModels(
        const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid, PhaseTimers& timers)
        : forces(settings.dict(), settings.modelType(), fluid, timers),
          distribution(settings.dict(), mesh)
    {}

    ParticleForces forces;
    Distribution distribution;
};

} // namespace clepsydra
