#pragma once

#include "inference/residualProblem.h"
#include "inference/significance.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// What data of a certain size could tell, before there are any.
struct Identifiability
{
    Eigen::VectorXd
        masked; // per effect: share of its signal (in units of noise, squared) that the parameters can imitate
    Eigen::VectorXd signal;             // size at amplitude 1 of what they cannot imitate, in standard deviations
    Eigen::VectorXd smallestDetectable; // amplitude seen in 80 % of the cases; infinite where masked
    Eigen::MatrixXd separability; // i, j: standard deviations by which effect i at amplitude 1 differs from effect j
                                  // at any amplitude
    Eigen::MatrixXd
        collinearity; // of pairs: 1/sqrt(1 - |cos|); above about 10 the two are one (Brun, Reichert & Kuensch,
                      // Water Resour. Res. 37, 1015 (2001))
    double collinearityOfAll = 0.0; // of parameters and all effects together
};

/// \param critical  best gain D that counts as significant, see Significance
Identifiability identifiability(
    const ResidualProblem& problem, const Noise& noise, const std::vector<Bounds>& bounds, double critical);

/// Pairs that these data could not tell apart: closer than `sds`.
std::vector<std::pair<std::size_t, std::size_t>> lookAlikes(const Identifiability& table, double sds);

} // namespace clepsydra::identification
