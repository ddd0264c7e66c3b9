#pragma once

#include "runner/studySimulator.h"

#include <vector>

namespace clepsydra::identification
{

/// Runs that show what the study's common errors do in a condition: those of entries, moved to either side.
std::vector<SimulationOrder> commonErrorOrders(const StudySimulator& studySimulator, std::size_t condition);

/// Change of each feature by one sd of each common error: features x errors, to first order; 0 where a curve lacks the
/// feature.
/// \param plain  runs without any effect; what the measuring chain's errors do is seen in the curves of that condition's
Eigen::MatrixXd commonErrorSlopes(
    StudySimulator& studySimulator, std::size_t condition, const std::vector<Simulation>& plain);

} // namespace clepsydra::identification
