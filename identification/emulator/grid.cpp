#include "emulator/grid.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

Grid::Grid(const Effect& effect, const std::vector<double>& added)
    : amplitudes(Eigen::VectorXd::Ones(1))
{
    if (!effect.isSwitch)
    {
        constexpr double steps = 8.0; // between amplitude 0 and the end of the range that is farther from it
        const double step = effect.bounds.reach() / steps;
        const double below = std::ceil(-effect.bounds.lower / step - 1e-9);
        const double above = std::ceil(effect.bounds.upper / step - 1e-9);
        const auto equidistant = static_cast<Eigen::Index>(below + above) + 1;
        amplitudes.resize(equidistant + static_cast<Eigen::Index>(added.size()));
        amplitudes.head(equidistant) = Eigen::VectorXd::LinSpaced(equidistant, -below * step, above * step);
        std::copy(added.begin(), added.end(), amplitudes.begin() + equidistant);
        std::sort(amplitudes.begin(), amplitudes.end());
    }
    const Eigen::Index count = std::min<Eigen::Index>(4, amplitudes.size());
    scales.setOnes(count, amplitudes.size() - count + 1);
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
}

Eigen::MatrixXd Grid::weightsAt(const Eigen::VectorXd& at) const
{
    const Eigen::Index count = scales.rows();
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(at.size(), amplitudes.size());
    for (Eigen::Index row = 0; row < at.size(); ++row)
    {
        const Eigen::Index above = std::upper_bound(amplitudes.begin(), amplitudes.end(), at(row)) - amplitudes.begin();
        const Eigen::Index first = std::clamp<Eigen::Index>(above - 2, 0, amplitudes.size() - count);
        for (Eigen::Index i = 0; i < count; ++i)
        {
            double weight = scales(i, first);
            for (Eigen::Index j = 0; j < count; ++j)
            {
                weight *= j == i ? 1.0 : at(row) - amplitudes(first + j);
            }
            weights(row, first + i) = weight;
        }
    }
    return weights;
}

} // namespace clepsydra::identification
