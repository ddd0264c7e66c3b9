#include "decision/evidence.h"

#include "lists.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace clepsydra::identification
{

namespace
{

/// Degrees of freedom of the prior of each condition's own noise factor, and probability that an unlisted cause changes
/// the scatter.
constexpr double otherSpreadFreedom = 3.0;
constexpr double otherSpreadShare = 0.3;

/// Correlations of the discrepancy between the features of one condition, and between the conditions for one feature.
constexpr double alikeFeatures = 0.5;
constexpr double alikeConditions = 0.3;

} // namespace

void Evidence::prepareOther()
{
    const Eigen::Index n = layout_.rows;
    const Eigen::Index q = study_.parameters.size();
    // Change of each feature by the library's effects at full size, root mean square over effects and conditions.
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(study_.featureCount());
    Eigen::VectorXd counts = squares;
    std::vector<std::pair<std::size_t, Eigen::Index>> rows; // condition and feature
    const Eigen::VectorXd prior = Eigen::VectorXd::Zero(study_.parameters.size());
    for (const auto& block : layout_.blocks)
    {
        const ConditionEmulator& emulator = *emulator_[block.condition];
        const Eigen::VectorXd base = emulator.at(prior, {});
        append(rows, mapped(block.places,
                         [&](Eigen::Index place) { return std::pair(block.condition, emulator.features[place]); }));
        for (std::size_t e = 0; e < study_.effects.size(); ++e)
        {
            if (emulator_.knows(e) && acts(study_.effects[e], study_.conditions[block.condition]))
            {
                const Eigen::VectorXd change = emulator.at(prior, {{e, study_.effects[e].bounds.upper}}) - base;
                for (const auto place : block.places)
                {
                    const auto f = emulator.features[place];
                    squares(f) += change(place) * change(place);
                    counts(f) += 1.0;
                }
            }
        }
    }
    const Eigen::VectorXd typical = squares.cwiseQuotient(counts.cwiseMax(1.0)).cwiseSqrt();
    Eigen::MatrixXd pattern = Eigen::MatrixXd::NullaryExpr(n, n, [&](Eigen::Index i, Eigen::Index j) {
        const auto [condition, f] = rows[i];
        const auto [otherCondition, g] = rows[j];
        return typical(f) * typical(g) * (f == g ? 1.0 : alikeFeatures)
               * (condition == otherCondition ? 1.0 : alikeConditions);
    });
    Eigen::MatrixXd transform = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
        const auto [first, size] = parts_[p];
        transform.block(first, first, size, size) = null_.transform[p];
    }
    pattern = transform * pattern * transform.transpose();
    const Eigen::VectorXd usual = null_.extra.array() + 1.0;
    const Eigen::MatrixXd slope = null_.terms.middleCols(1, q);
    if (q > 0)
    {
        const Eigen::MatrixXd weighted = usual.cwiseInverse().asDiagonal() * slope;
        const Eigen::MatrixXd projection =
            Eigen::MatrixXd::Identity(n, n) - slope * (slope.transpose() * weighted).ldlt().solve(weighted.transpose());
        pattern = projection * pattern * projection.transpose();
    }
    const double rounding = 1e-9 * std::max(pattern.diagonal().maxCoeff(), 1e-12);
    otherRoot_ = (pattern + rounding * Eigen::MatrixXd::Identity(n, n)).llt().matrixL();
    for (const double size : sizes)
    {
        Eigen::MatrixXd covariance = size * size * pattern + slope * slope.transpose();
        covariance.diagonal() += usual;
        other_.emplace_back(covariance);
    }
}

double Evidence::otherEvidence(const Measured& measured, const Spread& usual, const Solution& null) const
{
    const Eigen::Index q = study_.parameters.size();
    // The emulator is linearised in the parameters at the null fit.
    Eigen::VectorXd& r = data_;
    transformTo(null_, measured.mean, r);
    r -= null_.terms * parameterTermsAt(Eigen::VectorXd(null.parameters));
    r += null_.terms.middleCols(1, q) * Eigen::VectorXd(null.parameters);
    const double nu = layout_.noiseFreedom;
    const double rows = static_cast<double>(layout_.rows);
    // Discrepancy of the means and change of the scatter are independent.
    Eigen::VectorXd logs(other_.size());
    for (Eigen::Index i = 0; i < logs.size(); ++i)
    {
        const double chiSquare = other_[i].matrixL().solve(r).squaredNorm() / usual.factor;
        logs(i) = -0.5 * (nu + rows) * std::log1p(chiSquare / nu)
                  - 0.5 * (logDeterminantOf(other_[i]) + rows * std::log(usual.factor) + null_.logDeterminant);
    }
    const double pattern = logSumExp(logs) - std::log(static_cast<double>(other_.size()));
    const Eigen::Vector2d spread(
        std::log(1.0 - otherSpreadShare) + usual.logLikelihood, std::log(otherSpreadShare) + otherSpread(measured));
    return pattern + logSumExp(spread);
}

double Evidence::otherSpread(const Measured& measured) const
{
    double sum = -0.5 * null_.spreadLogDeterminant;
    for (std::size_t b = 0; b < layout_.blocks.size(); ++b)
    {
        const Layout::Block& block = layout_.blocks[b];
        if (block.freedom > 0.0)
        {
            const double trace = traceOf(null_.whiten[b], measured.scatter[b]);
            sum += logSpread(trace, block.freedom * static_cast<double>(block.size()), otherSpreadFreedom);
        }
    }
    return sum;
}

Eigen::VectorXd Evidence::drawOther(double size, std::mt19937_64& random) const
{
    std::normal_distribution<double> normal;
    Eigen::VectorXd pattern =
        size * otherRoot_ * Eigen::VectorXd::NullaryExpr(layout_.rows, [&] { return normal(random); });
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
        auto own = pattern.segment(parts_[p].first, parts_[p].size);
        own = null_.transform[p].partialPivLu().solve(Eigen::VectorXd(own)).eval();
    }
    return pattern;
}

} // namespace clepsydra::identification
