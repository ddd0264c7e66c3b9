#include "heldOut/predictive.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>

namespace clepsydra::identification
{

Eigen::MatrixXd discrepancySlopes(const Eigen::MatrixXd& coordinates, const Eigen::VectorXd& residual,
    const Eigen::MatrixXd& covariance, double variance)
{
    const Eigen::Index training = residual.size();
    const auto trained = coordinates.topRows(training);
    const Eigen::RowVectorXd centre = trained.colwise().mean();
    const Eigen::RowVectorXd sd = ((trained.rowwise() - centre).colwise().squaredNorm()
                                   / static_cast<double>(std::max<Eigen::Index>(training - 1, 1)))
                                      .cwiseSqrt();
    const Eigen::MatrixXd points =
        (coordinates.rowwise() - centre).array().rowwise() / (sd.array() > 0.0).select(sd.array(), 1.0);
    Eigen::MatrixXd squares(points.rows(), points.rows());
    for (Eigen::Index i = 0; i < points.rows(); ++i)
    {
        squares.row(i) = (points.rowwise() - points.row(i)).rowwise().squaredNorm();
    }
    Eigen::MatrixXd best = Eigen::MatrixXd::Zero(points.rows(), points.rows());
    double highest = -std::numeric_limits<double>::infinity();
    for (const double length : {0.3, 0.5, 0.8, 1.2, 2.0, 3.5, 6.0, 10.0})
    {
        const Eigen::MatrixXd correlation = (squares.array() / (-2.0 * length * length)).exp();
        for (const double share : {0.0, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0})
        {
            const Eigen::LLT<Eigen::MatrixXd> root(
                covariance + share * variance * correlation.topLeftCorner(training, training));
            const double likelihood =
                -0.5 * root.matrixL().solve(residual).squaredNorm() - root.matrixLLT().diagonal().array().log().sum();
            if (likelihood > highest)
            {
                highest = likelihood;
                best = share * variance * correlation;
            }
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(best);
    return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

} // namespace clepsydra::identification
