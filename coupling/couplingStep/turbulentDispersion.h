#pragma once

#include "couplingStep/couplingSettings.h"
#include "forces/fluidProperties.h"

#include <cstdint>

namespace clepsydra
{

/// Disperses particles by the eddies of a turbulence model, with the entry `turbulentDispersion discreteRandomWalk;`: adds
/// the velocity of the eddies in which a particle is during a coupling step to the fluid velocity that its forces see; see
/// closures/discreteRandomWalk.h. The fluid receives the reaction like that of all drag.
///
/// A particle keeps its eddy from coupling step to coupling step. The eddy's random numbers are a function of the seed, the
/// particle's id and the number of the eddy, so that resumed and parallel runs have the same eddies.
class TurbulentDispersion
{
public:
    /// Number of values that it stores of each particle in ParticlesView::memory, between those of the forces and
    /// checkpointedState; zero where it is not selected. FatalIOError for an unknown name.
    static int memory(const Foam::dictionary& couplingProperties);

    /// FatalIOError where the dispersion is incompatible with other entries of the case.
    TurbulentDispersion(const CouplingSettings& settings, const FluidProperties& fluid);

    bool isActive() const
    {
        return active_;
    }

    /// Call between two coupling steps: the next call of velocity() goes on with the walk.
    void endStep(const ParticlesView& particles) const;

    /// Mean velocity of the eddies through which a particle passes in the next coupling step, relative to the mean velocity
    /// of the fluid [m/s]. Called again before endStep(), also in a resumed run, it returns the same.
    /// \pre the mean velocity of the fluid is stored in the particle's state
    /// \param k  [m2/s2]  \param dissipation  [m2/s3]  \param timeStep  length of the next coupling step [s]
    Vector3d velocity(
        const ParticlesView& particles, Eigen::Index particle, double k, double dissipation, double timeStep) const;

private:
    const FluidProperties fluid_;
    const double coarseGraining_;
    const bool active_;
    std::uint64_t seed_ = 0;
};

} // namespace clepsydra
