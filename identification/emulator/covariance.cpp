#include "emulator/covariance.h"

#include "study/measurements.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

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
    const Eigen::RowVectorXd counts = repeats.array().isFinite().cast<double>().colwise().sum();
    // A single value has no deviation from its mean and would count as a repeat without scatter.
    const Eigen::RowVectorXd scales =
        counts.unaryExpr([](double count) { return count > 1.0 ? std::sqrt(count / (count - 1.0)) : std::nan(""); });
    deviations.conservativeResize(deviations.rows() + repeats.rows(), repeats.cols());
    deviations.bottomRows(repeats.rows()) =
        (repeats.rowwise() - meanFeatures(repeats).transpose()) * scales.asDiagonal();
    freedom += std::max(counts.maxCoeff() - 1.0, 0.0);
}

Covariance pooledCovariance(const Scatter& scatter)
{
    const Eigen::MatrixXd& deviations = scatter.deviations;
    const Eigen::Index features = deviations.cols();
    Covariance result{Eigen::MatrixXd::Zero(features, features), scatter.freedom};
    double variances = 0.0; // sum of the variances of the correlations
    double squares = 0.0;   // sum of the squares of the correlations
    Eigen::MatrixXd& s = result.matrix;
    double count = 0.0;
    const auto mean = [&](const Eigen::ArrayXd& x) {
        count = static_cast<double>(x.isFinite().count());
        return count > 0.0 ? x.isFinite().select(x, 0.0).sum() / count : 0.0;
    };
    for (Eigen::Index i = 0; i < features; ++i)
    {
        s(i, i) = mean(deviations.col(i).array().square());
        for (Eigen::Index j = 0; j < i; ++j)
        {
            const double scale = std::sqrt(s(i, i) * s(j, j));
            const Eigen::ArrayXd products = deviations.col(i).array() * deviations.col(j).array();
            s(i, j) = s(j, i) = mean(products);
            if (scale > 0.0 && count > 1.0)
            {
                const double r = s(i, j) / scale;
                variances += (mean((products / scale).square()) - r * r) / (count - 1.0);
                squares += r * r;
            }
        }
    }
    if (scatter.freedom < enoughPerFeature * static_cast<double>(features) && squares > 0.0)
    {
        const Eigen::VectorXd diagonal = s.diagonal();
        s *= 1.0 - std::clamp(variances / squares, 0.0, 1.0);
        s.diagonal() = diagonal;
    }
    if (!s.isZero())
    {
        makePositiveDefinite(s);
    }
    return result;
}

} // namespace clepsydra::identification
