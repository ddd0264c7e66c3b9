#pragma once

#include "forces/particleForces.h"
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

/// The forces that a couplingProperties of this text selects, of model A unless it says so, acting on particles of the fake
/// engine.
class ForcesOnParticles
{
public:
    explicit ForcesOnParticles(const std::string& couplingProperties, const FluidProperties& fluid = water())
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

    const ParticleForces& forces() const
    {
        return forces_;
    }

    /// See ParticleForces::takePressureImpulse().
    Vector3d takePressureImpulse()
    {
        return forces_.takePressureImpulse();
    }

    FluidAtParticle& fluidAt(Eigen::Index particle)
    {
        return engine_.particles().state[particle].fluid;
    }

    const ReceivedImpulse& received(Eigen::Index particle)
    {
        return engine_.particles().state[particle].received;
    }

    /// Acceleration of a particle over one step from now [m/s2].
    Vector3d accelerationOf(Eigen::Index particle)
    {
        const Vector3d before = engine_.particles().velocity.col(particle);
        engine_.advance(1);
        return (engine_.particles().velocity.col(particle) - before) / engine_.timeStep();
    }

private:
    Foam::dictionary dict_;
    PhaseTimers timers_;
    ParticleForces forces_;
    FakeEngine engine_;
};

} // namespace clepsydra::tests
