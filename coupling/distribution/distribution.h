#pragma once

#include "distribution/smoothingModel.h"
#include "distribution/voidFractionModel.h"

#include <unordered_map>
#include <vector>

namespace clepsydra
{

/// Distributes the particles' volume, impulse and implicit coefficients to the cells by one operator, shares and then
/// smoothing, and samples the fluid at the particles by its adjoint.
class Distribution
{
public:
    /// FatalError that names the patch for a mesh with wedges, and as periodicBoxOf(); FatalIOError from the models.
    Distribution(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh);

    /// Finds the cells of each ghost particle. Local.
    /// \return 1 x ghosts: sum of the shares on this rank, zero for a particle without a cell here
    Eigen::MatrixXd findCells(const std::vector<GhostParticle>& ghosts);

    /// Scales the shares so that those of each particle add up to one over all ranks. A particle without a cell on any
    /// rank gives nothing and samples zero. Local.
    /// \param shareSums  1 x ghosts: sums of the shares over all ranks
    void normalise(const Eigen::MatrixXd& shareSums);

    /// Adds the particles' amounts to their cells, without smoothing. Local.
    /// \param amounts  quantities x ghosts, extensive (volume, impulse component ...)
    /// \return quantities x cells: amounts per cell volume
    Eigen::MatrixXd densities(const Eigen::MatrixXd& amounts) const;

    /// Samples cell values at each ghost particle: shares times values, summed over this rank's cells only. Local.
    /// \param cellValues  quantities x cells
    /// \return quantities x ghosts
    Eigen::MatrixXd sample(const Eigen::MatrixXd& cellValues) const;

    /// Allows smooth() to leave out cells far from the particles of the last findCells(). To be repeated where a
    /// condition of the totals does not hold, see SmoothingModel::nearTo(). Collective.
    void smoothNearParticles(RankTotals& totals);

    /// Smooths densities, see SmoothingModel::smooth(). Collective.
    void smooth(Eigen::MatrixXd& densities) const
    {
        smoothing_->smooth(densities);
    }

    /// Recomputes what depends on the points of the mesh, after they have moved. Collective.
    void meshMoved();

    /// The directions in which the mesh is periodic.
    const PeriodicBox& periodicBox() const
    {
        return periodic_;
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

    /// The cells near a ghost particle when it was last searched for.
    struct Neighbourhood
    {
        Vector3d centre;
        double reach = -1;
        /// All cells that the particle can overlap while its centre is within the margin of `centre`.
        std::vector<Foam::label> cells;
        /// Number of the last call of findCells() that had the particle, its position then and its index among the
        /// ghosts.
        long call = -1;
        Vector3d position;
        std::size_t ghost = 0;
    };

    void addShares(const GhostParticle& particle, Neighbourhood& near);
    void pruneCache(std::size_t ghostCount);

    const Foam::fvMesh& mesh_;
    const PeriodicBox periodic_;
    CellSlabs cells_;
    Foam::autoPtr<VoidFractionModel> voidFraction_;
    Foam::autoPtr<SmoothingModel> smoothing_;
    /// Shares of each ghost, not normalised: entries firstShare_[ghost] to firstShare_[ghost + 1].
    std::vector<Share> shares_;
    std::vector<std::size_t> firstShare_;
    /// Factor of each ghost's shares that makes them add up to one.
    Eigen::ArrayXd normalisation_;

    /// Cache by particle id and image. It saves the search for cells where a particle has hardly moved, and the cutting of
    /// spheres where it is at rest. The shares are the same to the last bit as without the cache.
    std::unordered_map<long, Neighbourhood> cache_;
    long call_ = 0;
    std::vector<Share> lastShares_;
    std::vector<std::size_t> lastFirstShare_;
};

} // namespace clepsydra
