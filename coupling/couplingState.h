#pragma once

#include "engine/particles.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

/// \file
/// What the coupling keeps of each particle, and what of the particle is in the fluid. SI units throughout.

namespace clepsydra
{

/// The fluid at the place of one particle, frozen while the engine advances one coupling step.
struct FluidAtParticle
{
    double voidFraction = 1;
    /// Of the particle's volume, what is in the fluid: the rest is beyond an open boundary, or has not come in yet. All forces
    /// between fluid and particle are in proportion to it.
    double submergedFraction = 1;
    /// Natural logarithm of the void fraction, so that a drag law needs exp() instead of pow() at every DEM step.
    double logVoidFraction = 0;
    /// Interstitial velocity, as the forces see it [m/s].
    Vector3d velocity = Vector3d::Zero();
    /// Gradient of the pressure without its hydrostatic part [Pa/m].
    Vector3d pressureGradient = Vector3d::Zero();
    /// Divergence of the viscous stress [Pa/m]; zero unless a force asks for it.
    Vector3d viscousStressDivergence = Vector3d::Zero();
    /// What a force on the fluid at the particle's place adds to velocityInCells there [m/(N s)]; 0: not to be taken away.
    double selfMobility = 0;

    /// As `velocity`, but as the cells have it, with what the particle itself stirs up.
    Vector3d velocityInCells = Vector3d::Zero();
    /// DU/Dt = dU/dt + U.grad U, U interstitial [m/s2]; zero unless a force asks for it.
    Vector3d acceleration = Vector3d::Zero();
    /// curl U [1/s]; zero unless a force asks for it.
    Vector3d vorticity = Vector3d::Zero();
};

/// What the fluid must receive from one particle, summed over the DEM steps of one interval.
struct ReceivedImpulse
{
    /// Impulse of the forces whose reaction is a source of the fluid (drag ...), as received by the particle [N s].
    Vector3d impulse = Vector3d::Zero();
    /// Time integral of the implicit coefficient Sp of the forces in `impulse` [kg].
    double implicitCoefficientTime = 0;
    /// Time integral of the added mass [kg s].
    double addedMassTime = 0;
};

/// The part of a particle on the fluid's side of the open boundaries.
struct PartWithin
{
    /// Of the particle's volume.
    double share = 1;
    /// From the particle's centre to that of the part [m].
    Vector3d shift = Vector3d::Zero();
    /// Number of the open boundary that the rest is beyond; -1: none.
    double outlet = -1;
};

/// The part of a particle's state that belongs to the coupling; see the engine's ParticlesView.
///
/// In the order of how often it is used: the states of all particles do not fit into the near caches, and the time of the
/// forces is that of fetching, at every DEM step, everything down to selfMobility.
struct CouplingState
{
    ReceivedImpulse received;
    FluidAtParticle fluid;
    /// Of the last DEM step [N]. Kept only where selfMobility is not zero, and by FluidCoupling over checkpoints.
    Vector3d drag = Vector3d::Zero();
    /// The particle's own, when the interval began [m/s].
    Vector3d velocityBefore = Vector3d::Zero();
    PartWithin part;

    /// Of a particle that has come in since the particles were put on the mesh: it feels no fluid yet.
    static CouplingState ofNewParticle()
    {
        CouplingState state;
        state.fluid.submergedFraction = 0;
        return state;
    }
};

static_assert(std::is_standard_layout_v<CouplingState> && sizeof(CouplingState) % sizeof(double) == 0,
    "an engine stores CouplingState as plain doubles beside the particle");

/// As an engine keeps it: DemEngine::keepState().
inline std::vector<double> numbersOf(const CouplingState& state)
{
    const auto* const first = reinterpret_cast<const double*>(&state);
    return {first, first + sizeof(CouplingState) / sizeof(double)};
}

/// What of a particle's volume is in the fluid [m3].
inline double volumeInFluid(const ParticlesView& particles, Eigen::Index particle)
{
    return particles.state[particle].fluid.submergedFraction * sphereVolume(particles.radius[particle]);
}

/// The sphere that stands for a particle in the fluid: of the volume and with the centre of the part that is there. Not
/// smaller than a hundredth of the particle, for a particle that is leaving hands over its last impulse.
struct SphereInFluid
{
    Vector3d centre;
    double radius;
};

inline SphereInFluid sphereInFluid(const ParticlesView& particles, Eigen::Index particle)
{
    constexpr double smallest = 1e-6;
    const CouplingState& state = particles.state[particle];
    const double submergedFraction = state.fluid.submergedFraction;
    return {particles.position.col(particle) + state.part.shift,
        submergedFraction < 1 ? particles.radius[particle] * std::cbrt(std::max(submergedFraction, smallest))
                              : particles.radius[particle]};
}

} // namespace clepsydra
