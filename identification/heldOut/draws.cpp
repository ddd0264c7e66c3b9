#include "heldOut/draws.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

Eigen::VectorXd normals(Eigen::Index count, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    Eigen::VectorXd draws(count);
    std::generate(draws.begin(), draws.end(), [&] { return normal(random); });
    return draws;
}

double quantile(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    const auto index = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1;
    return values[std::min(index, values.size() - 1)];
}

} // namespace clepsydra::identification
