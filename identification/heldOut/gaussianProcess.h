#pragma once

#include <Eigen/Core>

namespace clepsydra::identification
{

/// A smooth function of the conditions' coordinates through noisy residuals: what a discrepancy without a name would
/// predict (Kennedy & O'Hagan, J. R. Stat. Soc. B 63, 425 (2001)). Squared-exponential kernel, one length for all
/// coordinates (each scaled by its spread), size and length at their most likely values on a grid.
class GaussianProcess
{
public:
    /// \param coordinates  points by rows
    /// \param values, noiseVariance  by point
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
    Eigen::VectorXd weights_; // inverse covariance times values
    Eigen::MatrixXd inverse_;
    double variance_ = 0.0;
    double length_ = 1.0;
};

} // namespace clepsydra::identification
