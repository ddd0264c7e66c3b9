#include "heldOut/predictive.h"

#include "emulator/distributions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Log density without the terms that are equal for all predictions of the same measurements.
class Density
{
public:
    explicit Density(const Predictive& predicted)
        : predicted_(predicted)
    {
        Eigen::MatrixXd covariance = predicted.covariance;
        // Exact numbers would make it singular.
        covariance.diagonal() += 1e-9 * covariance.diagonal() + Eigen::VectorXd::Constant(covariance.rows(), 1e-18);
        root_.compute(covariance);
    }

    double chiSquare(const Eigen::VectorXd& measured) const
    {
        return root_.matrixL().solve(measured - predicted_.mean).squaredNorm();
    }

    double operator()(const Eigen::VectorXd& measured) const
    {
        const double freedom = predicted_.freedom;
        return -root_.matrixLLT().diagonal().array().log().sum()
               - 0.5 * (freedom + static_cast<double>(measured.size())) * std::log1p(chiSquare(measured) / freedom);
    }

    Eigen::VectorXd draw(std::mt19937_64& random) const
    {
        const double factor =
            std::sqrt(predicted_.freedom / std::chi_squared_distribution<double>(predicted_.freedom)(random));
        const Eigen::VectorXd independent = normals(predicted_.mean.size(), 1, random);
        return predicted_.mean + root_.matrixL() * (factor * independent);
    }

private:
    const Predictive& predicted_;
    Eigen::LLT<Eigen::MatrixXd> root_;
};

} // namespace

Shared sharedAfter(const LinearModel& training, const Eigen::VectorXd& measured, const Eigen::VectorXd& fitted)
{
    const Eigen::MatrixXd& slopes = training.slopes;
    const Eigen::VectorXd residual = measured - training.mean + slopes * fitted;
    const Eigen::LLT<Eigen::MatrixXd> covariance(slopes * slopes.transpose() + training.rest);
    return {slopes.transpose() * covariance.solve(residual),
        Eigen::MatrixXd::Identity(slopes.cols(), slopes.cols()) - slopes.transpose() * covariance.solve(slopes)};
}

Predictive predict(const Shared& shared, const LinearModel& heldOut, const Eigen::VectorXd& fitted, double freedom)
{
    return {heldOut.mean + heldOut.slopes * (shared.mean - fitted),
        heldOut.slopes * shared.covariance * heldOut.slopes.transpose() + heldOut.rest, freedom};
}

double chiSquareOf(const Predictive& predicted, const Eigen::VectorXd& measured)
{
    return Density(predicted).chiSquare(measured);
}

double chanceOf(const Predictive& predicted, const Eigen::VectorXd& measured)
{
    const auto features = static_cast<double>(measured.size());
    return measured.size() == 0
               ? 1.0
               : std::max(leastPValue,
                   probabilityBeyondFisher(chiSquareOf(predicted, measured) / features, features, predicted.freedom));
}

LogRatio logRatio(
    const Predictive& one, const Predictive& other, const Eigen::VectorXd& measured, int draws, std::mt19937_64& random)
{
    const Density ofOne(one);
    const Density ofOther(other);
    const auto ratio = [&](const Eigen::VectorXd& values) { return ofOne(values) - ofOther(values); };
    LogRatio found;
    found.value = ratio(measured);
    // Two equal predictions differ by rounding errors only.
    const double least = found.value - 1e-9 * (1.0 + std::abs(found.value));
    int asLarge = 1; // the measured one is among them
    for (int draw = 0; draw < draws; ++draw)
    {
        asLarge += ratio(ofOther.draw(random)) >= least ? 1 : 0;
    }
    found.pValue = static_cast<double>(asLarge) / static_cast<double>(draws + 1);
    return found;
}

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
