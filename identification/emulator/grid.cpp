#include "emulator/grid.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

Eigen::VectorXd amplitudesOf(const Effect& effect, const std::vector<double>& added)
{
    if (effect.isSwitch)
    {
        return Eigen::VectorXd::Ones(1);
    }
    constexpr double steps = 8.0; // between amplitude 0 and the end of the range that is farther from it
    const auto [lower, upper] = effect.bounds;
    const double step = effect.bounds.reach() / steps;
    const double below = std::ceil(-lower / step - 1e-9);
    const double above = std::ceil(upper / step - 1e-9);
    const auto equidistant = static_cast<Eigen::Index>(below + above) + 1;
    Eigen::VectorXd amplitudes(equidistant + static_cast<Eigen::Index>(added.size()));
    amplitudes.head(equidistant) = Eigen::VectorXd::LinSpaced(equidistant, -below * step, above * step);
    std::copy(added.begin(), added.end(), amplitudes.begin() + equidistant);
    std::sort(amplitudes.begin(), amplitudes.end());
    return amplitudes;
}

Eigen::MatrixXd scalesOf(const Eigen::VectorXd& amplitudes)
{
    const Eigen::Index count = std::min<Eigen::Index>(4, amplitudes.size());
    Eigen::MatrixXd scales = Eigen::MatrixXd::Ones(count, amplitudes.size() - count + 1);
    for (Eigen::Index first = 0; first < scales.cols(); ++first)
    {
        for (Eigen::Index i = 0; i < count; ++i)
        {
            for (Eigen::Index j = 0; j < count; ++j)
            {
                scales(i, first) /= j == i ? 1.0 : amplitudes(first + i) - amplitudes(first + j);
            }
        }
    }
    return scales;
}

} // namespace

Grid::Grid(const Effect& effect, const std::vector<double>& added)
    : amplitudes_(amplitudesOf(effect, added)),
      scales_(scalesOf(amplitudes_))
{}

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
