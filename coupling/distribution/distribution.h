#pragma once

#include "distribution/smoothingModel.h"
#include "distribution/voidFractionModel.h"

#include <unordered_map>
#include <vector>

namespace clepsydra
{

/// How particles act on cells and cells on particles: one operator, shares then smoothing, for volume, impulse and implicit
/// coefficients alike, and its adjoint for what the particles feel.
class Distribution
{
public:
    /// FatalError naming the patch for a mesh with cyclic patches, FatalIOError as the models' own.
    Distribution(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh);

    /// Finds the cells of each visiting particle. Local.
    /// \return 1 x ghosts: the sum of the shares on this rank, zero for a particle with no cell here.
    Eigen::MatrixXd findCells(const std::vector<GhostParticle>& ghosts);

    /// Makes the shares of each particle add up to one over all ranks. Local.
    /// \param shareSums  1 x ghosts: sums over all ranks.
    void normalise(const Eigen::MatrixXd& shareSums);

    /// Adds the particles' amounts to their cells, without smoothing. Local.
    /// \param amounts  quantities x ghosts, extensive (volume, impulse component ...)
    /// \return amounts per cell volume, quantities x cells
    Eigen::MatrixXd densities(const Eigen::MatrixXd& amounts) const;

    /// Values at each particle: shares times cell values, summed over this rank's cells only. Local.
    /// \param cellValues  quantities x cells
    /// \return quantities x ghosts
    Eigen::MatrixXd sample(const Eigen::MatrixXd& cellValues) const;

    /// Lets smooth() leave out the cells far from the particles that were found last. Collective.
    void smoothNearParticles();

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

    /// Where a ghost was looked up, and what was there.
    struct Neighbourhood
    {
        Vector3d centre;
        double reach = -1;
        /// All that a particle can touch while its centre is within the margin of `centre`.
        std::vector<Foam::label> cells;
        /// The last call of findCells() that had the particle, where it was then, and its place among the ghosts.
        long call = -1;
        Vector3d position;
        std::size_t ghost = 0;
    };

    void addShares(const GhostParticle& particle, Neighbourhood& near);
    void pruneCache(std::size_t ghostCount);

    const Foam::fvMesh& mesh_;
    CellSlabs cells_;
    Foam::autoPtr<VoidFractionModel> voidFraction_;
    Foam::autoPtr<SmoothingModel> smoothing_;
    /// Of each ghost, not normalised: from firstShare_[ghost] to firstShare_[ghost + 1].
    std::vector<Share> shares_;
    std::vector<std::size_t> firstShare_;
    /// What makes them add up to one.
    Eigen::ArrayXd normalisation_;

    /// By particle. Spares the search for cells to particles that hardly move, the cutting of spheres to those at rest; the
    /// shares are the same to the last bit as without.
    std::unordered_map<long, Neighbourhood> cache_;
    long call_ = 0;
    std::vector<Share> lastShares_;
    std::vector<std::size_t> lastFirstShare_;
};

} // namespace clepsydra
