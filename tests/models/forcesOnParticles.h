#pragma once

#include "forces/particleForces.h"
#include "run/equations.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"

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

/// The lines that a case prints, as one text.
inline std::string printed(const std::string& entries)
{
    TemporaryCase folder;
    folder.writeDictionary("constant/couplingProperties",
        "fluid incompressible; couplingTimeStep 0.01; voidFractionModel divided; smoothingModel off; "
        "momCoupleModels (implicitCouple); DEM { engine liggghts; script none; } "
            + entries);
    const CouplingSettings settings(folder.time());
    PhaseTimers timers;
    const ParticleForces forces(settings.dict(), settings.modelType(), water(), timers);
    std::string text;
    for (const std::string& line : equations(settings, water(), &forces))
    {
        text += line + '\n';
    }
    return text;
}

} // namespace clepsydra::tests
