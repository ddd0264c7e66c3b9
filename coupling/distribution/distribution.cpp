#include "distribution/distribution.h"

namespace clepsydra
{

Distribution::Distribution(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh)
    : mesh_(mesh),
      cells_(mesh),
      voidFraction_(VoidFractionModel::New(couplingProperties, cells_)),
      smoothing_(SmoothingModel::New(couplingProperties, mesh))
{}

Eigen::MatrixXd Distribution::findCells(const std::vector<VisitingBead>& visitors)
{
    Eigen::MatrixXd shareSums = Eigen::MatrixXd::Zero(1, static_cast<Eigen::Index>(visitors.size()));
    shares_.clear();
    firstShare_.assign(1, 0);
    std::vector<Foam::label> near;
    Eigen::Index visitor = 0;
    for (const VisitingBead& bead : visitors)
    {
        cells_.cellsNear(bead.position, voidFraction_->reach(bead), near);
        for (const Foam::label cell : near)
        {
            const double share = voidFraction_->share(cell, bead);
            if (share > 0)
            {
                shares_.push_back({cell, share});
                shareSums(0, visitor) += share;
            }
        }
        firstShare_.push_back(shares_.size());
        ++visitor;
    }
    return shareSums;
}

void Distribution::normalise(const Eigen::MatrixXd& shareSums)
{
    for (Eigen::Index visitor = 0; visitor < shareSums.cols(); ++visitor)
    {
        for (std::size_t i = firstShare_[visitor]; i < firstShare_[visitor + 1]; ++i)
        {
            shares_[i].share /= shareSums(0, visitor);
        }
    }
}

Eigen::MatrixXd Distribution::densities(const Eigen::MatrixXd& amounts) const
{
    Eigen::MatrixXd densities = Eigen::MatrixXd::Zero(amounts.rows(), mesh_.nCells());
    for (Eigen::Index visitor = 0; visitor < amounts.cols(); ++visitor)
    {
        for (std::size_t i = firstShare_[visitor]; i < firstShare_[visitor + 1]; ++i)
        {
            densities.col(shares_[i].cell) += shares_[i].share * amounts.col(visitor);
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
    }
    return values;
}

} // namespace clepsydra
