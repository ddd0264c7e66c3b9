#pragma once

#include "engine/particles.h"

#include <mpi.h>

#include <vector>

namespace clepsydra
{

/// What a particle does to the fluid, to be spread over its cells: rows as in FluidCoupling.
constexpr int reactionSize = 9;
using Reaction = Eigen::Matrix<double, reactionSize, 1, Eigen::DontAlign>;
using Reactions = Eigen::Matrix<double, reactionSize, Eigen::Dynamic>;

/// A particle as the rank of its cells sees it: what the distribution onto the mesh needs, nothing else. SI units.
/// Of a particle that is only partly in the fluid: the sphere that stands for that part, see SphereInFluid.
struct GhostParticle
{
    Vector3d position;
    Reaction reaction;
    double implicitCoefficientTime;
    double volume;
    double radius;
    double id;
};

/// Carries particles to the ranks whose cells they touch, and answers back.
///
/// The engine and the fluid cut space differently, so a particle may live on one rank and displace fluid on another, or
/// on two at a processor boundary. Ranks whose boxes (particles here, cells there) do not touch never exchange a message:
/// what is known to every rank is two boxes a rank, not the particles. A rank publishes a box with room around its particles, so
/// that in most intervals all that every rank must hear is that no box has become too small.
class ParticleExchange
{
public:
    /// Collective.
    /// \param cells  box around this rank's cells; the mesh does not move.
    /// \param commonReach  how far from its centre every particle acts, if farther than its radius [m]
    ParticleExchange(MPI_Comm communicator, const Box& cells, double commonReach = 0);

    /// Sends every particle to each rank whose box the cube about its sphere, or its reach, meets. Collective.
    /// \param reactions  of each particle
    void send(const ParticlesView& particles, const Reactions& reactions);

    /// Local: the particles that touch this rank's box, own ones first, then by rank.
    const std::vector<GhostParticle>& ghosts() const
    {
        return ghosts_;
    }

    /// Adds up at each particle's home what its visits found. Collective.
    /// \param perGhost  one column per ghost. \return one column per particle, zero where it visited no rank.
    Eigen::MatrixXd sumAtOwners(const Eigen::MatrixXd& perGhost) const;

    /// Hands a value of each particle to all its visits. Collective.
    /// \param perParticle  one column per particle. \return one column per ghost.
    Eigen::MatrixXd toGhosts(const Eigen::MatrixXd& perParticle) const;

    /// Local: bytes that this rank has sent to others so far.
    std::size_t bytesSent() const
    {
        return bytesSent_;
    }

private:
    /// Particles that one other rank (or this one) hosts or is host to.
    struct Exports
    {
        int rank;
        std::vector<Eigen::Index> particles;
    };
    struct Imports
    {
        int rank;
        Eigen::Index first;
        Eigen::Index count;
    };

    void makePlan(const ParticlesView& particles);
    /// Makes the published boxes wide enough, and the lists from them. Collective.
    void publishBounds(const Box& particles);
    std::vector<std::vector<double>> swap(const std::vector<int>& toRanks, const std::vector<std::vector<double>>& out,
        const std::vector<int>& fromRanks) const;

    MPI_Comm communicator_;
    int rank_ = 0;
    Box cells_;
    double commonReach_;
    /// Of each rank.
    std::vector<Box> subdomainBounds_;
    /// Around the particles of this rank, with room; never shrinks.
    Box publishedBounds_;
    /// Ranks with cells in the published box; ranks with cells here in theirs. This rank first.
    std::vector<int> receivingRanks_;
    std::vector<int> sendingRanks_;
    std::vector<Exports> exports_;
    std::vector<Imports> imports_;
    std::vector<GhostParticle> ghosts_;
    Eigen::Index particleCount_ = 0;
    mutable std::size_t bytesSent_ = 0;
};

} // namespace clepsydra
