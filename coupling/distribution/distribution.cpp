#include "distribution/distribution.h"

#include "processorCyclicPolyPatch.H"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

namespace
{

/// In units of a bead's reach. Larger: fewer searches, more cells to look at in between.
constexpr double marginOfNeighbourhood = 0.3;

/// A bead at a cyclic patch would have to be at two places, in the fluid and among its neighbours.
const Foam::fvMesh& withoutCyclicPatches(const Foam::fvMesh& mesh)
{
    for (const Foam::polyPatch& patch : mesh.boundaryMesh())
    {
        const bool betweenRanks =
            Foam::isA<Foam::processorPolyPatch>(patch) && !Foam::isA<Foam::processorCyclicPolyPatch>(patch);
        if (patch.coupled() && !betweenRanks)
        {
            FatalErrorInFunction << "Patch '" << patch.name() << "' in " << mesh.boundaryMesh().objectPath()
                                 << " is of type " << patch.type()
                                 << "; allowed: wall, patch, symmetryPlane and others "
                                 << "that join no cells, and processor between ranks: a bead is in one place only"
                                 << Foam::exit(Foam::FatalError);
        }
    }
    return mesh;
}

} // namespace

Distribution::Distribution(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh)
    : mesh_(withoutCyclicPatches(mesh)),
      cells_(mesh),
      voidFraction_(VoidFractionModel::New(couplingProperties, cells_)),
      smoothing_(SmoothingModel::New(couplingProperties, mesh))
{}

Eigen::MatrixXd Distribution::findCells(const std::vector<VisitingBead>& visitors)
{
    ++call_;
    shares_.swap(lastShares_);
    firstShare_.swap(lastFirstShare_);
    shares_.clear();
    firstShare_.assign(1, 0);
    Eigen::MatrixXd shareSums = Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(visitors.size()));
    for (std::size_t visitor = 0; visitor < visitors.size(); ++visitor)
    {
        const VisitingBead& bead = visitors[visitor];
        Neighbourhood& near = known_[std::lround(bead.id)];
        addShares(bead, near);
        near.call = call_;
        near.position = bead.position;
        near.visitor = visitor;
        for (std::size_t i = firstShare_.back(); i < shares_.size(); ++i)
        {
            shareSums(0, static_cast<Eigen::Index>(visitor)) += shares_[i].share;
        }
        firstShare_.push_back(shares_.size());
    }
    forgetTheLongGone(visitors.size());
    return shareSums;
}

void Distribution::addShares(const VisitingBead& bead, Neighbourhood& near)
{
    const double reach = voidFraction_->reach(bead);
    const bool alike = near.reach == reach;
    if (alike && near.call == call_ - 1 && near.position == bead.position)
    {
        shares_.insert(shares_.end(), lastShares_.begin() + lastFirstShare_[near.visitor],
            lastShares_.begin() + lastFirstShare_[near.visitor + 1]);
        return;
    }
    const double margin = marginOfNeighbourhood * reach;
    if (!alike || (bead.position - near.centre).cwiseAbs().maxCoeff() > margin)
    {
        near.centre = bead.position;
        near.reach = reach;
        cells_.cellsNear(bead.position, reach + margin, near.cells);
    }
    const auto first = static_cast<std::ptrdiff_t>(shares_.size());
    double largest = 0;
    for (const Foam::label cell : near.cells)
    {
        const double share = cells_.isNear(cell, bead.position, reach) ? voidFraction_->share(cell, bead) : 0;
        if (share > 0)
        {
            shares_.push_back({cell, share});
            largest = std::max(largest, share);
        }
    }
    if (largest > CellSlabs::behindWall)
    {
        shares_.erase(std::remove_if(shares_.begin() + first, shares_.end(),
                          [](const Share& share) { return share.share <= CellSlabs::behindWall; }),
            shares_.end());
    }
}

void Distribution::forgetTheLongGone(std::size_t visitorCount)
{
    // Beads come back to a rank that they have just left, so not each at once.
    if (known_.size() > 2 * visitorCount + 1000)
    {
        known_.clear();
    }
}

void Distribution::normalise(const Eigen::MatrixXd& shareSums)
{
    normalisation_ = shareSums.row(0).cwiseInverse();
}

void Distribution::smoothNearBeads()
{
    std::vector<Foam::label> cells;
    cells.reserve(shares_.size());
    for (const Share& share : shares_)
    {
        cells.push_back(share.cell);
    }
    smoothing_->nearTo(cells);
}

Eigen::MatrixXd Distribution::densities(const Eigen::MatrixXd& amounts) const
{
    Eigen::MatrixXd densities = Eigen::MatrixXd::Zero(amounts.rows(), mesh_.nCells());
    Eigen::VectorXd amount(amounts.rows());
    for (Eigen::Index visitor = 0; visitor < amounts.cols(); ++visitor)
    {
        amount = normalisation_[visitor] * amounts.col(visitor);
        for (std::size_t i = firstShare_[visitor]; i < firstShare_[visitor + 1]; ++i)
        {
            densities.col(shares_[i].cell) += shares_[i].share * amount;
        }
    }
    const Foam::scalarField& volumes = mesh_.V().field();
    forAll (volumes, cell)
    {
        densities.col(cell) /= volumes[cell];
    }
    return densities;
}

Eigen::MatrixXd Distribution::sample(const Eigen::MatrixXd& cellValues) const
{
    Eigen::MatrixXd values =
        Eigen::MatrixXd::Zero(cellValues.rows(), static_cast<Eigen::Index>(firstShare_.size()) - 1);
    for (Eigen::Index visitor = 0; visitor < values.cols(); ++visitor)
    {
        for (std::size_t i = firstShare_[visitor]; i < firstShare_[visitor + 1]; ++i)
        {
            values.col(visitor) += shares_[i].share * cellValues.col(shares_[i].cell);
        }
        values.col(visitor) *= normalisation_[visitor];
    }
    return values;
}

} // namespace clepsydra
