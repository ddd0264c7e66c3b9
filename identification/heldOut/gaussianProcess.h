#pragma once

#include <Eigen/Core>

namespace clepsydra::identification
{

/// Gaussian process through noisy residuals as a function of the conditions' coordinates: the prediction of a
/// discrepancy without a physical cause (Kennedy & O'Hagan, J. R. Stat. Soc. B 63, 425 (2001)). The kernel is squared
/// exponential with one length for all coordinates, which are scaled by their standard deviations. Variance and length
/// maximise the likelihood on a grid.
class GaussianProcess
{
public:
    /// \param coordinates  one point per row
    /// \param values, noiseVariance  of each point
    GaussianProcess(
        const Eigen::MatrixXd& coordinates, const Eigen::VectorXd& values, const Eigen::VectorXd& noiseVariance);

    struct Value
    {
        double mean;
        double variance;
    };
    Value operator()(const Eigen::VectorXd& coordinates) const;

private:
    Eigen::RowVectorXd centre_;
    Eigen::RowVectorXd spread_;
    Eigen::MatrixXd points_;
    Eigen::VectorXd weights_; // product of the inverse covariance and the values
    Eigen::MatrixXd inverse_;
    double variance_ = 0.0;
    double length_ = 1.0;
};

} // namespace clepsydra::identification
