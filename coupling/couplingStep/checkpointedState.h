#pragma once

#include "couplingStep/rows.h"
#include "engine/particles.h"

namespace clepsydra
{

/// The part of the coupling's state of each particle that checkpoints hold, writable. It is at the end of
/// ParticlesView::memory, after the memory of the forces.
namespace checkpointedState
{

/// Impulse P of SemiImplicitSource [N s].
constexpr Rows<3> semiImplicitImpulse{0};
/// CouplingState::drag and FluidAtParticle::selfMobility, from which the self-induced velocity is computed.
constexpr Rows<3> drag{semiImplicitImpulse.end()};
constexpr Rows<1> selfMobility{drag.end()};
constexpr int size = selfMobility.end();

inline Eigen::Map<Eigen::Matrix<double, size, Eigen::Dynamic>, 0, Eigen::OuterStride<>> of(
    const ParticlesView& particles)
{
    return {particles.memory ? particles.memory + particles.memorySize - size : nullptr, size, particles.size(),
        Eigen::OuterStride<>(particles.memorySize)};
}

} // namespace checkpointedState

} // namespace clepsydra
