#include "emulator/covariance.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

constexpr double enoughPerFeature = 8.0;

/// Correlations that are estimated from different pairs of values need not be consistent with each other: negative
/// eigenvalues are replaced by a small positive one.
void makePositiveDefinite(Eigen::MatrixXd& matrix)
{
    if (matrix.llt().info() == Eigen::Success)
    {
        return;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
    const double smallest = 1e-9 * std::max(eigen.eigenvalues().maxCoeff(), 1e-300);
    matrix =
        eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(smallest).asDiagonal() * eigen.eigenvectors().transpose();
}

} // namespace

void Scatter::add(const Eigen::MatrixXd& repeats)
{
    if (repeats.rows() < 2)
    {
        return;
    }
    Eigen::MatrixXd deviations = repeats;
    double most = 0.0;
    for (auto column : deviations.colwise())
    {
        const double count = static_cast<double>(column.array().isFinite().count());
        const double mean = column.array().isFinite().select(column, 0.0).sum() / std::max(count, 1.0);
        // A single value has no deviation from its mean and would count as a repeat without scatter.
        const double scale = count > 1.0 ? std::sqrt(count / (count - 1.0)) : std::nan("");
        column = (column.array() - mean) * scale;
        most = std::max(most, count);
    }
    deviations_.conservativeResize(deviations_.rows() + deviations.rows(), deviations.cols());
    deviations_.bottomRows(deviations.rows()) = deviations;
    nu_ += std::max(most - 1.0, 0.0);
}

Covariance pooledCovariance(const Eigen::MatrixXd& deviations, double nu)
{
    const Eigen::Index features = deviations.cols();
    Covariance result{Eigen::MatrixXd::Zero(features, features), nu, 0.0};
    double variances = 0.0; // sum of the variances of the correlations
    double squares = 0.0;   // sum of the squares of the correlations
    Eigen::MatrixXd& s = result.matrix;
    const auto mean = [](const Eigen::ArrayXd& x, double& count) {
        count = static_cast<double>(x.isFinite().count());
        return count > 0.0 ? x.isFinite().select(x, 0.0).sum() / count : 0.0;
    };
    double count = 0.0;
    for (Eigen::Index i = 0; i < features; ++i)
    {
        s(i, i) = mean(deviations.col(i).array().square(), count);
    }
    for (Eigen::Index i = 0; i < features; ++i)
    {
        for (Eigen::Index j = 0; j < i; ++j)
        {
            const double scale = std::sqrt(s(i, i) * s(j, j));
            const Eigen::ArrayXd products = deviations.col(i).array() * deviations.col(j).array();
            s(i, j) = s(j, i) = mean(products, count);
            if (scale > 0.0 && count > 1.0)
            {
                const double r = s(i, j) / scale;
                variances += (mean((products / scale).square(), count) - r * r) / (count - 1.0);
                squares += r * r;
            }
        }
    }
    if (nu < enoughPerFeature * static_cast<double>(features) && squares > 0.0)
    {
        result.shrinkage = std::clamp(variances / squares, 0.0, 1.0);
        const Eigen::VectorXd diagonal = s.diagonal();
        s *= 1.0 - result.shrinkage;
        s.diagonal() = diagonal;
    }
    if (!s.isZero())
    {
        makePositiveDefinite(s);
    }
    return result;
}

} // namespace clepsydra::identification
