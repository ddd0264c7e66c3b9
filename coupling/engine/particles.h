#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <type_traits>

/// \file
/// The particles of one rank, as the coupling sees them. SI units throughout.

namespace clepsydra
{

using Eigen::Vector3d;
using Box = Eigen::AlignedBox3d;

/// Whether the cube about a sphere meets a box. Whoever asks what a particle can act on asks this: a share may be above zero
/// in a cell that the cube meets and the sphere does not (CellSlabs).
inline bool cubeMeets(const Box& box, const Vector3d& centre, double radius)
{
    return ((centre - box.min()).array() >= -radius).all() && ((box.max() - centre).array() >= -radius).all();
}

/// The coupling's part of a particle's state, which it defines (couplingState.h). To an engine so many plain numbers, which
/// travel with the particle from rank to rank, because a particle may change rank at any DEM step, also in the middle of an
/// interval.
struct CouplingState;

/// A view of a contiguous array, of fixed size while it lives (std::span of C++20, as far as needed).
template<class T>
using View = Eigen::Map<Eigen::Array<std::remove_const_t<T>, Eigen::Dynamic, 1>>;
template<class T>
using ConstView = Eigen::Map<const Eigen::Array<T, Eigen::Dynamic, 1>>;
using ConstVectors = Eigen::Map<const Eigen::Matrix3Xd>;
using Vectors = Eigen::Map<Eigen::Matrix3Xd>;

/// Pairs of particles near each other, for forces between particles. A pair of own particles is listed once; a pair of an own particle
/// and a copy of another rank's particle (or of a particle across a periodic boundary) is listed at either, its own particle first.
struct ParticlePairs
{
    /// Own particles first, in ParticlesView's order, then the copies.
    ConstVectors position{nullptr, 3, 0};
    ConstVectors velocity{nullptr, 3, 0};
    ConstView<double> radius{nullptr, 0};
    /// 2 x number of pairs: columns of the above. Empty unless DemEngine::requestPairs() was called.
    Eigen::Map<const Eigen::Matrix2Xi> list{nullptr, 2, 0};
};

/// The particles that this rank owns; column i of every array is the same particle.
/// Valid until the engine advances: particles move between ranks then.
struct ParticlesView
{
    ConstView<int> id;
    ConstVectors position;
    ConstVectors velocity;
    ConstVectors angularVelocity;
    ConstView<double> radius;
    ConstView<double> mass;
    /// `size()` entries, writable. None unless DemEngine::requestState() was called.
    CouplingState* state = nullptr;
    /// Sum of the forces of all else: contacts, walls, gravity [N]. Meaningful while FluidForces::evaluate() runs.
    ConstVectors otherForce{nullptr, 3, 0};
    /// For FluidForces::evaluate() only, as is otherForce.
    ParticlePairs pairs{};
    /// What forces and coupling keep from step to step: `memorySize` numbers per particle, writable. None unless
    /// DemEngine::requestMemory() was called.
    double* memory = nullptr;
    Eigen::Index memorySize = 0;
    /// False where forces are evaluated without a step: DemEngine::evaluateFluidForces().
    bool advancesMemory = true;
    /// For FluidForces::evaluate() only: true where no force moves the particle, for the engine holds it fast.
    ConstView<bool> fixed{nullptr, 0};
    /// How far a particle that has come in during the run has been introduced to the fluid, from 0 to 1; 1 of all others.
    /// Writable, part of checkpoints.
    double* insertionRamp = nullptr;

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
