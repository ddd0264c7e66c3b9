#pragma once

#include "couplingStep/couplingSettings.h"
#include "couplingStep/demResult.h"
#include "rankTotals.h"

namespace clepsydra
{

/// Compares the coupling step with the times in which drag changes the velocities of particles and fluid, where an
/// explicit scheme or the low-pass filter limits it. Semi-implicit coupling (`implicitCouple`) limits no coupling step.
/// ParticleForces compares the DEM step.
class DragTimeChecks
{
public:
    DragTimeChecks(const CouplingSettings& settings, double fluidDensity)
        : settings_(settings),
          fluidDensity_(fluidDensity)
    {}

    /// A warning, once, where the coupling step of `explicitCouple` is longer than twice the time in which the
    /// particles' drag stops the fluid. A warning, once, where the coupling step is so many relaxation times of
    /// particles in a dense bed that the low-pass filter lets errors grow, see VoidFractionRate. A warning, once, where the
    /// reaction to an added mass grows from step to step of `explicitCouple`, see implicitAddedMass(). Local; warnings come
    /// when the totals are reduced.
    void addTo(const ParticlesView& particles, const DemResult& result, RankTotals& totals);

private:
    /// \param fastest  rate at which drag stops the fluid, the largest of all particles [1/s]
    void checkExplicitCoupling(double fastest, double couplingTimeStep);
    /// \param most  relaxation times in the coupling step, of the particle in a dense bed that has the most
    void checkFilter(double most, double couplingTimeStep);

    /// \param largest  change of the fluid's velocity in a coupling step over that in the step before, which causes it
    void checkAddedMass(double largest);

    const CouplingSettings& settings_;
    const double fluidDensity_;
    bool warnedOfExplicitCoupling_ = false;
    bool warnedOfFilter_ = false;
    bool warnedOfAddedMass_ = false;
};

} // namespace clepsydra
