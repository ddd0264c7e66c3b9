#pragma once

#include "distribution/distribution.h"
#include "forces/particleForces.h"
#include "couplingStep/couplingSettings.h"
#include "phaseTimers.h"

namespace clepsydra
{

/// The models that couplingProperties selects, with their coefficients. They are created before the engine starts and
/// before any file is written, so that a wrong entry leaves the case unchanged.
struct FluidModels
{
    FluidModels(
        const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid, PhaseTimers& timers)
        : forces(settings.dict(), settings.modelType(), fluid, timers),
          distribution(settings.dict(), mesh)
    {
        forces.requireAllTerms(settings.dict());
    }

    ParticleForces forces;
    Distribution distribution;
};

} // namespace clepsydra
