#pragma once

#include "emulator/conditionEmulator.h"
#include "emulator/library.h"

#include <Eigen/Core>

#include <vector>

namespace clepsydra::identification
{

/// Parameters standardised with their priors' means and standard deviations; `physical` converts back and clips to the
/// parameters' ranges.
Eigen::VectorXd inSds(const Study& study, const Eigen::VectorXd& parameters);
Eigen::VectorXd physical(const Study& study, const Eigen::VectorXd& inSds);

/// The setting with these effects. \param inSds  parameters, standardised
Setting settingOf(
    const StudySimulator& studySimulator, const Eigen::VectorXd& inSds, const std::vector<Present>& present);

/// Features of the simulations of one condition, one simulation per row.
Eigen::MatrixXd featureRows(const std::vector<Simulation>& simulations, std::size_t condition, Eigen::Index features);

/// Groups of equal settings, as indices in `settings`.
std::vector<std::vector<Eigen::Index>> repeatsOf(const std::vector<Setting>& settings);

} // namespace clepsydra::identification
