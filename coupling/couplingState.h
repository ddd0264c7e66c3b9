#pragma once

#include "engine/particles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

/// \file
/// The state that the coupling stores with each particle, and the part of a particle that is in the fluid. SI units
/// throughout.

namespace clepsydra
{

/// The fluid at the place of one particle, frozen while the engine advances one coupling step.
struct FluidAtParticle
{
    double voidFraction = 1;
    /// Fraction of the particle's volume that is in the fluid; the rest is beyond an outlet or has not been inserted
    /// yet. All forces between fluid and particle are proportional to it.
    double submergedFraction = 1;
    /// Natural logarithm of the void fraction. A drag law then needs exp() instead of pow() at every DEM step.
    double logVoidFraction = 0;
    /// Interstitial velocity that the forces use [m/s]; without the particle's self-induced velocity where that is
    /// removed.
    Vector3d velocity = Vector3d::Zero();
    /// Gradient of the pressure without its hydrostatic part [Pa/m].
    Vector3d pressureGradient = Vector3d::Zero();
    /// Divergence of the viscous stress [Pa/m]; zero unless a force needs it.
    Vector3d viscousStressDivergence = Vector3d::Zero();
    /// Velocity that a unit force on the fluid at the particle's position adds to velocityInCells there [m/(N s)]; 0
    /// where the self-induced velocity is not removed.
    double selfMobility = 0;

    /// Interstitial velocity as sampled from the cells [m/s], with the particle's self-induced velocity.
    Vector3d velocityInCells = Vector3d::Zero();
    /// DU/Dt = dU/dt + U.grad U with the interstitial velocity U [m/s2]; zero unless a force needs it.
    Vector3d acceleration = Vector3d::Zero();
    /// curl U [1/s]; zero unless a force needs it.
    Vector3d vorticity = Vector3d::Zero();
    /// Sauter mean diameter sum n d^3/sum n d^2 of the particles around this one, which is one of them [m]; 0 unless a
    /// force needs it.
    double sauterMeanDiameter = 0;
};

/// What one particle has received from the fluid, summed over the DEM steps of one coupling step.
struct ReceivedImpulse
{
    /// Impulse of the forces whose reaction is a source in the fluid's momentum equation, such as drag [N s].
    Vector3d impulse = Vector3d::Zero();
    /// Time integral of the implicit coefficient Sp of the forces in `impulse` [kg].
    double implicitCoefficientTime = 0;
    /// Time integral of the added mass [kg s].
    double addedMassTime = 0;
};

/// The part of a particle on the fluid's side of the outlets.
struct PartWithin
{
    /// Fraction of the particle's volume [-].
    double share = 1;
    /// Vector from the particle's centre to the centroid of this part [m].
    Vector3d shift = Vector3d::Zero();
    /// Index of the outlet that the rest of the particle has crossed; -1 where there is none.
    double outlet = -1;
};

/// The part of a particle's state that belongs to the coupling; see ParticlesView in engine/particles.h.
///
/// Members are ordered by frequency of use. The states of all particles do not fit into the processor's caches, so the
/// time of the force evaluation is that of fetching everything down to selfMobility at every DEM step.
struct CouplingState
{
    ReceivedImpulse received;
    FluidAtParticle fluid;
    /// Drag of the last DEM step [N]. Stored only where selfMobility is not zero, and by FluidSampling in checkpoints.
    Vector3d drag = Vector3d::Zero();
    /// Time integral over the coupling step of the fluid's torque on the particle [N m s]; zero without a torque model.
    Vector3d angularImpulse = Vector3d::Zero();
    /// Velocity of the particle at the start of the coupling step [m/s].
    Vector3d velocityBefore = Vector3d::Zero();
    PartWithin part;
    /// Last position at which the particle, or the part of it before an outlet, was in the mesh [m].
    Vector3d lastInMesh = Vector3d::Zero();
    /// 1 for a particle that the engine has made since InsertionAndRemoval last saw the particles; 0 for all others. The
    /// id is not sufficient: where the particle with the highest id is lost, the next new one receives the same id.
    double isNew = 0;

    /// State of a particle that has been inserted since the void fraction was last computed: no fluid force acts on it
    /// yet.
    static CouplingState ofNewParticle()
    {
        CouplingState state;
        state.fluid.submergedFraction = 0;
        state.isNew = 1;
        return state;
    }
};

static_assert(std::is_standard_layout_v<CouplingState> && sizeof(CouplingState) % sizeof(double) == 0,
    "an engine stores CouplingState as plain doubles beside the particle");

/// Index of the submerged fraction among the numbers of a state, for DemEngine::requestPairs().
constexpr std::size_t submergedFractionInState = offsetof(CouplingState, fluid.submergedFraction) / sizeof(double);

/// The state as plain numbers, for DemEngine::requestState().
inline std::vector<double> numbersOf(const CouplingState& state)
{
    const auto* const first = reinterpret_cast<const double*>(&state);
    return {first, first + sizeof(CouplingState) / sizeof(double)};
}

/// Whether a particle has been inserted since the last count, when the highest id was `highestBefore`.
inline bool isNewParticle(const ParticlesView& particles, Eigen::Index particle, long highestBefore)
{
    return particles.id[particle] > highestBefore || particles.state[particle].isNew != 0;
}

/// Whether a particle is in a part of the DEM box without mesh (entry `allowParticlesOutsideMesh`). A particle that has
/// left through an outlet has no share either, but an outlet.
inline bool isOutsideMesh(const CouplingState& state)
{
    return !(state.part.share > 0) && state.part.outlet < 0;
}

/// Volume of the particle that is in the fluid [m3].
inline double volumeInFluid(const ParticlesView& particles, Eigen::Index particle)
{
    return particles.state[particle].fluid.submergedFraction * sphereVolume(particles.radius[particle]);
}

/// Sphere with the volume and the centroid of the part of a particle that is in the fluid. Its volume is at least 1e-6
/// of the particle's, because a particle that is leaving still transfers its last impulse to the fluid. A particle outside
/// the mesh transfers it where it was last in the mesh, with its own radius, because its centre may have been behind a
/// wall there.
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
        submergedFraction < 1 && !isOutsideMesh(state)
            ? particles.radius[particle] * std::cbrt(std::max(submergedFraction, smallest))
            : particles.radius[particle]};
}

} // namespace clepsydra
