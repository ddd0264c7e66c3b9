#pragma once

#include "couplingStep/couplingSettings.h"
#include "couplingStep/demResult.h"

namespace clepsydra
{

/// Compares the steps with the times in which drag changes the velocities of particles and fluid, where an explicit
/// scheme or the low-pass filter limits a step. Semi-implicit coupling (`implicitCouple`) limits no coupling step.
class DragTimeChecks
{
public:
    DragTimeChecks(const CouplingSettings& settings, double fluidDensity, double demTimeStep)
        : settings_(settings),
          fluidDensity_(fluidDensity),
          demTimeStep_(demTimeStep)
    {}

    /// FatalError where drag is integrated over a DEM step that is longer than twice the relaxation time of a particle
    /// that moves: its velocity then oscillates and grows. A warning, once, where the coupling step of `explicitCouple`
    /// is longer than twice the time in which the particles' drag stops the fluid. A warning, once, where the coupling
    /// step is so many relaxation times of particles in a dense bed that the low-pass filter lets errors grow, see
    /// VoidFractionRate. Collective.
    void check(const ParticlesView& particles, const DemResult& result);

private:
    void checkDemStep(const ParticlesView& particles, const DemResult& result) const;
    void checkExplicitCoupling(const ParticlesView& particles, const DemResult& result);
    void checkFilter(const ParticlesView& particles, const DemResult& result);

    const CouplingSettings& settings_;
    const double fluidDensity_;
    const double demTimeStep_;
    bool warnedOfExplicitCoupling_ = false;
    bool warnedOfFilter_ = false;
};

} // namespace clepsydra
