#pragma once

#include "distribution/distribution.h"
#include "forces/particleForces.h"
#include "couplingStep/couplingSettings.h"
#include "couplingStep/meanPressureGradient.h"
#include "couplingStep/viscousStress.h"
#include "phaseTimers.h"

namespace clepsydra
{

/// The models that couplingProperties selects, with their coefficients, and the stress of the fluid. They are created
/// before the engine starts and before any file is written, so that a wrong entry leaves the case unchanged.
struct FluidModels
{
    FluidModels(
        const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid, PhaseTimers& timers)
        : forces(settings.dict(), settings.modelType(), fluid, timers),
          distribution(settings.dict(), mesh),
          meanPressureGradient(settings.dict(), mesh, distribution.periodicBox(), fluid, settings.modelType(),
              forces.needs().pressureGradient),
          viscousStress(mesh, fluid)
    {
        forces.requireAllTerms(settings.dict());
    }

    ParticleForces forces;
    Distribution distribution;
    MeanPressureGradient meanPressureGradient;
    /// Of the fluid's momentum equation and of the viscous force on particles.
    ViscousStress viscousStress;
};

} // namespace clepsydra
