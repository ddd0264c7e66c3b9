#pragma once

#include "engine/periodicBox.h"

#include <mpi.h>

#include <vector>

namespace clepsydra
{

/// Copy of a particle on a rank that has cells near it, with the data that the distribution onto the mesh needs. SI
/// units. Where the particle is only partly in the fluid, position and radius are those of SphereInFluid.
struct GhostParticle
{
    Vector3d position;
    double radius;
    double id;
    /// Number of the image that this copy is; 0 for that at the position which the engine states.
    double image;
};

/// Sends particles to the ranks whose cells they overlap, as ghost particles, and returns results to their owners.
///
/// The engine and the fluid decompose space differently. A particle may be owned by one rank and displace fluid on
/// another, or on two ranks at a processor boundary. Ranks whose boxes (particles of one, cells of the other) do not
/// intersect never exchange a message. Every rank knows two boxes per rank, not the particles of other ranks. A rank
/// publishes a box with a margin around its particles, so that in most coupling steps the only collective communication
/// is the confirmation that no box has become too small.
///
/// Where space is periodic, a particle has a ghost for each of its images that is near a rank's cells. The sums over
/// its ghosts are then those over all images.
class ParticleExchange
{
public:
    /// Collective.
    /// \param cells  box around this rank's cells; the mesh does not move
    /// \param commonReach  distance from its centre over which every particle acts, where that is larger than its
    /// radius [m]
    ParticleExchange(MPI_Comm communicator, const Box& cells, double commonReach = 0, const PeriodicBox& periodic = {});

    /// Sends every particle to each rank whose box of cells intersects the cube around the particle's sphere or reach.
    /// Collective.
    /// \param contributions  a column per particle, which its ghosts receive with it; the same rows on all ranks
    void send(const ParticlesView& particles, const Eigen::MatrixXd& contributions);

    /// The ghost particles on this rank: copies of its own particles first, then by sending rank. Local.
    const std::vector<GhostParticle>& ghosts() const
    {
        return ghosts_;
    }

    /// What was sent with each of ghosts(). Local.
    const Eigen::MatrixXd& contributions() const
    {
        return contributions_;
    }

    /// Sums results of ghost particles on their owning ranks. Collective.
    /// \param perGhost  a column per ghost particle
    /// \return a column per particle of this rank; zero for a particle without ghosts
    Eigen::MatrixXd sumAtOwners(const Eigen::MatrixXd& perGhost) const;

    /// Sends a value of each particle to its ghosts. Collective.
    /// \param perParticle  a column per particle of this rank
    /// \return a column per ghost particle
    Eigen::MatrixXd toGhosts(const Eigen::MatrixXd& perParticle) const;

    /// Bytes that this rank has sent to other ranks so far. Local.
    std::size_t bytesSent() const
    {
        return bytesSent_;
    }

private:
    /// Particles that this rank sends to one rank (also to itself), and ghosts that it receives from one rank. A particle
    /// is listed once for each of its images that it sends.
    struct Exports
    {
        int rank;
        std::vector<Eigen::Index> particles;
        /// Of each entry above: lengths of the periodic box between the particle and its image.
        std::vector<Eigen::Vector3i> periods;
    };
    struct Imports
    {
        int rank;
        Eigen::Index first;
        Eigen::Index count;
    };

    void makePlan(const ParticlesView& particles);
    GhostParticle ghostOf(const ParticlesView& particles, Eigen::Index particle, const Eigen::Vector3i& periods) const;
    /// Enlarges the published boxes where necessary, and determines the receiving and sending ranks from them.
    /// Collective.
    void publishBounds(const Box& particles);
    std::vector<std::vector<double>> swap(const std::vector<int>& toRanks, const std::vector<std::vector<double>>& out,
        const std::vector<int>& fromRanks) const;

    MPI_Comm communicator_;
    int rank_ = 0;
    Box cells_;
    double commonReach_;
    PeriodicBox periodic_;
    /// Boxes around the cells of each rank.
    std::vector<Box> subdomainBounds_;
    /// Box around this rank's particles with a margin; it never shrinks.
    Box publishedBounds_;
    /// Ranks whose cells may be near this rank's particles, and ranks whose particles may be near this rank's cells.
    /// This rank comes first.
    std::vector<int> receivingRanks_;
    std::vector<int> sendingRanks_;
    std::vector<Exports> exports_;
    std::vector<Imports> imports_;
    std::vector<GhostParticle> ghosts_;
    Eigen::MatrixXd contributions_;
    Eigen::Index particleCount_ = 0;
    mutable std::size_t bytesSent_ = 0;
};

} // namespace clepsydra
