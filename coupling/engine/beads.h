#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

/// \file
/// The beads of one rank, as the coupling sees them. SI units throughout.

namespace clepsydra
{

using Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

/// Whether the cube about a sphere meets a box. Whoever asks what a bead can act on asks this: a share may be above zero
/// in a cell that the cube meets and the sphere does not (CellSlabs).
inline bool cubeMeets(const Box& box, const Vector3d& centre, double radius)
{
    return ((centre - box.min()).array() >= -radius).all() && ((box.max() - centre).array() >= -radius).all();
}

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
    /// Divergence of the viscous stress [Pa/m].
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

/// The part of a bead's state that belongs to the coupling. It travels with the bead from rank to rank,
/// because a bead may change rank at any DEM step, also in the middle of an interval.
///
/// In the order of how often it is used: the states of all beads do not fit into the near caches, and the time of the
/// forces is that of fetching, at every DEM step, everything down to selfMobility.
struct CouplingState
{
    GivenToFluid given;
    FluidAtBead fluid;
    /// Of the last DEM step: the force on the bead whose reaction is a source of the fluid [N]. Kept only where
    /// selfMobility is not zero, and by FluidCoupling over checkpoints.
    Vector3d handedOver = Vector3d::Zero();
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

constexpr std::size_t couplingStateSize = sizeof(CouplingState) / sizeof(double);
static_assert(std::is_standard_layout_v<CouplingState> && sizeof(CouplingState) % sizeof(double) == 0,
    "an engine stores CouplingState as plain doubles beside the bead");

/// A view of a contiguous array, of fixed size while it lives (std::span of C++20, as far as needed).
template<class T>
using View = Eigen::Map<Eigen::Array<std::remove_const_t<T>, Eigen::Dynamic, 1>>;
template<class T>
using ConstView = Eigen::Map<const Eigen::Array<T, Eigen::Dynamic, 1>>;
using ConstVectors = Eigen::Map<const Eigen::Matrix3Xd>;
using Vectors = Eigen::Map<Eigen::Matrix3Xd>;

/// Pairs of beads near each other, for forces between beads. A pair of own beads is listed once; a pair of an own bead
/// and a copy of another rank's bead (or of a bead across a periodic boundary) is listed at either, its own bead first.
struct BeadPairs
{
    /// Own beads first, in BeadsView's order, then the copies.
    ConstVectors position{nullptr, 3, 0};
    ConstVectors velocity{nullptr, 3, 0};
    ConstView<double> radius{nullptr, 0};
    /// 2 x number of pairs: columns of the above. Empty unless DemEngine::seePairs() was called.
    Eigen::Map<const Eigen::Matrix2Xi> list{nullptr, 2, 0};
};

/// The beads that this rank owns; column i of every array is the same bead.
/// Valid until the engine advances: beads move between ranks then.
struct BeadsView
{
    ConstView<int> id;
    ConstVectors position;
    ConstVectors velocity;
    ConstVectors angularVelocity;
    ConstView<double> radius;
    ConstView<double> mass;
    /// `size()` entries, writable.
    CouplingState* state = nullptr;
    /// Sum of the forces of all else: contacts, walls, gravity [N]. Meaningful while FluidForces::evaluate() runs.
    ConstVectors otherForce{nullptr, 3, 0};
    /// For FluidForces::evaluate() only, as is otherForce.
    BeadPairs pairs{};
    /// What forces and coupling keep from step to step: `memorySize` numbers per bead, writable. None unless
    /// DemEngine::keepMemory() was called.
    double* memory = nullptr;
    Eigen::Index memorySize = 0;
    /// False where forces are evaluated without a step: DemEngine::feelFluid().
    bool memoryAges = true;
    /// For FluidForces::evaluate() only: true where no force moves the bead, for the engine holds it fast.
    ConstView<bool> held{nullptr, 0};
    /// How far a bead that has come in during the run has been introduced to the fluid, from 0 to 1; 1 of all others.
    /// Writable, part of checkpoints.
    double* introduced = nullptr;

    Eigen::Index size() const
    {
        return id.size();
    }

    /// Beads `first` to `first + count`, with all the pairs.
    BeadsView segment(Eigen::Index first, Eigen::Index count) const
    {
        const auto values = [&](const auto& all) { return std::decay_t<decltype(all)>(all.data() + first, count); };
        const auto vectors = [&](const ConstVectors& all) { return ConstVectors(all.data() + 3 * first, 3, count); };
        return {values(id), vectors(position), vectors(velocity), vectors(angularVelocity), values(radius),
            values(mass), state + first, vectors(otherForce), pairs, memory + first * memorySize, memorySize,
            memoryAges, values(held)};
    }
};

/// Volume of a sphere [m3].
inline double sphereVolume(double radius)
{
    return 4.0 / 3.0 * static_cast<double>(EIGEN_PI) * radius * radius * radius;
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
