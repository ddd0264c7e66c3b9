#pragma once

#include "decision/calibration.h"

#include <Eigen/Core>

#include <random>
#include <utility>
#include <vector>

namespace clepsydra::identification
{

/// What data of this size could tell, before there are any: from draws of the emulator.
struct Visibility
{
    Eigen::VectorXd detected; // per effect: amplitude that is seen in 80 % of the cases; infinite if none in its range
    Eigen::VectorXd named;    // and amplitude that gets its right name in 80 % of the cases
    Eigen::VectorXd atFullSize;                              // share of right names there
    std::vector<std::pair<std::size_t, std::size_t>> alike;  // the first's sets, at full size, mostly hold the second
};

Visibility visibility(const Study& study, const Evidence& evidence, Replicas& replicas, const Calibration& calibration,
    const Measured& measured, std::mt19937_64& random);

} // namespace clepsydra::identification
