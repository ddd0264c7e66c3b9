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
}

Eigen::RowVectorXd Grid::weightsAt(double amplitude) const
{
    const Eigen::Index nodes = amplitudes_.size();
    const Eigen::Index count = std::min<Eigen::Index>(4, nodes);
    const Eigen::Index above =
        std::upper_bound(amplitudes_.begin(), amplitudes_.end(), amplitude) - amplitudes_.begin();
    const Eigen::Index first = std::clamp<Eigen::Index>(above - 2, 0, nodes - count);
    Eigen::RowVectorXd weights = Eigen::RowVectorXd::Zero(nodes);
    for (Eigen::Index i = first; i < first + count; ++i)
    {
        double weight = 1.0;
        for (Eigen::Index j = first; j < first + count; ++j)
        {
            if (j != i)
            {
                weight *= (amplitude - amplitudes_(j)) / (amplitudes_(i) - amplitudes_(j));
            }
        }
        weights(i) = weight;
    }
    return weights;
}

} // namespace clepsydra::identification
