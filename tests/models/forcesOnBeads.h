#pragma once

#include "forces/beadForces.h"
#include "support/fakeEngine.h"

#include "IStringStream.H"

#include <string>

namespace clepsydra::tests
{

/// Water at rest, 1e-3 Pa s.
inline FluidProperties water()
{
    return {1000, 1e-3, {0, 0, -9.81}};
}

/// The forces that a couplingProperties of this text selects, of model A unless it says so, acting on beads of the fake
/// engine.
class ForcesOnBeads
{
public:
    explicit ForcesOnBeads(const std::string& couplingProperties, const FluidProperties& fluid = water())
        : dict_(Foam::IStringStream(couplingProperties)()),
          forces_(dict_, dict_.found("modelType") ? readModelType(dict_) : ModelType::A, fluid, timers_),
          engine_(1e-5, fluid.gravity)
    {
        engine_.initialise(&forces_);
    }

    FakeEngine& engine()
    {
        return engine_;
    }

    const BeadForces& forces() const
    {
        return forces_;
    }

    FluidAtBead& fluidAt(Eigen::Index bead)
    {
        return engine_.beads().state[bead].fluid;
    }

    const GivenToFluid& given(Eigen::Index bead)
    {
        return engine_.beads().state[bead].given;
    }

    /// Acceleration of a bead over one step from now [m/s2].
    Vector3d accelerationOf(Eigen::Index bead)
    {
        const Vector3d before = engine_.beads().velocity.col(bead);
        engine_.advance(1);
        return (engine_.beads().velocity.col(bead) - before) / engine_.timeStep();
    }

private:
    Foam::dictionary dict_;
    PhaseTimers timers_;
    BeadForces forces_;
    FakeEngine engine_;
};

} // namespace clepsydra::tests
