#include "inference/evidence.h"

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

/// From the anchor, where an effect's amplitude may go. \param fixed  an effect that is on or off: to amplitude 1
Bounds stepsFrom(double anchor, const Bounds& bounds, bool fixed)
{
    return fixed ? Bounds{1.0 - anchor, 1.0 - anchor} : Bounds{bounds.lower - anchor, bounds.upper - anchor};
}

/// What a wider noise takes off the log-likelihood.
double widening(const WhiteProblem& widened, const WhiteProblem& plain)
{
    return 0.5 * (widened.logDeterminant - plain.logDeterminant);
}

/// Of two effects, over a grid of their steps.
class PairGrid
{
public:
    PairGrid(
        const Fits& fits, Eigen::Index first, Eigen::Index second, const Bounds& firstSteps, const Bounds& secondSteps)
        : misfits_(pairPoints, pairPoints)
    {
        const Eigen::MatrixXd columns = fits.effectsLeft()(Eigen::all, std::vector<Eigen::Index>{first, second});
        const Eigen::Matrix2d products = columns.transpose() * columns;
        const Eigen::Vector2d with = columns.transpose() * fits.residualLeft();
        double best = std::numeric_limits<double>::infinity();
        for (int k = 0; k < pairPoints; ++k)
        {
            for (int l = 0; l < pairPoints; ++l)
            {
                const Eigen::Vector2d step(middle(k, pairPoints, firstSteps.lower, firstSteps.upper),
                    middle(l, pairPoints, secondSteps.lower, secondSteps.upper));
                const double misfit = fits.nullMisfit() - 2.0 * step.dot(with) + step.dot(products * step);
                misfits_(k, l) = misfit;
                if (misfit < best)
                {
                    best = misfit;
                    best_ = step;
                }
            }
        }
    }

    double leastMisfit() const
    {
        return misfits_.minCoeff();
    }

    const Eigen::Vector2d& bestSteps() const
    {
        return best_;
    }

    double logEvidence(double nu, Eigen::Index rows) const
    {
        std::vector<double> likelihoods;
        likelihoods.reserve(static_cast<std::size_t>(misfits_.size()));
        for (const double misfit : misfits_.reshaped<Eigen::RowMajor>())
        {
            likelihoods.push_back(logLikelihood(std::max(misfit, 0.0), nu, rows));
        }
        return logMeanExp(likelihoods);
    }

private:
    Eigen::MatrixXd misfits_;
    Eigen::Vector2d best_ = Eigen::Vector2d::Zero();
};

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
    const auto [lower, upper] = stepsFrom(anchorAmplitude, bounds, fixed);
    const WhiteProblem plain = whitened(problem, noise);
    Eigen::VectorXd steps = Eigen::VectorXd::Zero(problem.effectColumns.cols());
    steps(effect) = Fits(plain).effect(effect, lower, upper).amplitude;
    const WhiteProblem widened = whitened(problem, noise, steps);
    const Fits fits(widened);
    const auto fit = fits.effect(effect, lower, upper);

    Score result;
    result.amplitude = anchorAmplitude + fit.amplitude;
    result.sd = fixed ? 0.0 : fit.sd;
    result.misfit = fit.misfit;
    result.parameterShift = fits.parameterShift(effect, fit.amplitude);
    if (fixed)
    {
        result.logEvidence = logLikelihood(fit.misfit, nu, problem.residual.size()) - widening(widened, plain);
        return result;
    }
    std::vector<double> along(points);
    for (int point = 0; point < points; ++point)
    {
        const double away = (middle(point, points, lower, upper) - fit.free) / fit.sd;
        along[static_cast<std::size_t>(point)] =
            logLikelihood(fit.freeMisfit + away * away, nu, problem.residual.size());
    }
    result.logEvidence = logMeanExp(along) - widening(widened, plain);
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

std::vector<PairScore> pairScores(const ResidualProblem& problem, const Noise& noise, const std::vector<Bounds>& bounds,
    const std::vector<bool>& fixed, const Eigen::VectorXd& anchor)
{
    const double nu = effectiveDegreesOfFreedom(noise);
    const auto rows = problem.residual.size();
    const WhiteProblem plain = whitened(problem, noise);
    const Fits fits(plain);
    const auto steps = [&](Eigen::Index e) {
        const auto i = static_cast<std::size_t>(e);
        return stepsFrom(anchor(e), bounds[i], fixed[i]);
    };

    std::vector<PairScore> all;
    for (Eigen::Index second = 0; second < problem.effectColumns.cols(); ++second)
    {
        for (Eigen::Index first = 0; first < second; ++first)
        {
            const PairGrid sharp(fits, first, second, steps(first), steps(second));
            const WhiteProblem widened = whitened(problem.withEffects({first, second}), noise, sharp.bestSteps());
            const Fits two(widened);
            const PairGrid grid(two, 0, 1, steps(first), steps(second));
            const Eigen::Vector2d& best = grid.bestSteps();
            all.push_back({first, second, anchor(first) + best(0), anchor(second) + best(1), grid.leastMisfit(),
                grid.logEvidence(nu, rows) - widening(widened, plain),
                two.parameterShift(0, best(0)) + two.parameterShift(1, best(1)) - two.parameterShift()});
        }
    }
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.logEvidence > b.logEvidence; });
    return all;
}

} // namespace clepsydra::identification
