#include "inference/significance.h"

#include "noise/draws.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

/// Share of `sorted` that is at least `value`; the observation itself counts as one of the draws.
double upperShare(const std::vector<double>& sorted, double value)
{
    const auto above = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), value);
    return (1.0 + static_cast<double>(above)) / (1.0 + static_cast<double>(sorted.size()));
}

/// Share of cases in which a pattern raises the misfit above a limit. \param misfits  without it
/// \param square  of the pattern in units of noise: with it a misfit m becomes m + square + 2 sqrt(square) z, z normal
double powerOf(double square, const std::vector<double>& misfits, double limit)
{
    double sum = 0.0;
    for (const double misfit : misfits)
    {
        sum += 0.5 * std::erfc((limit - misfit - square) / (2.0 * std::sqrt(2.0 * square)));
    }
    return sum / static_cast<double>(misfits.size());
}

/// Square of the pattern that is noticed in 80 % of the cases, by bisection.
double noticedSquare(const std::vector<double>& misfits, double limit)
{
    constexpr double wanted = 0.8;
    double lower = 1e-6;
    double upper = 1.0;
    while (powerOf(upper, misfits, limit) < wanted)
    {
        upper *= 2.0;
    }
    while (upper - lower > 1e-3 * upper)
    {
        const double middle = 0.5 * (lower + upper);
        (powerOf(middle, misfits, limit) < wanted ? lower : upper) = middle;
    }
    return upper;
}

} // namespace

ResidualProblem noiseOnly(const ResidualProblem& problem, const Noise& noise, std::mt19937_64& random)
{
    ResidualProblem drawn = problem;
    for (std::size_t block = 0; block < problem.blocks.size(); ++block)
    {
        const auto count = static_cast<Eigen::Index>(problem.blocks[block].features.size());
        drawn.residual.segment(problem.blocks[block].firstRow, count) =
            problem.covariance(block, noise).llt().matrixL() * normals(count, random);
    }
    drawn.parameterOffset = normals(problem.parameterOffset.size(), random);
    return drawn;
}

std::pair<double, double> testStatistics(const Fits& fits, const std::vector<Bounds>& bounds)
{
    double best = fits.nullMisfit();
    for (std::size_t e = 0; e < bounds.size(); ++e)
    {
        best = std::min(best, fits.effect(static_cast<Eigen::Index>(e), bounds[e].lower, bounds[e].upper).misfit);
    }
    return {fits.nullMisfit(), fits.nullMisfit() - best};
}

Significance significance(const ResidualProblem& problem, const Noise& noise, const std::vector<Bounds>& bounds,
    int draws, std::mt19937_64& random)
{
    const auto count = static_cast<std::size_t>(draws);
    std::vector<double> omnibus(count);
    std::vector<double> gain(count);
    std::vector<std::vector<double>> misfits(bounds.size(), std::vector<double>(count));
    for (std::size_t draw = 0; draw < count; ++draw)
    {
        const Fits fits(whitened(noiseOnly(problem, noise, random), noise.redrawn(random)));
        std::tie(omnibus[draw], gain[draw]) = testStatistics(fits, bounds);
        for (std::size_t e = 0; e < bounds.size(); ++e)
        {
            misfits[e][draw] = fits.effect(static_cast<Eigen::Index>(e), bounds[e].lower, bounds[e].upper).freeMisfit;
        }
    }
    auto sortedOmnibus = omnibus;
    auto sortedGain = gain;
    std::sort(sortedOmnibus.begin(), sortedOmnibus.end());
    std::sort(sortedGain.begin(), sortedGain.end());
    std::vector<double> smaller(count);
    for (std::size_t draw = 0; draw < count; ++draw)
    {
        smaller[draw] = -std::min(upperShare(sortedOmnibus, omnibus[draw]), upperShare(sortedGain, gain[draw]));
    }
    std::sort(smaller.begin(), smaller.end());

    Significance result;
    std::tie(result.omnibus, result.bestGain) = testStatistics(Fits(whitened(problem, noise)), bounds);
    result.omnibusPValue = upperShare(sortedOmnibus, result.omnibus);
    result.bestGainPValue = upperShare(sortedGain, result.bestGain);
    result.pValue = upperShare(smaller, -std::min(result.omnibusPValue, result.bestGainPValue));
    result.bestGainCritical = quantile(gain, 0.95);
    result.nullMisfitLimit = quantile(omnibus, 0.99);
    result.noticed = noticedSquare(omnibus, result.nullMisfitLimit);
    for (auto& each : misfits)
    {
        result.misfitLimit.push_back(quantile(std::move(each), 0.99));
    }
    return result;
}

} // namespace clepsydra::identification
