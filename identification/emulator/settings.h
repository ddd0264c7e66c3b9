#pragma once

#include "runner/simulator.h"

#include <Eigen/Core>

#include <vector>

namespace clepsydra::identification
{

/// Parameters in sd of their priors, from the priors' means, and back, within their limits.
Eigen::VectorXd inSds(const Study& study, const Eigen::VectorXd& parameters);
Eigen::VectorXd physical(const Study& study, const Eigen::VectorXd& inSds);

/// Features of the simulations of one condition, a row each.
Eigen::MatrixXd featureRows(const std::vector<Simulation>& simulations, std::size_t condition, Eigen::Index features);

} // namespace clepsydra::identification
