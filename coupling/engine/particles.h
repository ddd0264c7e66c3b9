#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <type_traits>

/// \file
/// The particles of one rank, as the coupling accesses them. SI units throughout.

namespace clepsydra
{

using Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

/// Whether the cube around a sphere intersects a box. Use it to find what a particle can act on, because the share of a
/// particle may be above zero in a cell that the cube intersects and the sphere does not (CellSlabs).
inline bool cubeMeets(const Box& box, const Vector3d& centre, double radius)
{
    return ((centre - box.min()).array() >= -radius).all() && ((box.max() - centre).array() >= -radius).all();
}

/// The coupling's part of a particle's state, defined in couplingState.h. For an engine it is an array of plain
/// numbers, which travels with the particle from rank to rank, because a particle may change rank at any DEM step.
struct CouplingState;

/// A view of a contiguous array, whose size is constant while the view exists (a subset of C++20's std::span).
template<class T>
using View = Eigen::Map<Eigen::Array<std::remove_const_t<T>, Eigen::Dynamic, 1>>;
template<class T>
using ConstView = Eigen::Map<const Eigen::Array<T, Eigen::Dynamic, 1>>;
using ConstVectors = Eigen::Map<const Eigen::Matrix3Xd>;
using Vectors = Eigen::Map<Eigen::Matrix3Xd>;

/// Pairs of particles near each other, for forces between particles. A pair of two own particles is listed once. A pair
/// of an own particle and a copy of another rank's particle (or of a particle across a periodic boundary) is listed on
/// both sides, with the own particle first.
struct ParticlePairs
{
    /// Own particles first, in the order of ParticlesView, then the copies.
    ConstVectors position{nullptr, 3, 0};
    ConstVectors velocity{nullptr, 3, 0};
    ConstView<double> radius{nullptr, 0};
    /// The number of each particle's state that DemEngine::requestPairs() named.
    ConstView<double> ofState{nullptr, 0};
    /// 2 x number of pairs: column indices in the arrays above. Empty unless DemEngine::requestPairs() was called.
    Eigen::Map<const Eigen::Matrix2Xi> list{nullptr, 2, 0};
};

/// The particles that this rank owns; column i of every array is the same particle. Valid until the engine advances,
/// because particles change ranks then.
struct ParticlesView
{
    ConstView<int> id;
    ConstVectors position;
    ConstVectors velocity;
    ConstVectors angularVelocity;
    ConstView<double> radius;
    ConstView<double> mass;
    /// `size()` entries, writable. Null unless DemEngine::requestState() was called.
    CouplingState* state = nullptr;
    /// Sum of all other forces: contacts, walls, gravity [N]. Valid only during FluidForces::evaluate().
    ConstVectors otherForce{nullptr, 3, 0};
    /// Valid only during FluidForces::evaluate().
    ParticlePairs pairs{};
    /// Values that forces and coupling store from step to step: `memorySize` numbers per particle, writable. Null
    /// unless DemEngine::requestMemory() was called.
    double* memory = nullptr;
    Eigen::Index memorySize = 0;
    /// False where forces are evaluated without a step, as in DemEngine::evaluateFluidForces(); forces must not advance
    /// their memory then.
    bool advancesMemory = true;
    /// True for a particle that no force moves because the engine fixes it. Valid only during FluidForces::evaluate().
    ConstView<bool> fixed{nullptr, 0};
    /// Fraction of the insertion time that has passed for a particle inserted during the run, from 0 to 1; 1 for all
    /// others. Writable; part of checkpoints.
    double* insertionRamp = nullptr;
    /// Torques of this step, writable [N m]: on entry of FluidForces::evaluate() the sum of all others (contacts, walls),
    /// to which it adds the fluid's. Valid only during FluidForces::evaluate().
    Vectors torque{nullptr, 3, 0};

    Eigen::Index size() const
    {
        return id.size();
    }
};

/// Volume of a sphere [m3].
inline double sphereVolume(double radius)
{
    return 4.0 / 3.0 * static_cast<double>(EIGEN_PI) * radius * radius * radius;
}

} // namespace clepsydra
