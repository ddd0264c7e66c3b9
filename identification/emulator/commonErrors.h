#pragma once

#include "runner/studySimulator.h"

#include <vector>

namespace clepsydra::identification
{

/// Step of the finite differences of runs, in standard deviations of what is changed: large if runs scatter, for a better
/// ratio of signal to noise.
double differenceStep(const Study& study);

/// Runs with each common error of the entries at a positive and a negative value, for the slopes of the features.
std::vector<SimulationOrder> commonErrorOrders(const StudySimulator& studySimulator, std::size_t condition);

/// Change of each feature per standard deviation of each common error, to first order: features x errors. The slope is
/// 0 if the curve lacks the feature.
/// \param plain  runs without effects; errors of the measuring chain are applied to their curves
Eigen::MatrixXd commonErrorSlopes(
    StudySimulator& studySimulator, std::size_t condition, const std::vector<Simulation>& plain);

} // namespace clepsydra::identification
