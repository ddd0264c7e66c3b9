#pragma once

#include "distribution/smoothingModel.h"
#include "distribution/voidFractionModel.h"

#include <vector>

namespace clepsydra
{

/// How beads act on cells and cells on beads: one operator, shares then smoothing, for volume, impulse and implicit
/// coefficients alike, and its adjoint for what the beads feel.
class Distribution
{
public:
    Distribution(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh);

    /// Finds the cells of each visiting bead. Local.
    /// \return 1 x visitors: the sum of the shares on this rank, zero for a bead with no cell here.
    Eigen::MatrixXd findCells(const std::vector<VisitingBead>& visitors);

    /// Makes the shares of each bead add up to one over all ranks. Local.
    /// \param shareSums  1 x visitors: sums over all ranks.
    void normalise(const Eigen::MatrixXd& shareSums);

    /// Adds a bead's amount to its cells, without smoothing. Local.
    /// \param amount(visitor)  extensive (volume, impulse component ...)
    /// \return amount per cell volume
    template<class Amount>
    Foam::scalarField density(Amount&& amount) const;

    /// Value at each bead: shares times cell values, summed over this rank's cells only. Local.
    /// \param at  row of `perVisitor` to fill
    void sample(const Foam::scalarField& cellValues, Eigen::MatrixXd& perVisitor, Eigen::Index at) const;

    /// Smooths a density; see SmoothingModel::smooth. Collective.
    void smooth(const Foam::scalarField& density, Foam::scalarField& guess) const
    {
        smoothing_->smooth(density, guess);
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

    const Foam::fvMesh& mesh_;
    CellSlabs cells_;
    Foam::autoPtr<VoidFractionModel> voidFraction_;
    Foam::autoPtr<SmoothingModel> smoothing_;
    std::vector<Share> shares_;
    std::vector<std::size_t> firstShare_;
};

template<class Amount>
Foam::scalarField Distribution::density(Amount&& amount) const
{
    Foam::scalarField density(mesh_.nCells(), 0.0);
    for (std::size_t visitor = 0; visitor + 1 < firstShare_.size(); ++visitor)
    {
        const double total = amount(visitor);
        for (std::size_t i = firstShare_[visitor]; i < firstShare_[visitor + 1]; ++i)
        {
            density[shares_[i].cell] += shares_[i].share * total;
        }
    }
    density /= mesh_.V().field();
    return density;
}

} // namespace clepsydra
