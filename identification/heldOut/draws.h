#pragma once

#include <Eigen/Core>

#include <random>
#include <vector>

namespace clepsydra::identification
{

/// Independent standard normal numbers.
Eigen::VectorXd normals(Eigen::Index count, std::mt19937_64& random);

/// The smallest of the values that has at least this share of them at or below it. \param share  above 0, at most 1
double quantile(std::vector<double> values, double share);

} // namespace clepsydra::identification
