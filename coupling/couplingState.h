#pragma once

#include "engine/beads.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

/// \file
/// What the coupling keeps of each bead, and what of the bead is in the fluid. SI units throughout.

namespace clepsydra
{

/// The fluid at the place of one bead, frozen while the engine advances one coupling interval.
struct FluidAtBead
{
    double voidFraction = 1;
    /// Of the bead's volume, what is in the fluid: the rest is beyond an open boundary, or has not come in yet. All forces
    /// between fluid and bead are in proportion to it.
    double presence = 1;
    /// Natural logarithm of the void fraction, so that a drag law needs exp() instead of pow() at every DEM step.
    double logVoidFraction = 0;
    /// Interstitial velocity, as the forces see it [m/s].
    Vector3d velocity = Vector3d::Zero();
    /// Gradient of the pressure without its hydrostatic part [Pa/m].
    Vector3d pressureGradient = Vector3d::Zero();
    /// Divergence of the viscous stress [Pa/m]; zero unless a force asks for it.
    Vector3d viscousStressDivergence = Vector3d::Zero();
    /// What a force on the fluid at the bead's place adds to velocityInCells there [m/(N s)]; 0: not to be taken away.
    double selfMobility = 0;

    /// As `velocity`, but as the cells have it, with what the bead itself stirs up.
    Vector3d velocityInCells = Vector3d::Zero();
    /// DU/Dt = dU/dt + U.grad U, U interstitial [m/s2]; zero unless a force asks for it.
    Vector3d acceleration = Vector3d::Zero();
    /// curl U [1/s]; zero unless a force asks for it.
    Vector3d vorticity = Vector3d::Zero();
};

/// What the fluid must receive from one bead, summed over the DEM steps of one interval.
struct GivenToFluid
{
    /// Impulse of the forces whose reaction is a source of the fluid (drag ...), as received by the bead [N s].
    Vector3d impulse = Vector3d::Zero();
    /// Time integral of the implicit coefficient Sp of the forces in `impulse` [kg].
    double implicitCoefficientTime = 0;
    /// Time integral of the added mass [kg s].
    double addedMassTime = 0;
};

/// The part of a bead on the fluid's side of the open boundaries.
struct PartWithin
{
    /// Of the bead's volume.
    double share = 1;
    /// From the bead's centre to that of the part [m].
    Vector3d shift = Vector3d::Zero();
    /// Number of the open boundary that the rest is beyond; -1: none.
    double outlet = -1;
};

/// The part of a bead's state that belongs to the coupling; see the engine's BeadsView.
///
/// In the order of how often it is used: the states of all beads do not fit into the near caches, and the time of the
/// forces is that of fetching, at every DEM step, everything down to selfMobility.
struct CouplingState
{
    GivenToFluid given;
    FluidAtBead fluid;
    /// Of the last DEM step [N]. Kept only where selfMobility is not zero, and by FluidCoupling over checkpoints.
    Vector3d drag = Vector3d::Zero();
    /// The bead's own, when the interval began [m/s].
    Vector3d velocityBefore = Vector3d::Zero();
    PartWithin part;

    /// Of a bead that has come in since the beads were put on the mesh: it feels no fluid yet.
    static CouplingState ofNewBead()
    {
        CouplingState state;
        state.fluid.presence = 0;
        return state;
    }
};

static_assert(std::is_standard_layout_v<CouplingState> && sizeof(CouplingState) % sizeof(double) == 0,
    "an engine stores CouplingState as plain doubles beside the bead");

/// As an engine keeps it: DemEngine::keepState().
inline std::vector<double> numbersOf(const CouplingState& state)
{
    const auto* const first = reinterpret_cast<const double*>(&state);
    return {first, first + sizeof(CouplingState) / sizeof(double)};
}

/// What of a bead's volume is in the fluid [m3].
inline double volumeInFluid(const BeadsView& beads, Eigen::Index bead)
{
    return beads.state[bead].fluid.presence * sphereVolume(beads.radius[bead]);
}

/// The sphere that stands for a bead in the fluid: of the volume and with the centre of the part that is there. Not
/// smaller than a hundredth of the bead, for a bead that is leaving hands over its last impulse.
struct SphereInFluid
{
    Vector3d centre;
    double radius;
};

inline SphereInFluid sphereInFluid(const BeadsView& beads, Eigen::Index bead)
{
    constexpr double smallest = 1e-6;
    const CouplingState& state = beads.state[bead];
    const double presence = state.fluid.presence;
    return {beads.position.col(bead) + state.part.shift,
        presence < 1 ? beads.radius[bead] * std::cbrt(std::max(presence, smallest)) : beads.radius[bead]};
}

} // namespace clepsydra
