#include "emulator/grid.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

Grid::Grid(const Effect& effect, const std::vector<double>& added)
{
    if (effect.isSwitch)
    {
        amplitudes_ = Eigen::VectorXd::Ones(1);
        scales_ = Eigen::MatrixXd::Ones(1, 1);
        return;
    }
    constexpr double steps = 8.0; // between amplitude 0 and the end of the range that is farther from it
    const auto [lower, upper] = effect.bounds;
    const double step = effect.bounds.reach() / steps;
    const double below = std::ceil(-lower / step - 1e-9);
    const double above = std::ceil(upper / step - 1e-9);
    const auto equidistant = static_cast<Eigen::Index>(below + above) + 1;
    amplitudes_.resize(equidistant + static_cast<Eigen::Index>(added.size()));
    amplitudes_.head(equidistant) = Eigen::VectorXd::LinSpaced(equidistant, -below * step, above * step);
    std::copy(added.begin(), added.end(), amplitudes_.begin() + equidistant);
    std::sort(amplitudes_.begin(), amplitudes_.end());
    const Eigen::Index count = std::min<Eigen::Index>(4, amplitudes_.size());
    scales_ = Eigen::MatrixXd::Ones(count, amplitudes_.size() - count + 1);
    for (Eigen::Index first = 0; first < scales_.cols(); ++first)
    {
        for (Eigen::Index i = 0; i < count; ++i)
        {
            for (Eigen::Index j = 0; j < count; ++j)
            {
                scales_(i, first) /= j == i ? 1.0 : amplitudes_(first + i) - amplitudes_(first + j);
            }
        }
    }
}

Eigen::MatrixXd Grid::weightsAt(const Eigen::VectorXd& amplitudes) const
{
    const Eigen::Index nodes = amplitudes_.size();
    const Eigen::Index count = scales_.rows();
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(amplitudes.size(), nodes);
    for (Eigen::Index row = 0; row < amplitudes.size(); ++row)
    {
        const Eigen::Index above =
            std::upper_bound(amplitudes_.begin(), amplitudes_.end(), amplitudes(row)) - amplitudes_.begin();
        const Eigen::Index first = std::clamp<Eigen::Index>(above - 2, 0, nodes - count);
        for (Eigen::Index i = 0; i < count; ++i)
        {
            double weight = scales_(i, first);
            for (Eigen::Index j = 0; j < count; ++j)
            {
                weight *= j == i ? 1.0 : amplitudes(row) - amplitudes_(first + j);
            }
            weights(row, first + i) = weight;
        }
    }
    return weights;
}

} // namespace clepsydra::identification
