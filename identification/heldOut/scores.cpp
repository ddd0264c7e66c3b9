#include "heldOut/scores.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

/// Independent standard normal numbers.
Eigen::MatrixXd normals(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

} // namespace

std::vector<Eigen::MatrixXd> drawDataNoise(const std::vector<HeldOutData>& data,
    const std::vector<Prediction>& predictions, int draws, std::mt19937_64& random)
{
    const Eigen::MatrixXd common = normals(draws, data.front().errorSlopes.cols(), random);
    std::vector<Eigen::MatrixXd> noise;
    for (std::size_t c = 0; c < data.size(); ++c)
    {
        Eigen::MatrixXd covariance = predictions[c].dataCovariance.cwiseProduct(data[c].meanShare);
        covariance.diagonal().array() += data[c].declaredVariance.array() + 1e-14;
        const Eigen::MatrixXd root = covariance.llt().matrixL();
        Eigen::MatrixXd rows = common * data[c].errorSlopes.transpose();
        for (auto row : rows.rowwise())
        {
            row += (root * normals(covariance.rows(), 1, random)).transpose();
        }
        noise.push_back(rows);
    }
    return noise;
}

std::pair<Estimate, Eigen::ArrayXd> rmsError(const std::vector<HeldOutData>& data,
    const std::vector<Prediction>& predictions, const std::vector<std::vector<Eigen::Index>>& features,
    const std::vector<Eigen::MatrixXd>& noise, std::mt19937_64& random)
{
    double square = 0.0;
    Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(noise.front().rows());
    double count = 0.0;
    for (std::size_t c = 0; c < data.size(); ++c)
    {
        const Eigen::VectorXd error = data[c].mean - predictions[c].mean;
        for (const auto f : features[c])
        {
            const Eigen::ArrayXd ofSimulation =
                std::sqrt(predictions[c].variance(f)) * normals(squares.size(), 1, random).array();
            square += error(f) * error(f);
            squares += (error(f) + noise[c].col(f).array() - ofSimulation).square();
            count += 1.0;
        }
    }
    const Eigen::ArrayXd errors = (squares / count).sqrt();
    const double variance = (errors - errors.mean()).square().sum() / static_cast<double>(errors.size() - 1);
    return {{std::sqrt(square / count), std::sqrt(variance)}, errors};
}

} // namespace clepsydra::identification
