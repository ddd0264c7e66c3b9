#pragma once

#include "distribution/smoothingModel.h"
#include "distribution/voidFractionModel.h"

#include <unordered_map>
#include <vector>

namespace clepsydra
{

/// How beads act on cells and cells on beads: one operator, shares then smoothing, for volume, impulse and implicit
/// coefficients alike, and its adjoint for what the beads feel.
class Distribution
{
public:
    /// FatalError naming the patch for a mesh with cyclic patches, FatalIOError as the models' own.
    Distribution(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh);

    /// Finds the cells of each visiting bead. Local.
    /// \return 1 x visitors: the sum of the shares on this rank, zero for a bead with no cell here.
    Eigen::MatrixXd findCells(const std::vector<VisitingBead>& visitors);

    /// Makes the shares of each bead add up to one over all ranks. Local.
    /// \param shareSums  1 x visitors: sums over all ranks.
    void normalise(const Eigen::MatrixXd& shareSums);

    /// Adds the beads' amounts to their cells, without smoothing. Local.
    /// \param amounts  quantities x visitors, extensive (volume, impulse component ...)
    /// \return amounts per cell volume, quantities x cells
    Eigen::MatrixXd densities(const Eigen::MatrixXd& amounts) const;

    /// Values at each bead: shares times cell values, summed over this rank's cells only. Local.
    /// \param cellValues  quantities x cells
    /// \return quantities x visitors
    Eigen::MatrixXd sample(const Eigen::MatrixXd& cellValues) const;

    /// Lets smooth() leave out the cells far from the beads that were found last. Collective.
    void smoothNearBeads();

    /// Smooths densities; see SmoothingModel::smooth. Collective.
    void smooth(Eigen::MatrixXd& densities) const
    {
        smoothing_->smooth(densities);
    }

    const CellSlabs& cells() const
    {
        return cells_;
    }

    const VoidFractionModel& voidFractionModel() const
    {
        return *voidFraction_;
    }

    const SmoothingModel& smoothingModel() const
    {
        return *smoothing_;
    }

private:
    struct Share
    {
        Foam::label cell;
        double share;
    };

    /// Where a visitor was looked up, and what was there.
    struct Neighbourhood
    {
        Vector3d centre;
        double reach = -1;
        /// All that a bead can touch while its centre is within the margin of `centre`.
        std::vector<Foam::label> cells;
        /// The last call of findCells() that had the bead, where it was then, and its place among the visitors.
        long call = -1;
        Vector3d position;
        std::size_t visitor = 0;
    };

    void addShares(const VisitingBead& bead, Neighbourhood& near);
    void forgetTheLongGone(std::size_t visitorCount);

    const Foam::fvMesh& mesh_;
    CellSlabs cells_;
    Foam::autoPtr<VoidFractionModel> voidFraction_;
    Foam::autoPtr<SmoothingModel> smoothing_;
    /// Of each visitor, not normalised: from firstShare_[visitor] to firstShare_[visitor + 1].
    std::vector<Share> shares_;
    std::vector<std::size_t> firstShare_;
    /// What makes them add up to one.
    Eigen::ArrayXd normalisation_;

    /// By bead. Spares the search for cells to beads that hardly move, the cutting of spheres to those at rest; the
    /// shares are the same to the last bit as without.
    std::unordered_map<long, Neighbourhood> known_;
    long call_ = 0;
    std::vector<Share> lastShares_;
    std::vector<std::size_t> lastFirstShare_;
};

} // namespace clepsydra
