#pragma once

#include "engine/periodicBox.h"
#include "rankTotals.h"

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
/// publishes a box with a margin around its particles. The plan which rank sends to which follows from the published
/// boxes and is kept as long as all particles are in them, so that in most coupling steps the only collective
/// communication is the confirmation that no box has become too small. It may be part of a later reduction.
///
/// Where space is periodic, a particle has a ghost for each of its images that is near a rank's cells. The sums over
/// its ghosts are then those over all images.
class ParticleExchange
{
public:
    /// Collective.
    /// \param cells  box around this rank's cells
    /// \param commonReach  distance from its centre over which every particle acts, where that is larger than its
    /// radius [m]
    ParticleExchange(MPI_Comm communicator, const Box& cells, double commonReach = 0, const PeriodicBox& periodic = {});

    /// Sets the box around this rank's cells after the mesh has moved. Collective.
    void setCells(const Box& cells);

    /// Sends every particle to each rank whose box of cells intersects the cube around the particle's sphere or reach.
    /// Collective.
    /// \param contributions  a column per particle, which its ghosts receive with it; the same rows on all ranks
    void send(const ParticlesView& particles, const Eigen::MatrixXd& contributions);

    /// As send(), by the plan of the last call, without asking whether it still fits. Where a particle of any rank has
    /// left the box that its rank has published, ghosts may be missing. A condition of the totals then does not hold, and
    /// the next call makes a new plan. Collective, but a reduction only where a new plan is made.
    void sendAsPlanned(const ParticlesView& particles, const Eigen::MatrixXd& contributions, RankTotals& totals);

    /// The ghost particles on this rank: copies of its own particles first, then by sending rank. Local.
    const std::vector<GhostParticle>& ghosts() const
    {
        return ghosts_;
    }

    /// What was sent with each of ghosts(), valid until the next call of send() or sendAsPlanned(). Local.
    Eigen::Map<const Eigen::MatrixXd> contributions() const
    {
        return {contributions_.data(), contributionRows_, static_cast<Eigen::Index>(ghosts_.size())};
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

    GhostParticle ghostOf(const ParticlesView& particles, Eigen::Index particle, const Eigen::Vector3i& periods) const;
    /// Lists the particles that are sent to each receiving rank. Local.
    void listExports(const ParticlesView& particles);
    /// Enlarges the published boxes where necessary, and determines the receiving and sending ranks from them.
    /// Collective.
    void publishBounds(const Box& particles);
    /// Sends outgoing_, a message per rank, and receives incoming_, a message per rank.
    void swap(const std::vector<int>& toRanks, const std::vector<int>& fromRanks) const;

    MPI_Comm communicator_;
    int rank_ = 0;
    Box cells_;
    double commonReach_;
    PeriodicBox periodic_;
    /// Boxes around the cells of each rank.
    std::vector<Box> subdomainBounds_;
    /// Box around this rank's particles with a margin; it never shrinks.
    Box publishedBounds_;
    /// Whether all particles of all ranks were in the published boxes when this was asked last; the same on all ranks.
    bool planHolds_ = false;
    /// Ranks whose cells may be near this rank's particles, and ranks whose particles may be near this rank's cells.
    /// This rank comes first.
    std::vector<int> receivingRanks_;
    std::vector<int> sendingRanks_;
    std::vector<Exports> exports_;
    std::vector<Imports> imports_;
    std::vector<GhostParticle> ghosts_;
    std::vector<double> contributions_;
    Eigen::Index contributionRows_ = 0;
    Eigen::Index particleCount_ = 0;
    // Kept from message to message, so that a coupling step like the one before allocates no memory for them.
    mutable std::vector<std::vector<double>> outgoing_;
    mutable std::vector<std::vector<double>> incoming_;
    mutable std::vector<MPI_Request> requests_;
    mutable std::size_t bytesSent_ = 0;
};

} // namespace clepsydra
