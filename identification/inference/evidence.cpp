#include "inference/evidence.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clepsydra::identification
{

namespace
{

constexpr int points = 200;    // of the integral over an amplitude
constexpr int pairPoints = 40; // along each of two
constexpr double meanSquareOfUniform = 1.0 / 3.0;

double logMeanExp(const std::vector<double>& values)
{
    const double largest = *std::max_element(values.begin(), values.end());
    double sum = 0.0;
    for (const double value : values)
    {
        sum += std::exp(value - largest);
    }
    return largest + std::log(sum / static_cast<double>(values.size()));
}

/// Middles of equal parts of an interval, by number.
double middle(int point, int count, double lower, double upper)
{
    return lower + (upper - lower) * (point + 0.5) / count;
}

double logDeterminant(const Eigen::LLT<Eigen::MatrixXd>& root)
{
    return 2.0 * root.matrixLLT().diagonal().array().log().sum();
}

} // namespace

double logLikelihood(double misfit, double nu, Eigen::Index rows)
{
    return -(nu + static_cast<double>(rows)) / 2.0 * std::log1p(misfit / nu);
}

double effectiveDegreesOfFreedom(const Noise& noise)
{
    // A simulator without noise has no covariance to estimate.
    return noise.simulation.nu > 0.0 ? std::min(noise.data.nu, noise.simulation.nu) : noise.data.nu;
}

double intervalSds(const Noise& noise)
{
    // Cornish-Fisher expansion of Student's quantile; within .3 % from 5 degrees of freedom on.
    const double z = 1.959964;
    const double nu = effectiveDegreesOfFreedom(noise);
    return z + (std::pow(z, 3) + z) / (4.0 * nu)
           + (5.0 * std::pow(z, 5) + 16.0 * std::pow(z, 3) + 3.0 * z) / (96.0 * nu * nu);
}

double nullEvidence(const ResidualProblem& problem, const Noise& noise)
{
    return logLikelihood(
        Fits(whitened(problem, noise)).nullMisfit(), effectiveDegreesOfFreedom(noise), problem.residual.size());
}

Score score(const ResidualProblem& problem, const Noise& noise, Eigen::Index effect, const Bounds& bounds,
    double anchorAmplitude, bool fixed)
{
    const double nu = effectiveDegreesOfFreedom(noise);
    const double lower = (fixed ? 1.0 : bounds.lower) - anchorAmplitude;
    const double upper = (fixed ? 1.0 : bounds.upper) - anchorAmplitude;
    const WhiteProblem plain = whitened(problem, noise);
    Eigen::VectorXd steps = Eigen::VectorXd::Zero(problem.effectColumns.cols());
    steps(effect) = Fits(plain).effect(effect, lower, upper).amplitude;
    const WhiteProblem widened = whitened(problem, noise, steps);
    const double widening = 0.5 * (widened.logDeterminant - plain.logDeterminant);
    const Fits fits(widened);
    const auto fit = fits.effect(effect, lower, upper);

    Score result;
    result.amplitude = anchorAmplitude + fit.amplitude;
    result.sd = fixed ? 0.0 : fit.sd;
    result.misfit = fit.misfit;
    result.parameterShift = fits.parameterShift(effect, fit.amplitude);
    if (fixed)
    {
        result.logEvidence = logLikelihood(fit.misfit, nu, problem.residual.size()) - widening;
        return result;
    }
    std::vector<double> along(points);
    for (int point = 0; point < points; ++point)
    {
        const double away = (middle(point, points, lower, upper) - fit.free) / fit.sd;
        along[static_cast<std::size_t>(point)] =
            logLikelihood(fit.freeMisfit + away * away, nu, problem.residual.size());
    }
    result.logEvidence = logMeanExp(along) - widening;
    return result;
}

double otherEvidence(const ResidualProblem& problem, const Noise& noise)
{
    const WhiteProblem white = whitened(problem, noise);
    const Eigen::Index rows = problem.residual.size();
    const Eigen::MatrixXd& j = white.parameters;

    // Covariance of the residual in units of the noise: noise, and a pattern. Half of a pattern's variance goes together
    // over features and conditions as that of the library's effects does, the other half is independent in each.
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(white.residual.size(), white.residual.size());
    if (white.effects.cols() > 0)
    {
        const Eigen::MatrixXd together =
            meanSquareOfUniform / static_cast<double>(white.effects.cols()) * white.effects * white.effects.transpose();
        covariance += 0.5 * together;
        covariance.diagonal() += 0.5 * together.diagonal();
    }
    const Eigen::LLT<Eigen::MatrixXd> root(covariance);
    const Eigen::VectorXd residual = root.matrixL().solve(white.residual);
    const Eigen::MatrixXd parameters = root.matrixL().solve(j);
    const Eigen::LLT<Eigen::MatrixXd> before(j.transpose() * j);
    const Eigen::LLT<Eigen::MatrixXd> after(parameters.transpose() * parameters);
    const double misfit = (residual - parameters * after.solve(parameters.transpose() * residual)).squaredNorm();
    const double occam = -0.5 * (logDeterminant(root) + logDeterminant(after) - logDeterminant(before));
    return logLikelihood(misfit, effectiveDegreesOfFreedom(noise), rows) + occam;
}

namespace
{

/// Where the two amplitudes of a pair may be, as steps from the anchor.
struct Square
{
    Bounds first;
    Bounds second;
};

/// A pair's score among effects in white noise. \param widening  half the log of what the noise was widened by
PairScore pairScore(const Fits& fits, Eigen::Index first, Eigen::Index second, const Square& steps, double nu,
    Eigen::Index rows, double widening)
{
    const Eigen::MatrixXd columns = fits.effectsLeft()(Eigen::all, std::vector<Eigen::Index>{first, second});
    const Eigen::Matrix2d products = columns.transpose() * columns;
    const Eigen::Vector2d with = columns.transpose() * fits.residualLeft();
    PairScore pair{first, second, 0.0, 0.0, std::numeric_limits<double>::infinity(), 0.0, {}};
    std::vector<double> likelihoods;
    for (int k = 0; k < pairPoints; ++k)
    {
        for (int l = 0; l < pairPoints; ++l)
        {
            const Eigen::Vector2d step(middle(k, pairPoints, steps.first.lower, steps.first.upper),
                middle(l, pairPoints, steps.second.lower, steps.second.upper));
            const double misfit = fits.nullMisfit() - 2.0 * step.dot(with) + step.dot(products * step);
            likelihoods.push_back(logLikelihood(std::max(misfit, 0.0), nu, rows));
            if (misfit < pair.misfit)
            {
                pair.misfit = misfit;
                pair.firstAmplitude = step(0);
                pair.secondAmplitude = step(1);
            }
        }
    }
    pair.logEvidence = logMeanExp(likelihoods) - widening;
    pair.parameterShift = fits.parameterShift(first, pair.firstAmplitude)
                          + fits.parameterShift(second, pair.secondAmplitude) - fits.parameterShift();
    return pair;
}

} // namespace

std::vector<PairScore> pairScores(const ResidualProblem& problem, const Noise& noise, const std::vector<Bounds>& bounds,
    const std::vector<bool>& fixed, const Eigen::VectorXd& anchor)
{
    const double nu = effectiveDegreesOfFreedom(noise);
    const auto rows = problem.residual.size();
    const WhiteProblem plain = whitened(problem, noise);
    const Fits fits(plain);
    const auto range = [&](Eigen::Index e) {
        const auto i = static_cast<std::size_t>(e);
        return fixed[i] ? Bounds{1.0 - anchor(e), 1.0 - anchor(e)}
                        : Bounds{bounds[i].lower - anchor(e), bounds[i].upper - anchor(e)};
    };

    std::vector<PairScore> all;
    for (Eigen::Index second = 0; second < problem.effectColumns.cols(); ++second)
    {
        for (Eigen::Index first = 0; first < second; ++first)
        {
            const Square steps{range(first), range(second)};
            const PairScore sharp = pairScore(fits, first, second, steps, nu, rows, 0.0);
            const ResidualProblem two = problem.withEffects({first, second});
            const WhiteProblem widened =
                whitened(two, noise, Eigen::Vector2d(sharp.firstAmplitude, sharp.secondAmplitude));
            const double widening = 0.5 * (widened.logDeterminant - plain.logDeterminant);
            PairScore pair = pairScore(Fits(widened), 0, 1, steps, nu, rows, widening);
            pair.first = first;
            pair.second = second;
            pair.firstAmplitude += anchor(first);
            pair.secondAmplitude += anchor(second);
            all.push_back(pair);
        }
    }
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.logEvidence > b.logEvidence; });
    return all;
}

} // namespace clepsydra::identification
