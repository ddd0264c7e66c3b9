#pragma once

#include "couplingStep/couplingSettings.h"
#include "couplingStep/demResult.h"
#include "rankTotals.h"

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
    /// VoidFractionRate. Local; errors and warnings come when the totals are reduced.
    void addTo(const ParticlesView& particles, const DemResult& result, RankTotals& totals);

private:
    /// A particle whose drag the DEM step does not resolve.
    struct Unresolved
    {
        int id;
        double radius;
        double relaxationTime;
    };

    [[noreturn]] void reportDemStep(const Unresolved& particle) const;
    /// \param fastest  rate at which drag stops the fluid, the largest of all particles [1/s]
    void checkExplicitCoupling(double fastest, double couplingTimeStep);
    /// \param most  relaxation times in the coupling step, of the particle in a dense bed that has the most
    void checkFilter(double most, double couplingTimeStep);

    const CouplingSettings& settings_;
    const double fluidDensity_;
    const double demTimeStep_;
    bool warnedOfExplicitCoupling_ = false;
    bool warnedOfFilter_ = false;
};

} // namespace clepsydra
