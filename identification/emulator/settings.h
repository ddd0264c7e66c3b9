#pragma once

#include "emulator/library.h"

#include <Eigen/Core>

#include <vector>

namespace clepsydra::identification
{

/// Parameters in sd of their priors, from the priors' means, and back, within their limits.
Eigen::VectorXd inSds(const Study& study, const Eigen::VectorXd& parameters);
Eigen::VectorXd physical(const Study& study, const Eigen::VectorXd& inSds);

/// Features of the simulations of one condition, a row each.
Eigen::MatrixXd featureRows(const std::vector<Simulation>& simulations, std::size_t condition, Eigen::Index features);

/// Repeats of one setting, as lists of numbers in `settings`.
std::vector<std::vector<Eigen::Index>> repeatsOf(const std::vector<Setting>& settings);

/// What was simulated, before the measuring chain.
struct BeforeChain
{
    Setting setting;
    Eigen::VectorXd features;
};

BeforeChain beforeChain(const Study& study, const StudySimulator& studySimulator, const Run& run);

} // namespace clepsydra::identification
