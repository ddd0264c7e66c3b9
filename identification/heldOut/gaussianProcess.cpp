#include "heldOut/gaussianProcess.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clepsydra::identification
{

namespace
{

Eigen::MatrixXd kernel(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double variance, double length)
{
    Eigen::MatrixXd k(a.rows(), b.rows());
    for (Eigen::Index i = 0; i < a.rows(); ++i)
    {
        k.row(i) = ((b.rowwise() - a.row(i)).rowwise().squaredNorm().array() / (-2.0 * length * length)).exp();
    }
    return variance * k;
}

} // namespace

GaussianProcess::GaussianProcess(
    const Eigen::MatrixXd& coordinates, const Eigen::VectorXd& values, const Eigen::VectorXd& noiseVariance)
    : centre_(coordinates.colwise().mean()),
      spread_(((coordinates.rowwise() - coordinates.colwise().mean()).colwise().squaredNorm()
               / std::max<double>(static_cast<double>(coordinates.rows()) - 1.0, 1.0))
                  .cwiseSqrt())
{
    spread_ = (spread_.array() > 0.0).select(spread_, 1.0);
    points_ = (coordinates.rowwise() - centre_).array().rowwise() / spread_.array();
    const double size = values.squaredNorm() / static_cast<double>(values.size());
    double best = -std::numeric_limits<double>::infinity();
    for (const double length : {0.3, 0.5, 0.8, 1.2, 2.0, 3.5, 6.0, 10.0})
    {
        for (const double share : {0.0, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0})
        {
            Eigen::MatrixXd covariance = kernel(points_, points_, share * size, length);
            covariance.diagonal() += noiseVariance;
            const Eigen::LLT<Eigen::MatrixXd> root(covariance);
            const Eigen::VectorXd weights = root.solve(values);
            const double likelihood = -0.5 * values.dot(weights) - root.matrixLLT().diagonal().array().log().sum();
            if (likelihood > best)
            {
                best = likelihood;
                weights_ = weights;
                inverse_ = root.solve(Eigen::MatrixXd::Identity(values.size(), values.size()));
                variance_ = share * size;
                length_ = length;
            }
        }
    }
}

GaussianProcess::Value GaussianProcess::operator()(const Eigen::VectorXd& coordinates) const
{
    const Eigen::MatrixXd at = (coordinates.transpose() - centre_).array() / spread_.array();
    const Eigen::VectorXd k = kernel(points_, at, variance_, length_);
    return {k.dot(weights_), std::max(0.0, variance_ - k.dot(inverse_ * k))};
}

} // namespace clepsydra::identification
