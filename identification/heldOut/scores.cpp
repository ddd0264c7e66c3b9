#include "heldOut/scores.h"

#include "lists.h"
#include "study/measurements.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

constexpr double pi = 3.14159265358979323846;

/// Independent standard normal numbers.
Eigen::MatrixXd normals(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

double sdOf(const std::vector<double>& values)
{
    const Eigen::Map<const Eigen::ArrayXd> all(values.data(), values.size());
    return std::sqrt((all - all.mean()).square().sum() / static_cast<double>(values.size() - 1));
}

/// Root mean square error and mean CRPS after shifts of the measured and of the predicted means.
std::pair<double, double> scoresOf(const std::vector<HeldOutData>& data, const std::vector<Prediction>& predictions,
    const std::vector<std::vector<Eigen::Index>>& features, const std::vector<Eigen::VectorXd>& dataShift,
    const std::vector<Eigen::VectorXd>& predictionShift)
{
    double squares = 0.0;
    double count = 0.0;
    double crps = 0.0;
    double measurements = 0.0;
    for (std::size_t c = 0; c < data.size(); ++c)
    {
        const Eigen::VectorXd measured = meanFeatures(data[c].features);
        for (const auto f : features[c])
        {
            const double shift = dataShift[c](f) - predictionShift[c](f);
            const double error = measured(f) - predictions[c].mean(f) + shift;
            squares += error * error;
            count += 1.0;
            const double sd = std::sqrt(predictions[c].variance(f) + predictions[c].dataCovariance(f, f)
                                        + data[c].declaredVariance(f) + data[c].commonVariance(f));
            for (const double value : data[c].features.col(f))
            {
                if (std::isfinite(value))
                {
                    crps += crpsOfNormal(predictions[c].mean(f), sd, value + shift);
                    measurements += 1.0;
                }
            }
        }
    }
    return {std::sqrt(squares / count), crps / measurements};
}

} // namespace

double crpsOfNormal(double mean, double sd, double observed)
{
    if (sd <= 0.0)
    {
        return std::abs(observed - mean);
    }
    const double z = (observed - mean) / sd;
    const double cumulative = 0.5 * std::erfc(-z / std::sqrt(2.0));
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * pi);
    return sd * (z * (2.0 * cumulative - 1.0) + 2.0 * density - 1.0 / std::sqrt(pi));
}

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

HeldOutScore heldOutScore(const std::vector<HeldOutData>& data, const std::vector<Prediction>& predictions,
    const std::vector<std::vector<Eigen::Index>>& features, const std::vector<Eigen::MatrixXd>& noise,
    std::mt19937_64& random, std::vector<double>* samples)
{
    const auto none = mapped(
        predictions, [](const Prediction& one) -> Eigen::VectorXd { return Eigen::VectorXd::Zero(one.mean.size()); });
    HeldOutScore score;
    std::tie(score.rmsLogError.value, score.crps.value) = scoresOf(data, predictions, features, none, none);
    std::vector<double> errors;
    std::vector<double> crps;
    for (Eigen::Index draw = 0; draw < noise.front().rows(); ++draw)
    {
        std::vector<Eigen::VectorXd> dataShift;
        std::vector<Eigen::VectorXd> predictionShift;
        for (std::size_t c = 0; c < data.size(); ++c)
        {
            dataShift.emplace_back(noise[c].row(draw).transpose());
            predictionShift.emplace_back(
                predictions[c].variance.cwiseSqrt().cwiseProduct(normals(predictions[c].mean.size(), 1, random)));
        }
        const auto [error, rank] = scoresOf(data, predictions, features, dataShift, predictionShift);
        errors.push_back(error);
        crps.push_back(rank);
    }
    score.rmsLogError.standardError = sdOf(errors);
    score.crps.standardError = sdOf(crps);
    if (samples != nullptr)
    {
        *samples = errors;
    }
    return score;
}

} // namespace clepsydra::identification
