#pragma once

#include "decision/calibration.h"

#include <Eigen/Core>

#include <random>
#include <utility>
#include <vector>

namespace clepsydra::identification
{

/// Which effects data with these numbers of repeats can show, from synthetic data.
struct Visibility
{
    // By effect:
    Eigen::VectorXd detected;   // amplitude that is detected in 80 % of the cases; infinite if it is beyond the range
    Eigen::VectorXd named;      // amplitude that is named correctly in 80 % of the cases; infinite if beyond the range
    Eigen::VectorXd atFullSize; // share of correct names at the largest amplitude
    /// Pairs of effects that look alike: at its largest amplitude, most sets of the first effect contain the second.
    std::vector<std::pair<std::size_t, std::size_t>> alike;
};

Visibility visibility(const Study& study, const Evidence& evidence, Replicas& replicas, const Calibration& calibration,
    const Measured& measured, std::mt19937_64& random);

} // namespace clepsydra::identification
