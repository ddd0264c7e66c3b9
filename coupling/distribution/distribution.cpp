#include "distribution/distribution.h"

#include "distribution/cyclicPatches.h"

#include "wedgePolyPatch.H"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

namespace
{

/// Margin in units of a particle's reach. A larger one needs fewer searches and more cells to examine between them.
constexpr double neighbourhoodMargin = 0.3;

/// Between wedge patches the mesh is a slice of an axisymmetric flow, in which a whole sphere would have its volume and
/// drag.
const Foam::fvMesh& withoutWedges(const Foam::fvMesh& mesh)
{
    for (const Foam::polyPatch& patch : mesh.boundaryMesh())
    {
        if (Foam::isA<Foam::wedgePolyPatch>(patch))
        {
            FatalErrorInFunction
                << "Patch '" << patch.name() << "' in " << mesh.boundaryMesh().objectPath()
                << " is of type wedge; allowed: wall, patch, symmetryPlane, cyclic and others, because the mesh must "
                << "hold whole particles, and a wedge holds a slice of each" << Foam::exit(Foam::FatalError);
        }
    }
    return mesh;
}

/// Key of a ghost in the cache.
long keyOf(const GhostParticle& particle)
{
    constexpr long idCount = 1L << 32;
    return std::lround(particle.id) + idCount * std::lround(particle.image);
}

} // namespace

Distribution::Distribution(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh)
    : mesh_(withoutWedges(mesh)),
      periodic_(periodicBoxOf(mesh)),
      cells_(mesh),
      voidFraction_(VoidFractionModel::New(couplingProperties, cells_)),
      smoothing_(SmoothingModel::New(couplingProperties, mesh))
{}

void Distribution::meshMoved()
{
    cells_.meshMoved();
    voidFraction_->meshMoved();
    smoothing_->meshMoved();
    // The cells near a particle are others, and one that has not moved is cut by other planes.
    cache_.clear();
}

Eigen::MatrixXd Distribution::findCells(const std::vector<GhostParticle>& ghosts)
{
    ++call_;
    shares_.swap(lastShares_);
    firstShare_.swap(lastFirstShare_);
    shares_.clear();
    firstShare_.assign(1, 0);
    Eigen::MatrixXd shareSums = Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(ghosts.size()));
    for (std::size_t ghost = 0; ghost < ghosts.size(); ++ghost)
    {
        const GhostParticle& particle = ghosts[ghost];
        Neighbourhood& near = cache_[keyOf(particle)];
        addShares(particle, near);
        near.call = call_;
        near.position = particle.position;
        near.ghost = ghost;
        for (std::size_t i = firstShare_.back(); i < shares_.size(); ++i)
        {
            shareSums(0, static_cast<Eigen::Index>(ghost)) += shares_[i].share;
        }
        firstShare_.push_back(shares_.size());
    }
    pruneCache(ghosts.size());
    return shareSums;
}

void Distribution::addShares(const GhostParticle& particle, Neighbourhood& near)
{
    const double reach = voidFraction_->reach(particle);
    const bool alike = near.reach == reach;
    if (alike && near.call == call_ - 1 && near.position == particle.position)
    {
        shares_.insert(shares_.end(), lastShares_.begin() + lastFirstShare_[near.ghost],
            lastShares_.begin() + lastFirstShare_[near.ghost + 1]);
        return;
    }
    const double margin = neighbourhoodMargin * reach;
    if (!alike || (particle.position - near.centre).cwiseAbs().maxCoeff() > margin)
    {
        near.centre = particle.position;
        near.reach = reach;
        cells_.cellsNear(particle.position, reach + margin, near.cells);
    }
    const auto first = static_cast<std::ptrdiff_t>(shares_.size());
    double largest = 0;
    for (const Foam::label cell : near.cells)
    {
        const double share = cells_.isNear(cell, particle.position, reach) ? voidFraction_->share(cell, particle) : 0;
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

void Distribution::pruneCache(std::size_t ghostCount)
{
    // Particles often return to a rank that they have just left, so entries are not removed at once.
    if (cache_.size() > 2 * ghostCount + 1000)
    {
        cache_.clear();
    }
}

void Distribution::normalise(const Eigen::MatrixXd& shareSums)
{
    normalisation_ = shareSums.row(0).transpose().unaryExpr([](double sum) { return sum > 0 ? 1 / sum : 0.0; });
}

void Distribution::smoothNearParticles(RankTotals& totals)
{
    std::vector<Foam::label> cells;
    cells.reserve(shares_.size());
    for (const Share& share : shares_)
    {
        cells.push_back(share.cell);
    }
    smoothing_->nearTo(cells, totals);
}

Eigen::MatrixXd Distribution::densities(const Eigen::MatrixXd& amounts) const
{
    Eigen::MatrixXd densities = Eigen::MatrixXd::Zero(amounts.rows(), mesh_.nCells());
    Eigen::VectorXd amount(amounts.rows());
    for (Eigen::Index ghost = 0; ghost < amounts.cols(); ++ghost)
    {
        amount = normalisation_[ghost] * amounts.col(ghost);
        for (std::size_t i = firstShare_[ghost]; i < firstShare_[ghost + 1]; ++i)
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
    for (Eigen::Index ghost = 0; ghost < values.cols(); ++ghost)
    {
        for (std::size_t i = firstShare_[ghost]; i < firstShare_[ghost + 1]; ++i)
        {
            values.col(ghost) += shares_[i].share * cellValues.col(shares_[i].cell);
        }
        values.col(ghost) *= normalisation_[ghost];
    }
    return values;
}

} // namespace clepsydra
