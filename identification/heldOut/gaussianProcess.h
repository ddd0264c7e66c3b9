#pragma once

#include <Eigen/Core>

namespace clepsydra::identification
{

/// A discrepancy without a physical cause: a Gaussian process over the conditions' coordinates (Kennedy & O'Hagan,
/// J. R. Stat. Soc. B 63, 425 (2001)). The kernel is squared exponential with one length for all coordinates, which are
/// scaled by their standard deviations. Variance and length maximise the likelihood of the training data on a grid.
/// \param coordinates  one point per row: first the training data, then the points of the prediction
/// \param residual, covariance  of the training data without the process
/// \param variance  scale of the process' variance
/// \return  slopes at all points with respect to independent shared quantities of variance 1, as `LinearModel` has them
Eigen::MatrixXd discrepancySlopes(const Eigen::MatrixXd& coordinates, const Eigen::VectorXd& residual,
    const Eigen::MatrixXd& covariance, double variance);

} // namespace clepsydra::identification
