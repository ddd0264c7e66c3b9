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

void Distribution::sample(const Foam::scalarField& cellValues, Eigen::MatrixXd& perVisitor, Eigen::Index at) const
{
    for (Eigen::Index visitor = 0; visitor < perVisitor.cols(); ++visitor)
    {
        double value = 0;
        for (std::size_t i = firstShare_[visitor]; i < firstShare_[visitor + 1]; ++i)
        {
            value += shares_[i].share * cellValues[shares_[i].cell];
        }
        perVisitor(at, visitor) = value;
    }
}

} // namespace clepsydra
