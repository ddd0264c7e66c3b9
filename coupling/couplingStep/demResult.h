#pragma once

#include "conservation/conservationCheck.h"
#include "couplingState.h"
#include "forces/particleForces.h"
#include "vectors.h"

#include <utility>
#include <vector>

namespace clepsydra
{

/// What the DEM steps between two exchanges with the fluid have given, moved out of the particles' states. Particles are
/// those of this rank, in the order of the engine's view.
struct DemResult
{
    /// Length of the DEM steps together [s].
    double timeStep;
    std::vector<ReceivedImpulse> received;
    /// Of each particle over the DEM steps [m/s].
    Eigen::Matrix3Xd changeOfVelocity;
    /// Of the fluid's torque on each particle [N m s]; without columns where no model has a torque.
    Eigen::Matrix3Xd angularImpulses;
    /// Impulse that the pressure gradient has given to this rank's particles [N s]; model A only.
    Vector3d pressureImpulse;

    /// What all particles of this rank have received.
    ExchangedMomentum receivedMomentum() const
    {
        Vector3d sum = Vector3d::Zero();
        double sumOfMagnitudes = 0;
        for (const ReceivedImpulse& ofParticle : received)
        {
            sum += ofParticle.impulse;
            sumOfMagnitudes += ofParticle.impulse.norm();
        }
        return {toFoam(sum), sumOfMagnitudes};
    }
};

/// Takes the result out of the particles' states and of the forces, which begin the next DEM steps with nothing received.
/// Local.
inline DemResult takeDemResult(const ParticlesView& particles, ParticleForces& forces, double timeStep)
{
    DemResult result{timeStep, {}, Eigen::Matrix3Xd(3, particles.size()),
        Eigen::Matrix3Xd(3, forces.haveTorque() ? particles.size() : 0), forces.takePressureImpulse()};
    result.received.reserve(static_cast<std::size_t>(particles.size()));
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        CouplingState& state = particles.state[particle];
        result.received.push_back(std::exchange(state.received, ReceivedImpulse()));
        result.changeOfVelocity.col(particle) = particles.velocity.col(particle) - state.velocityBefore;
        state.velocityBefore = particles.velocity.col(particle);
    }
    for (Eigen::Index particle = 0; particle < result.angularImpulses.cols(); ++particle)
    {
        result.angularImpulses.col(particle) =
            std::exchange(particles.state[particle].angularImpulse, Vector3d::Zero());
    }
    return result;
}

} // namespace clepsydra
