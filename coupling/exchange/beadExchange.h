#pragma once

#include "engine/beads.h"

#include <mpi.h>

#include <vector>

namespace clepsydra
{

/// What a bead does to the fluid, to be spread over its cells: rows as in FluidCoupling.
constexpr int reactionSize = 9;
using Reaction = Eigen::Matrix<double, reactionSize, 1, Eigen::DontAlign>;
using Reactions = Eigen::Matrix<double, reactionSize, Eigen::Dynamic>;

/// A bead as the rank of its cells sees it: what the distribution onto the mesh needs, nothing else. SI units.
/// Of a bead that is only partly in the fluid: the sphere that stands for that part, see SphereInFluid.
struct VisitingBead
{
    Vector3d position;
    Reaction reaction;
    double implicitCoefficientTime;
    double volume;
    double radius;
    double id;
};

/// Carries beads to the ranks whose cells they touch, and answers back.
///
/// The engine and the fluid cut space differently, so a bead may live on one rank and displace fluid on another, or
/// on two at a processor boundary. Ranks whose boxes (beads here, cells there) do not touch never exchange a message:
/// what is known to every rank is two boxes a rank, not the beads. A rank announces a box with room around its beads, so
/// that in most intervals all that every rank must hear is that no box has become too small.
class BeadExchange
{
public:
    /// Collective.
    /// \param cells  box around this rank's cells; the mesh does not move.
    /// \param commonReach  how far from its centre every bead acts, if farther than its radius [m]
    BeadExchange(MPI_Comm communicator, const Box& cells, double commonReach = 0);

    /// Sends every bead to each rank whose box the cube about its sphere, or its reach, meets. Collective.
    /// \param reactions  of each bead
    void send(const BeadsView& beads, const Reactions& reactions);

    /// Local: the beads that touch this rank's box, own ones first, then by rank.
    const std::vector<VisitingBead>& visitors() const
    {
        return visitors_;
    }

    /// Adds up at each bead's home what its visits found. Collective.
    /// \param perVisitor  one column per visitor. \return one column per bead, zero where it visited no rank.
    Eigen::MatrixXd sumAtHome(const Eigen::MatrixXd& perVisitor) const;

    /// Hands a value of each bead to all its visits. Collective.
    /// \param perBead  one column per bead. \return one column per visitor.
    Eigen::MatrixXd toVisitors(const Eigen::MatrixXd& perBead) const;

    /// Local: bytes that this rank has sent to others so far.
    std::size_t bytesSent() const
    {
        return bytesSent_;
    }

private:
    /// Beads that one other rank (or this one) hosts or is host to.
    struct Exports
    {
        int rank;
        std::vector<Eigen::Index> beads;
    };
    struct Imports
    {
        int rank;
        Eigen::Index first;
        Eigen::Index count;
    };

    void makePlan(const BeadsView& beads);
    /// Makes the announced boxes wide enough, and the lists from them. Collective.
    void announce(const Box& beads);
    std::vector<std::vector<double>> swap(const std::vector<int>& toRanks, const std::vector<std::vector<double>>& out,
        const std::vector<int>& fromRanks) const;

    MPI_Comm communicator_;
    int rank_ = 0;
    Box cells_;
    double commonReach_;
    /// Of each rank.
    std::vector<Box> cellsOfRanks_;
    /// Around the beads of this rank, with room; never shrinks.
    Box announced_;
    /// Ranks with cells in the announced box; ranks with cells here in theirs. This rank first.
    std::vector<int> hosts_;
    std::vector<int> guests_;
    std::vector<Exports> exports_;
    std::vector<Imports> imports_;
    std::vector<VisitingBead> visitors_;
    Eigen::Index beadCount_ = 0;
    mutable std::size_t bytesSent_ = 0;
};

} // namespace clepsydra
