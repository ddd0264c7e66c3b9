#include "emulator/grid.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

/// Number of steps between amplitude 0 and the end of the range that is farther from it.
constexpr double steps = 8.0;

} // namespace

Grid::Grid(const Effect& effect)
{
    if (effect.isSwitch)
    {
        amplitudes_ = Eigen::VectorXd::Ones(1);
        return;
    }
    const auto [lower, upper] = effect.bounds;
    step_ = std::max(upper, -lower) / steps;
    const double below = std::ceil(-lower / step_ - 1e-9);
    const double above = std::ceil(upper / step_ - 1e-9);
    amplitudes_ =
        Eigen::VectorXd::LinSpaced(static_cast<Eigen::Index>(below + above) + 1, -below * step_, above * step_);
}

Eigen::RowVectorXd Grid::weightsAt(double amplitude) const
{
    const Eigen::Index nodes = amplitudes_.size();
    const double x = (amplitude - amplitudes_(0)) / step_;
    const Eigen::Index count = std::min<Eigen::Index>(4, nodes);
    const Eigen::Index first = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(std::floor(x)) - 1, 0, nodes - count);
    Eigen::RowVectorXd weights = Eigen::RowVectorXd::Zero(nodes);
    for (Eigen::Index i = first; i < first + count; ++i)
    {
        double weight = 1.0;
        for (Eigen::Index j = first; j < first + count; ++j)
        {
            if (j != i)
            {
                weight *= (x - static_cast<double>(j)) / static_cast<double>(i - j);
            }
        }
        weights(i) = weight;
    }
    return weights;
}

} // namespace clepsydra::identification
